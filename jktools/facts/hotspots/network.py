"""Which handler's code causes which other handlers to run: pulses, timers and messages between the scripts of a level.

What the player and the world cause, as `touched`, comes from outside. What a script sends to a COG that is not known
can reach every handler of that message, as can a pulse that it gives to a thing that is not known: such handlers are
`open`, and so is what those send on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property

from jktools.facts.cog import ranges
from jktools.facts.cog.counter import Counter
from jktools.facts.cog.counting import MOST_SEEN, VIEWS
from jktools.facts.cog.lowering import Op
from jktools.facts.cog.rates import LEAST_DELAY, PULSE, TIMER, TRIGGER, Site
from jktools.facts.cog.repeats import NEVER, Repeats
from jktools.facts.hotspots.inputs import (
    MESSAGES,
    OWN_CLOCKS,
    THING_CLOCKS,
    Clock,
    Inputs,
    Node,
    Sending,
    handler_of,
    sites_of,
)  # fmt: skip
from jktools.facts.hotspots.lasting import times_of
from jktools.facts.hotspots.runners import Runner
from jktools.facts.hotspots.starts import startup_is_first
from jktools.facts.hotspots.targets import Targets
from jktools.model.cog.messages import LAST_SENDABLE
from jktools.model.cog.values import to_int

_CARRYING = frozenset({"setthingclasscog", "setthingcapturecog"})
_ARMING = "setcogflags"
_ANY_ENTRY = -1
ARMED = 0xC
"""Flags of a COG: its pulse, its timer is set."""


class Network:
    """Of all scripts of one level: what can run, and what causes it."""

    def __init__(
        self, runners: Iterable[Runner], frames: float, most_seen: Callable[[Runner], int] = lambda _: MOST_SEEN
    ) -> None:
        """Find what can run, and all ways between the handlers that can; `frames` are the game's a second.

        `most_seen` tells how many things FirstThingInView can find for a script.
        """
        self.runners = tuple(runners)
        self.nodes = [Node(r, h.label) for r in self.runners for h in r.analysis.program.handlers]
        self._listeners: dict[int, list[Node]] = {}
        for node in self.nodes:
            self._listeners.setdefault(handler_of(node).message.id, []).append(node)
        self.targets = Targets(self.runners)
        self._beating: set[int] = set()
        self.inputs: dict[Node, Inputs] = {}
        self.clocks: dict[tuple[Runner | int, str], Clock] = {}
        self._start()
        self._close()
        self.frames, self.most_seen = frames, most_seen
        self.repeats = {runner: self._repeats(runner) for runner in self.runners}
        self._disturbed: dict[Runner, Mapping[str, Mapping[int, Repeats]]] = {}
        self._spread()
        for clock in self.clocks.values():
            clock.times = times_of(clock, self.inputs, self.passes)

    def passes(self, node: Node, site: Site) -> Repeats:
        """How often a handler's run comes to a call, if no other script looks for things in view meanwhile."""
        return self.repeats[node.runner][node.label].get(site.block, NEVER)

    @property
    def live(self) -> list[Node]:
        """The handlers that can run at all."""
        return [node for node in self.nodes if node in self.inputs]

    def _start(self) -> None:
        for node in self.nodes:
            runner, handler = node.runner, handler_of(node)
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
            for site in sites_of(sender):
                for found in self._sent(sender, site):
                    pending.append(found)

    def _sent(self, sender: Node, site: Site) -> Iterator[Node]:
        """Add what a call sends; the handlers that were not known to run before."""
        name = site.verb.name
        before = len(self.inputs)
        if name in OWN_CLOCKS:
            self._set_own(sender, site, *OWN_CLOCKS[name])
        elif name in THING_CLOCKS:
            self._set_things(sender, site, *THING_CLOCKS[name])
        elif name in MESSAGES or name == "sendtrigger":
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
        numbers, known = self.targets.things(sender, site)
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
        to_come = self.targets.reaches_things_to_come(sender.runner, site)
        for node in hearing:
            unsure = not known and (node.runner.links or node.runner.more)
            if unsure or node.runner.captures or (to_come and node.runner is sender.runner):
                self._reached(node).open = True

    # ---- messages

    def _message(self, sender: Node, site: Site) -> None:
        name = site.verb.name
        if name == "sendtrigger":
            wanted = [TRIGGER]
        else:
            low, high = ranges.as_int(site.arguments[MESSAGES[name]])
            high = min(high, LAST_SENDABLE[sender.runner.analysis.program.vocabulary.game])
            wanted = list(range(max(low, 0), high + 1))
        targets, known = None, True
        if name in ("sendmessage", "sendmessageex"):
            targets, known = self.targets.cogs(sender.runner, site)
        for message in wanted:
            for node in self._listeners.get(message, ()):
                if targets is None or node.runner in targets:
                    copies = 1.0
                    if name == "sendmessageexradius":
                        copies = float(sum(node.runner.links.values()))
                    self._reached(node).messages.append(Sending(sender, site, copies))
                elif not known:
                    self._reached(node).open = True

    def _carries(self, sender: Node, site: Site) -> None:
        """A thing that takes on a class COG, or is captured for one, sends it all that happens to it."""
        targets, known = self.targets.cogs(sender.runner, site, 1)
        for node in self.nodes:
            if node.runner in targets or not known:
                self._reached(node).open = True

    def _arms(self, sender: Node, site: Site) -> None:
        """The flags of a COG that arm its pulse or timer do so at an interval of which nothing is known."""
        flags = site.arguments[1].number
        targets, known = self.targets.cogs(sender.runner, site)
        if flags is None or to_int(flags) & ARMED:
            for node in self.nodes:
                if handler_of(node).message.id in (PULSE, TIMER) and (node.runner in targets or not known):
                    self._reached(node).open = True

    # ---- what is not known

    def _spread(self) -> None:
        """Whoever gets messages from an open handler is open; a clock bounds what it passes on."""
        quiet = {PULSE, TIMER} - self._beating
        for node, inputs in self.inputs.items():
            inputs.open |= node.runner.more and handler_of(node).message.id not in quiet
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
        if node.runner not in self._disturbed:
            counter = self._counter(node.runner, undisturbed=False)
            self._disturbed[node.runner] = node.runner.analysis.rates.repeats_by(counter)
        bound = self._disturbed[node.runner][node.label].get(site.block, NEVER)
        if self.passes(node, site).per_run == bound.per_run:
            return False
        if any(other != node or not self._is_clocked(other) for other in self._looking):
            return True
        own = _stored(node) | {_ANY_ENTRY}
        return any(
            other.runner is node.runner and not self._is_clocked(other) and own.intersection(_stored(other))
            for other in self.live
        )

    # ---- what is counted of each script

    def _counter(self, runner: Runner, *, undisturbed: bool) -> Counter:
        each = runner.analysis
        return Counter(
            each.program, each.flow, each.reach, each.known, frames=self.frames, undisturbed=undisturbed,
            most_seen=self.most_seen(runner),
        )  # fmt: skip

    def _repeats(self, runner: Runner) -> Mapping[str, Mapping[int, Repeats]]:
        rates = runner.analysis.rates
        counter = self._counter(runner, undisturbed=True)
        found = rates.repeats_by(counter)
        without = rates.repeats_by(counter, first=False)
        return found if found == without or startup_is_first(runner, self.inputs) else without

    # ---- what verbs run in between

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
