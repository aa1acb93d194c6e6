"""Whether `startup` comes to a script before all that can leave something unfinished in it."""

from __future__ import annotations

from collections.abc import Mapping

from jktools.facts.cog.rates import LOADING, STARTUP
from jktools.facts.hotspots.inputs import MESSAGES, Inputs, Node, handler_of, sites_of
from jktools.facts.hotspots.runners import Runner


def startup_is_first(runner: Runner, inputs: Mapping[Node, Inputs]) -> bool:
    """Whether it comes once, and finds no other handler of its script asleep.

    The engine sends `startup` to one script after the other: what the first do in theirs, or in `loading`, can send
    messages to those behind. Pulses and timers come later. A handler that is `open` may come at any time.
    """
    starts = [node for node in inputs if node.runner is runner and handler_of(node).message.name == STARTUP]
    early = {node for node, each in inputs.items() if each.open or handler_of(node).message.name in (STARTUP, LOADING)}
    early.difference_update(starts)
    grown = True
    while grown:
        acts = any(_acts(node) for node in early)
        more = {
            node
            for node, each in inputs.items()
            if node not in early
            and node not in starts
            and ((acts and each.events) or any(sending.sender in early for sending in each.messages))
        }
        early |= more
        grown = bool(more)
    sleeps = runner.analysis.rates.sleeps
    return not any(inputs[node].messages for node in starts) and not any(
        node.runner is runner and sleeps(node.label) for node in early
    )


def _acts(node: Node) -> bool:
    """Whether a handler does what the world may answer with a message, before the verb comes back."""
    return any(site.verb.delivers and site.verb.name not in (*MESSAGES, "sendtrigger") for site in sites_of(node))
