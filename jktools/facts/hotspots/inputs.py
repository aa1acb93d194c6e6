"""What makes a handler run: the calls that send it messages, the clocks that it hears, and what comes from outside."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from jktools.facts.cog.rates import PULSE, TIMER, Site
from jktools.facts.hotspots.runners import Runner
from jktools.model.cog.program import Handler

OWN_CLOCKS: Mapping[str, tuple[str, int]] = {
    "setpulse": ("pulse", PULSE), "settimer": ("timer", TIMER), "settimerex": ("each timer", TIMER),
}  # fmt: skip
THING_CLOCKS: Mapping[str, tuple[str, int]] = {"setthingpulse": ("pulse", PULSE), "setthingtimer": ("timer", TIMER)}
MESSAGES: Mapping[str, int] = {"sendmessage": 1, "sendmessageex": 1, "sendmessageexradius": 3}
"""Which argument is the message."""


class Node(NamedTuple):
    """A handler of a running script."""

    runner: Runner
    label: str


class Sending(NamedTuple):
    """A call that can run in a handler, or in what it calls."""

    sender: Node
    site: Site
    copies: float = 1.0
    """Messages of one call."""


@dataclass(slots=True, eq=False)
class Clock:
    """A pulse or timer of a script or of a thing; a script's timers by SetTimerEx are one clock with many hands."""

    kind: str
    """`pulse`, `timer` or `each timer`."""
    owner: Runner | int
    """A script, or the number of a thing."""
    seconds: float = float("inf")
    """The least interval that a call asks for."""
    asked: float = float("inf")
    """The least of the intervals that the calls ask for at most: no call asks for a longer one by that much."""
    set_by: list[Sending] = field(default_factory=list)
    armed: bool = False
    """Whether the script's flags set it from the start."""
    times: float = float("inf")
    """How often it comes at most for each time that it is set."""


@dataclass(slots=True)
class Inputs:
    """All that makes a handler run."""

    events: float = 0.0
    """Messages from outside, each cause counted once."""
    outside: bool = False
    """Whether the player or the world can cause more of them."""
    clocks: list[tuple[Clock, int]] = field(default_factory=list)
    """With how many messages each time brings."""
    messages: list[Sending] = field(default_factory=list)
    open: bool = False
    """Whether it can get messages that are not known."""


def handler_of(node: Node) -> Handler:
    """The handler itself."""
    return node.runner.analysis.program.handler_of[node.label]


def sites_of(node: Node) -> Iterator[Site]:
    """The calls of verbs that a handler leads to, through the labels that it calls too."""
    rates = node.runner.analysis.rates
    reached = rates.repeats[node.label]
    return (site for site in rates.sites if site.block in reached)
