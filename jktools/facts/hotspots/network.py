"""Which handler's code causes which other handlers to run: pulses, timers and messages between the scripts of a level.

What the player and the world cause, as `touched`, comes from outside. What a script sends to a COG that is not known
can reach every handler of that message, as can a pulse that it gives to a thing that is not known: such handlers are
`open`, and so is what those send on.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import inf
from typing import NamedTuple

from jktools.facts.cog import ranges
from jktools.facts.cog.lowering import Op
from jktools.facts.cog.rates import LEAST_DELAY, PULSE, TIMER, TRIGGER, Site
from jktools.facts.cog.repeats import NEVER, VIEWS, Counter, Repeats
from jktools.facts.hotspots.clocks import calls_off, turns_off_in_each_run
from jktools.facts.hotspots.countdown import most_beats
from jktools.facts.hotspots.runners import Runner
from jktools.facts.hotspots.traces import Leaf, leaves
from jktools.facts.reachability import OF_STATIC
from jktools.model.cog.messages import LAST_SENDABLE
from jktools.model.cog.program import Handler
from jktools.model.cog.values import to_int
from jktools.syntax.cog.nodes import Call, Expression

CREATES = frozenset(
    {
        "creatething", "createthingnr", "createthingatpos", "createthingatposnr", "createthingatposold",
        "createthingatposowner", "createthinglocal", "createbackpack", "fireprojectile", "fireprojectiledata",
        "fireprojectilelocal",
    }
)  # fmt: skip
"""What they answer with is a thing that the level does not place."""
_CLOCKS: Mapping[str, tuple[str, int]] = {
    "setpulse": ("pulse", PULSE), "settimer": ("timer", TIMER), "settimerex": ("each timer", TIMER),
}  # fmt: skip
_OF_THINGS: Mapping[str, tuple[str, int]] = {"setthingpulse": ("pulse", PULSE), "setthingtimer": ("timer", TIMER)}
_MESSAGES: Mapping[str, int] = {"sendmessage": 1, "sendmessageex": 1, "sendmessageexradius": 3}
"""Which argument is the message."""
PLAYER_VERBS = frozenset({"getlocalplayerthing", "jkgetlocalplayer"})
SENDER_VERBS = frozenset({"getsenderref"})
NOT_BY_THINGS = frozenset(
    {"startup", "loading", "shutdown", "newplayer", "join", "leave", "trigger", *(f"user{i}" for i in range(8))}
)
"""Messages whose sender is no thing, or need not be one."""
_CARRYING = frozenset({"setthingclasscog", "setthingcapturecog"})
_ARMING = "setcogflags"
_ANY_ENTRY = -1
ARMED = 0xC
"""Flags of a COG: its pulse, its timer is set."""


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


class Network:
    """Of all scripts of one level: what can run, and what causes it."""

    def __init__(self, runners: Iterable[Runner], frames: float) -> None:
        """Find what can run, and all ways between the handlers that can; `frames` are the game's a second."""
        self.runners = tuple(runners)
        self.nodes = [Node(r, h.label) for r in self.runners for h in r.analysis.program.handlers]
        self._listeners: dict[int, list[Node]] = {}
        for node in self.nodes:
            self._listeners.setdefault(_handler(node).message.id, []).append(node)
        self._numbered = {r.number: r for r in self.runners if r.number >= 0}
        self._class_of = {t.number: r for r in self.runners if r.cog is None and not r.of for t in r.things}
        self._first_free = 1 + max((n for n in self._numbered if n < OF_STATIC), default=-1)
        self._players = {t.number for r in self.runners for t in r.things if t.resolved.type == "player"}
        self._beating: set[int] = set()
        self.inputs: dict[Node, Inputs] = {}
        self.clocks: dict[tuple[Runner | int, str], Clock] = {}
        self.repeats = {runner: _repeats(runner, frames) for runner in self.runners}
        self._start()
        self._close()

    def passes(self, node: Node, site: Site) -> Repeats:
        """How often a handler's run comes to a call, if no other script looks for things in view meanwhile."""
        return self.repeats[node.runner][node.label].get(site.block, NEVER)

    @property
    def live(self) -> list[Node]:
        """The handlers that can run at all."""
        return [node for node in self.nodes if node in self.inputs]

    def _start(self) -> None:
        for node in self.nodes:
            runner, handler = node.runner, _handler(node)
            for source in runner.analysis.rates.sources[node.label]:
                if source.site is not None:
                    continue
                inputs = self._reached(node)
                if source.kind in ("pulse", "timer"):
                    clock = self._clock(runner, source.kind, 0.0, 0.0)
                    clock.armed = True
                    inputs.clocks.append((clock, 1))
                else:
                    inputs.events += max(len(runner.things), 1) if runner.cog is None and source.kind == "event" else 1
                    inputs.outside |= source.kind == "event" and handler.message.name != "created"

    def _reached(self, node: Node) -> Inputs:
        return self.inputs.setdefault(node, Inputs())

    def _clock(self, owner: Runner | int, kind: str, seconds: float, asked: float) -> Clock:
        clock = self.clocks.setdefault((owner, kind), Clock(kind, owner))
        clock.seconds, clock.asked = min(clock.seconds, seconds), min(clock.asked, asked)
        return clock

    def _close(self) -> None:
        """Follow what runs to what that makes run, each handler once."""
        pending = self.live
        while pending:
            sender = pending.pop()
            for site in _sites(sender):
                for found in self._sent(sender, site):
                    pending.append(found)
        self._spread()
        for clock in self.clocks.values():
            clock.times = self._times(clock)

    def _sent(self, sender: Node, site: Site) -> Iterator[Node]:
        """Add what a call sends; the handlers that were not known to run before."""
        name = site.verb.name
        before = len(self.inputs)
        if name in _CLOCKS:
            self._set_own(sender, site, *_CLOCKS[name])
        elif name in _OF_THINGS:
            self._set_things(sender, site, *_OF_THINGS[name])
        elif name in _MESSAGES or name == "sendtrigger":
            self._message(sender, site)
        elif name in _CARRYING:
            self._carries(sender, site)
        elif name == _ARMING:
            self._arms(sender, site)
        if len(self.inputs) > before:
            yield from list(self.inputs)[before:]

    # ---- clocks

    def _set_own(self, sender: Node, site: Site, kind: str, message: int) -> None:
        low, high = ranges.as_flex(site.arguments[0])
        if high <= (LEAST_DELAY if kind == "each timer" else 0.0):
            return
        clock = self._clock(sender.runner, kind, max(low, 0.0), high)
        clock.set_by.append(Sending(sender, site))
        for node in self._listeners.get(message, ()):
            if node.runner is sender.runner:
                self._hears(node, clock, 1)

    def _hears(self, node: Node, clock: Clock, copies: int) -> None:
        clocks = self._reached(node).clocks
        if all(each is not clock for each, _ in clocks):
            clocks.append((clock, copies))

    def _set_things(self, sender: Node, site: Site, kind: str, message: int) -> None:
        low, high = ranges.as_flex(site.arguments[1])
        if low == high == 0:
            return
        self._beating.add(message)
        numbers, known = self._things(sender, site)
        hearing = self._listeners.get(message, ())
        for number in sorted(numbers):
            clock: Clock | None = None
            for node in hearing:
                copies = node.runner.links.get(number, 0)
                if copies:
                    clock = clock or self._clock(number, kind, max(low, 0.0), max(high, 0.0))
                    self._hears(node, clock, copies)
            if clock is not None:
                clock.set_by.append(Sending(sender, site))
        to_come = self._reaches_things_to_come(sender.runner, site)
        for node in hearing:
            unsure = not known and (node.runner.links or node.runner.more)
            if unsure or node.runner.captures or (to_come and node.runner is sender.runner):
                self._reached(node).open = True

    def _reaches_things_to_come(self, runner: Runner, site: Site) -> bool:
        """Whether a call can mean a thing that sent a message, and that play created."""
        given = site.call.arguments[0] if site.call.arguments else None
        verbs = (runner.analysis.program.verb_of(each) for each in _calls(runner, given))
        return runner.more and any(verb is not None and verb.name in SENDER_VERBS for verb in verbs)

    def _things(self, sender: Node, site: Site) -> tuple[set[int], bool]:
        """The numbers of the placed things that a call means, and whether those are all."""
        number = site.arguments[0].number
        if number is not None:
            return {int(number)}, True
        runner = sender.runner
        given = site.call.arguments[0] if site.call.arguments else None
        numbers: set[int] = set()
        known = True
        for leaf in [None] if given is None else leaves(runner.analysis, given, starts=True):
            verb = runner.analysis.program.verb_of(leaf) if isinstance(leaf, Call) else None
            if isinstance(leaf, int):
                numbers.add(leaf)
            elif verb is not None and verb.name in PLAYER_VERBS:
                numbers |= self._players
            elif verb is not None and verb.name in SENDER_VERBS:
                numbers |= {thing.number for thing in runner.things}
                known &= self._is_sent_by_thing(sender)
            elif verb is None or verb.name not in CREATES:
                known = False
        return numbers, known

    def _is_sent_by_thing(self, node: Node) -> bool:
        """Whether the sender of every message of a handler is a thing that carries the script."""
        message = _handler(node).message
        if node.runner.cog is not None or node.runner.of or message.name in NOT_BY_THINGS:
            return False
        own = {site.verb.name for site in node.runner.analysis.rates.sites} & _CLOCKS.keys()
        return message.id not in (PULSE, TIMER) or not own

    def _times(self, clock: Clock) -> float:
        """How often a clock comes at most for each time that it is set."""
        if clock.kind != "pulse":
            return 1.0 if clock.kind == "timer" else inf
        thing = clock.owner if isinstance(clock.owner, int) else None
        hearing = [node for node, inputs in self.inputs.items() if any(each is clock for each, _ in inputs.clocks)]
        off = {node: calls_off(node.runner.analysis, node.label, thing) for node in hearing}
        if all(turns_off_in_each_run(node.runner.analysis, node.label, off[node]) for node in hearing):
            return 1.0
        if len(hearing) != 1:
            return inf
        (node,) = hearing
        all_its = self._is_run_by(node, clock)
        if thing is not None and not all_its:
            return inf  # what another sender counts down is not its own pulse
        own = [s.site.call for s in clock.set_by if s.sender.runner is node.runner]
        alone = not clock.armed and len(own) == len(clock.set_by)
        once = all_its and self._is_set_once(clock)
        return most_beats(node.runner.analysis, node.label, off[node], own, alone=alone, once=once)

    def _is_run_by(self, node: Node, clock: Clock) -> bool:
        """Whether nothing but a clock makes a handler run."""
        inputs = self.inputs[node]
        return not (inputs.events or inputs.messages or inputs.open) and all(each is clock for each, _ in inputs.clocks)

    def _is_set_once(self, clock: Clock) -> bool:
        if clock.armed or len(clock.set_by) != 1:
            return clock.armed and not clock.set_by
        (sending,) = clock.set_by
        inputs, passes = self.inputs[sending.sender], self.passes(sending.sender, sending.site)
        more = inputs.outside or inputs.open or inputs.clocks or inputs.messages or inputs.events > 1
        return not (more or passes.per_run > 1 or passes.per_second or passes.per_interruption)

    # ---- messages

    def _message(self, sender: Node, site: Site) -> None:
        name = site.verb.name
        if name == "sendtrigger":
            wanted = [TRIGGER]
        else:
            low, high = ranges.as_int(site.arguments[_MESSAGES[name]])
            high = min(high, LAST_SENDABLE[sender.runner.analysis.program.vocabulary.game])
            wanted = list(range(max(low, 0), high + 1))
        targets, known = None, True
        if name in ("sendmessage", "sendmessageex"):
            targets, known = self._cogs(sender.runner, site)
        for message in wanted:
            for node in self._listeners.get(message, ()):
                if targets is None or node.runner in targets:
                    copies = 1.0
                    if name == "sendmessageexradius":
                        copies = float(sum(node.runner.links.values()))
                    self._reached(node).messages.append(Sending(sender, site, copies))
                elif not known:
                    self._reached(node).open = True

    def _cogs(self, runner: Runner, site: Site, argument: int = 0) -> tuple[set[Runner], bool]:
        """The scripts that an argument of a call names, and whether those are all."""
        number = site.arguments[argument].number
        if number is not None:
            target = self._of_number(int(number))
            return target or set(), target is not None
        given = site.call.arguments[argument] if len(site.call.arguments) > argument else None
        found: set[Runner] = set()
        known = True
        for leaf in [None] if given is None else leaves(runner.analysis, given, starts=True):
            targets = self._of_leaf(runner, leaf)
            known &= targets is not None
            found |= targets or set()
        return found, known

    def _of_leaf(self, runner: Runner, leaf: Leaf) -> set[Runner] | None:
        """The scripts that a value names; None where that is not known."""
        if isinstance(leaf, int):
            return self._of_number(leaf)
        verb = runner.analysis.program.verb_of(leaf) if leaf is not None else None
        if verb is None or leaf is None:
            return None
        if verb.name == "getselfcog":
            return {runner}
        if verb.name == "getthingclasscog":
            given = runner.analysis.known.arguments.get(leaf)
            number = None if given is None else given[0].number
            carried = None if number is None else self._class_of.get(int(number))
            return {carried} if carried is not None else None
        return None

    def _of_number(self, number: int) -> set[Runner] | None:
        """The script of a number; None where it can be a class COG: what numbers those get is not known."""
        if number in self._numbered:
            return {self._numbered[number]}
        return None if self._first_free <= number < OF_STATIC else set()

    def _carries(self, sender: Node, site: Site) -> None:
        """A thing that takes on a class COG, or is captured for one, sends it all that happens to it."""
        targets, known = self._cogs(sender.runner, site, 1)
        for node in self.nodes:
            if node.runner in targets or not known:
                self._reached(node).open = True

    def _arms(self, sender: Node, site: Site) -> None:
        """The flags of a COG that arm its pulse or timer do so at an interval of which nothing is known."""
        flags = site.arguments[1].number
        targets, known = self._cogs(sender.runner, site)
        if flags is None or to_int(flags) & ARMED:
            for node in self.nodes:
                if _handler(node).message.id in (PULSE, TIMER) and (node.runner in targets or not known):
                    self._reached(node).open = True

    # ---- what is not known

    def _spread(self) -> None:
        """Whoever gets messages from an open handler is open; a clock bounds what it passes on."""
        quiet = {PULSE, TIMER} - self._beating
        for node, inputs in self.inputs.items():
            inputs.open |= node.runner.more and _handler(node).message.id not in quiet
        grown = True
        while grown:
            more = [
                inputs
                for inputs in self.inputs.values()
                if not inputs.open and any(self.is_loose(s) or self.is_woken(s.sender, s.site) for s in inputs.messages)
            ]
            for inputs in more:
                inputs.open = True
            grown = bool(more)

    def is_loose(self, sending: Sending) -> bool:
        """Whether a call can happen more often than is known."""
        return self.inputs[sending.sender].open or self.may_be_disturbed(sending.sender, sending.site)

    def is_woken(self, node: Node, site: Site) -> bool:
        """Whether a message that is not known can add a turn to a loop that sleeps around a call."""
        if not self.passes(node, site).per_interruption:
            return False
        return any(self.inputs[Node(node.runner, label)].open for label in self.wakers(node.runner, site))

    def wakers(self, runner: Runner, site: Site) -> frozenset[str]:
        """The handlers whose messages can come to the same loop around a call."""
        repeats = self.repeats[runner]
        return frozenset(n.label for n in self.live if n.runner is runner and site.block in repeats[n.label])

    def may_be_disturbed(self, node: Node, site: Site) -> bool:
        """Whether a loop on the way to a call can turn more often, by what a verb in it makes run in between.

        That can begin the list of the things in view anew, which all scripts share, or set a counter back.
        """
        if self.passes(node, site).per_run == node.runner.analysis.rates.repeats_of(node.label, site).per_run:
            return False
        if any(other != node or not self._is_clocked(other) for other in self._looking):
            return True
        own = _stored(node) | {_ANY_ENTRY}
        return any(
            other.runner is node.runner and not self._is_clocked(other) and own.intersection(_stored(other))
            for other in self.live
        )

    @cached_property
    def _looking(self) -> list[Node]:
        return [
            node
            for node in self.live
            if any(s.verb.name in VIEWS and s.block in self.repeats[node.runner][node.label]
                   for s in node.runner.analysis.rates.sites)
        ]  # fmt: skip

    def _is_clocked(self, node: Node) -> bool:
        """Whether nothing but clocks make a handler run, which no verb does in between."""
        inputs = self.inputs[node]
        return not inputs.events and not inputs.messages and not inputs.open


def _stored(node: Node) -> set[int]:
    """The symbols that a handler can assign to; what is assigned to entries of an array can be any."""
    each = node.runner.analysis
    blocks = each.reach.handler_blocks[node.label] & each.known.visited
    code = [(op, arg) for i in blocks for op, arg, _ in each.flow.blocks[i].code]
    return {arg if op is Op.STORE else _ANY_ENTRY for op, arg in code if op in (Op.STORE, Op.STORE_AT)}


def _repeats(runner: Runner, frames: float) -> Mapping[str, Mapping[int, Repeats]]:
    each = runner.analysis
    counter = Counter(each.program, each.flow, each.reach, each.known, frames=frames, undisturbed=True)
    return {h.label: counter.of_handler(each.flow.label_block[h.label]) for h in each.program.handlers}


def _sites(node: Node) -> Iterator[Site]:
    rates = node.runner.analysis.rates
    reached = rates.repeats[node.label]
    return (site for site in rates.sites if site.block in reached)


def _calls(runner: Runner, given: Expression | None) -> Iterator[Call]:
    for leaf in () if given is None else leaves(runner.analysis, given):
        if isinstance(leaf, Call):
            yield leaf


def _handler(node: Node) -> Handler:
    return node.runner.analysis.program.handler_of[node.label]
