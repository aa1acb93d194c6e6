"""How often a pulse or a timer comes for each time that it is set."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from jktools.facts.cog.rates import Site
from jktools.facts.cog.repeats import Repeats
from jktools.facts.hotspots.clocks import calls_off, turns_off_in_each_run
from jktools.facts.hotspots.countdown import most_beats
from jktools.facts.hotspots.inputs import Clock, Inputs, Node

Passes = Callable[[Node, Site], Repeats]
"""How often a handler's run comes to a call."""


def times_of(clock: Clock, inputs: Mapping[Node, Inputs], passes: Passes) -> float:
    """How often a clock comes at most for each time that it is set; infinite for one that lasts.

    A timer comes once. A pulse lasts, unless its handler turns it off: in each run, or once it has counted itself down.
    """
    if clock.kind != "pulse":
        return 1.0 if clock.kind == "timer" else math.inf
    thing = clock.owner if isinstance(clock.owner, int) else None
    hearing = [node for node, each in inputs.items() if any(heard is clock for heard, _ in each.clocks)]
    off = {node: calls_off(node.runner.analysis, node.label, thing) for node in hearing}
    if all(turns_off_in_each_run(node.runner.analysis, node.label, off[node]) for node in hearing):
        return 1.0
    if len(hearing) != 1:
        return math.inf
    (node,) = hearing
    all_its = _is_run_by(inputs[node], clock)
    if thing is not None and not all_its:
        return math.inf  # what another sender counts down is not its own pulse
    own = [sending.site.call for sending in clock.set_by if sending.sender.runner is node.runner]
    alone = not clock.armed and len(own) == len(clock.set_by)
    once = all_its and _is_set_once(clock, inputs, passes)
    return most_beats(node.runner.analysis, node.label, off[node], own, alone=alone, once=once)


def _is_run_by(inputs: Inputs, clock: Clock) -> bool:
    """Whether nothing but a clock makes a handler run."""
    return not (inputs.events or inputs.messages or inputs.open) and all(each is clock for each, _ in inputs.clocks)


def _is_set_once(clock: Clock, inputs: Mapping[Node, Inputs], passes: Passes) -> bool:
    if clock.armed or len(clock.set_by) != 1:
        return clock.armed and not clock.set_by
    (sending,) = clock.set_by
    sender, count = inputs[sending.sender], passes(sending.sender, sending.site)
    more = sender.outside or sender.open or sender.clocks or sender.messages or sender.events > 1
    return not (more or count.per_run > 1 or count.per_second or count.per_interruption)
