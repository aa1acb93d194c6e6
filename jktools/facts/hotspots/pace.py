"""How often the handlers of a level's scripts run, and the calls in them: bounds on what lasts and on what is over.

A pulse comes once an interval and once a frame at most. A timer comes once for each time that it is set; one that what
it runs sets again comes once an interval. A pulse that each run of its handler turns off comes once for each time that
it is set; one that counts itself down, as often as it counts. What comes from outside, as the player's `activated`, is
counted once for each handler, and for each thing that carries a class COG: it counts for what it starts. Messages from
script to script are followed to the COGs that they name. Where handlers send each other messages in a circle, nothing
bounds them.

The bounds hold as long as each handler that is not `open` gets no more from outside than is counted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import NamedTuple, TypeVar

from jktools.facts.cog import ranges
from jktools.facts.cog.counting import MOST_SEEN
from jktools.facts.cog.loops import endless_parts
from jktools.facts.cog.lowering import Block
from jktools.facts.cog.rates import Site, apart
from jktools.facts.cog.repeats import Repeats
from jktools.facts.hotspots.inputs import Clock, Inputs, Node, Sending
from jktools.facts.hotspots.network import Network
from jktools.facts.hotspots.runners import Runner
from jktools.geometry.components import components

V = TypeVar("V", bound=Hashable)

MOST_DELAYED = 256
"""Messages of SetTimerEx that can wait at a time, of all scripts (sithEvent_CreateEvent in the decompiled engine)."""


class Bound(NamedTuple):
    """At most `once + rate * t` times in t seconds."""

    once: float
    rate: float

    def plus(self, other: Bound) -> Bound:
        """Both together."""
        return Bound(self.once + other.once, self.rate + other.rate)

    def times(self, count: float) -> Bound:
        """For what happens so many times as often."""
        return Bound(*(each * count if each and count else 0.0 for each in self))


NOTHING = Bound(0.0, 0.0)
UNBOUNDED = Bound(math.inf, math.inf)


class Wake(NamedTuple):
    """Messages to the handlers of a script that can come to the same loop.

    One that finds the loop asleep in another run turns it too, and lets the sleep below go on. Other handlers leave it
    asleep until it wakes by itself (sithCogExec_Ret in the decompiled engine puts the time back).
    """

    runner: Runner
    labels: frozenset[str]


_Vertex = Node | Wake | Clock
"""A handler; what wakes a loop; a clock."""


class Paces:
    """Of all scripts of one level."""

    def __init__(
        self, runners: Iterable[Runner], frames: float, most_seen: Callable[[Runner], int] = lambda _: MOST_SEEN
    ) -> None:
        """`frames` are the game's a second; `most_seen`: how many things FirstThingInView can find for a script."""
        self.runners = tuple(runners)
        self.frame = 1.0 / frames
        self.network = Network(self.runners, frames, most_seen)
        self.bounds = _Solution(self.network, self.frame).run()

    def labels(self, runner: Runner, site: Site) -> list[str]:
        """The handlers that can run and lead to a call."""
        return [label for label in runner.analysis.rates.senders_of(site) if Node(runner, label) in self.network.inputs]

    def runs_of(self, runner: Runner, label: str) -> float:
        """Runs a second of a handler, of what lasts."""
        return self.bounds.get(Node(runner, label), NOTHING).rate

    def passes(self, runner: Runner, label: str, site: Site) -> Repeats:
        """How often a call happens in the runs of a handler."""
        return self.network.passes(Node(runner, label), site)

    def calls(self, runner: Runner, label: str, site: Site) -> Bound:
        """How often a handler comes to a call."""
        return _calls(self.bounds, self.network, Node(runner, label), site, self.passes(runner, label, site))

    def is_open(self, runner: Runner, label: str, site: Site) -> bool:
        """Whether a handler can come to a call more often than `calls` tells, by what is not known."""
        node = Node(runner, label)
        network = self.network
        return network.inputs[node].open or network.may_be_disturbed(node, site) or network.is_woken(node, site)

    def asked(self, runner: Runner, label: str, site: Site) -> float:
        """The shortest interval, in seconds, that a clock or a sleep on the way to a call asks for; infinite without.

        A clock that comes once for each time that it is set is none, but for a timer that sets itself again.
        """
        node = Node(runner, label)
        found = [self.passes(runner, label, site).pause]
        found += [clock.asked for clock, _ in self.network.inputs[node].clocks if self._lasts(clock)]
        return min(found)

    def _lasts(self, clock: Clock) -> bool:
        return self.bounds.get(clock, NOTHING).rate > 0

    def causes(self, runner: Runner, label: str) -> list[Node]:
        """The handlers, run from outside, each message to which may add runs of this one."""
        inputs = self.network.inputs
        pending = [Node(runner, label)]
        found = dict.fromkeys(pending)
        while pending:
            at = inputs[pending.pop()]
            before = [s.sender for s in at.messages]
            before += [
                s.sender
                for clock, _ in at.clocks
                if clock.kind != "pulse" or clock.times < math.inf
                for s in clock.set_by
            ]
            fresh = [node for node in before if node not in found]
            found.update(dict.fromkeys(fresh))
            pending += fresh
        return [node for node in self.network.nodes if node in found and inputs[node].outside]

    def is_endless(self, runner: Runner, label: str, site: Site) -> bool:
        """Whether a loop around a call can be proven never to end, nor to sleep."""
        inside = self.network.repeats[runner][label]
        reach = runner.analysis.reach
        return any(
            site.block in reach.blocks_from(part) and not inside.keys().isdisjoint(part)
            for part in self._endless[runner]
        )

    @cached_property
    def _endless(self) -> Mapping[Runner, list[frozenset[int]]]:
        parts = ((runner, runner.analysis) for runner in self.runners)
        return {runner: endless_parts(each.flow, each.known, each.reach) for runner, each in parts}


def _wake(network: Network, node: Node, site: Site) -> Wake:
    """What wakes a loop around a call."""
    return Wake(node.runner, network.wakers(node.runner, site))


def _calls(bounds: Mapping[_Vertex, Bound], network: Network, node: Node, site: Site, passes: Repeats) -> Bound:
    runs = bounds.get(node, NOTHING)
    found = runs.times(passes.per_run).plus(Bound(0.0, passes.per_second if runs != NOTHING else 0.0))
    if passes.per_interruption:
        found = found.plus(bounds.get(_wake(network, node, site), NOTHING).times(passes.per_interruption))
    return found


class _Solution:
    """Works the bounds out along the ways of a network, what leads to the rest first."""

    def __init__(self, network: Network, frame: float) -> None:
        self.network, self.frame = network, frame
        self.bounds: dict[_Vertex, Bound] = {}
        wakes = dict.fromkeys(
            _wake(network, node, site)
            for node in network.live
            for site in node.runner.analysis.rates.sites
            if network.passes(node, site).per_interruption
        )
        self.vertices: list[_Vertex] = [*network.live, *wakes]
        self.vertices += network.clocks.values()

    def run(self) -> dict[_Vertex, Bound]:
        for part in ordered(self.vertices, self._needs):
            if len(part) == 1 and part[0] not in self._needs(part[0]):
                self.bounds[part[0]] = self._value(part[0])
            else:
                self._circle(part)
        return self.bounds

    def _circle(self, part: Sequence[_Vertex]) -> None:
        """Of vertices that lead to each other: clocks keep to their intervals; circles of messages have no bound."""
        rest: list[_Vertex] = []
        for vertex in part:
            if isinstance(vertex, Clock):
                self.bounds[vertex] = self._in_circle(vertex, part)
            else:
                rest.append(vertex)
        for inner in ordered(rest, self._needs):
            if len(inner) == 1 and inner[0] not in self._needs(inner[0]):
                self.bounds[inner[0]] = self._value(inner[0])
            else:
                self.bounds.update(dict.fromkeys(inner, UNBOUNDED))

    def _needs(self, vertex: _Vertex) -> list[_Vertex]:
        """What the bound of a vertex is worked out from."""
        found: list[_Vertex] = []
        if isinstance(vertex, Clock):
            for sending in vertex.set_by if self._is_counted(vertex) else ():
                found += self._needs_of(sending)
            return found
        for inputs, own in self._inputs(vertex):
            found += [clock for clock, _ in inputs.clocks]
            for sending in inputs.messages:
                if own is None or sending.sender.runner is not own:
                    found += self._needs_of(sending)
        return found

    def _needs_of(self, sending: Sending) -> list[_Vertex]:
        passes = self.network.passes(sending.sender, sending.site)
        wake = _wake(self.network, sending.sender, sending.site)
        return [sending.sender, wake] if passes.per_interruption else [sending.sender]

    def _inputs(self, vertex: _Vertex) -> list[tuple[Inputs, Runner | None]]:
        """What runs a handler; of a loop, all that runs its handlers but what the script sends itself, being awake."""
        if isinstance(vertex, Wake):
            runner = vertex.runner
            return [
                (self.network.inputs[n], runner)
                for n in self.network.live
                if n.runner is runner and n.label in vertex.labels
            ]
        assert isinstance(vertex, Node)
        return [(self.network.inputs[vertex], None)]

    def _value(self, vertex: _Vertex) -> Bound:
        if isinstance(vertex, Clock):
            return self._clock(vertex)
        total = NOTHING
        for inputs, own in self._inputs(vertex):
            total = total.plus(Bound(inputs.events, 0.0))
            for clock, copies in inputs.clocks:
                total = total.plus(self.bounds[clock].times(copies))
            for sending in inputs.messages:
                if own is None or sending.sender.runner is not own:
                    total = total.plus(self._sent(sending))
        return total

    def _sent(self, sending: Sending) -> Bound:
        passes = self.network.passes(sending.sender, sending.site)
        return _calls(self.bounds, self.network, sending.sender, sending.site, passes).times(sending.copies)

    # ---- clocks

    def _is_counted(self, clock: Clock) -> bool:
        """Whether how often it is set has a say."""
        loose = any(self.network.is_loose(sending) for sending in clock.set_by)
        return (clock.times < math.inf or clock.kind == "each timer") and not loose

    def _most(self, clock: Clock) -> Bound:
        """What no setting of a clock outruns."""
        hands = MOST_DELAYED if clock.kind == "each timer" else 1
        return Bound(1.0, 1.0 / apart(clock.seconds, self.frame)).times(hands)

    def _clock(self, clock: Clock) -> Bound:
        if not self._is_counted(clock):
            return self._most(clock)
        start = Bound(1.0, 0.0) if clock.armed else NOTHING
        for sending in clock.set_by:
            start = start.plus(self._sent(sending))
        return _least(start.times(clock.times) if clock.times < math.inf else start, self._most(clock))

    def _in_circle(self, clock: Clock, part: Sequence[_Vertex]) -> Bound:
        """Of a clock that what it runs sets again; with SetTimerEx once a run at most, each start goes on by itself."""
        most = self._most(clock)
        if clock.kind != "each timer" or not self._is_counted(clock):
            return most
        again = [sending for sending in clock.set_by if sending.sender in part]
        runs = {sending.sender for sending in again}
        if len(runs) != 1 or any(isinstance(v, Node) and v not in runs for v in part):
            return most
        (node,) = runs
        if _most_a_run(self.network, node, [sending.site for sending in again]) > 1:
            return most
        inputs = self.network.inputs[node]
        start = Bound(inputs.events, 0.0)
        for other, copies in inputs.clocks:
            if other is not clock:
                start = start.plus(self._outside(other, part).times(copies))
        for sending in (*inputs.messages, *clock.set_by):
            if sending.sender is not node and sending.sender != node:
                start = start.plus(self._sent(sending))
        if start.rate > 0:
            return most
        seconds = min(ranges.as_flex(sending.site.arguments[0])[0] for sending in again)
        return _least(Bound(start.once, start.once / apart(seconds, self.frame)), most)

    def _outside(self, clock: Clock, part: Sequence[_Vertex]) -> Bound:
        return self._most(clock) if clock in part else self.bounds[clock]


def _least(a: Bound, b: Bound) -> Bound:
    """The one that allows less in the long run."""
    return min(a, b, key=lambda bound: (math.isinf(bound.once), bound.rate, bound.once))


def _most_a_run(network: Network, node: Node, sites: Sequence[Site]) -> float:
    """The most of some calls that one way through a handler makes, as far as it has no loops there."""
    passes = [network.passes(node, site) for site in sites]
    total = sum(each.per_run for each in passes)
    if any(each.per_run > 1 or each.per_second or each.per_interruption for each in passes):
        return math.inf
    if total <= 1:
        return total
    each = node.runner.analysis
    start = each.flow.label_block[node.label]
    inside = (i for i in each.reach.blocks_from([start], into_calls=False) if i in each.known.visited)
    weights = dict.fromkeys(inside, 0)
    for site in sites:
        if site.block not in weights:
            return total  # in a label that it calls
        weights[site.block] += 1
    return _heaviest(each.flow.blocks, weights)


def _heaviest(blocks: Sequence[Block], weights: Mapping[int, int]) -> float:
    """The greatest sum of weights on a way through blocks; infinite where a circle has some."""
    part_of: dict[int, int] = {}
    most: list[float] = []
    for part in ordered(list(weights), lambda index: [i for i in blocks[index].predecessors if i in weights]):
        part_of.update(dict.fromkeys(part, len(most)))
        own = math.fsum(weights[index] for index in part)
        if len(part) > 1 and own:
            return math.inf
        before = {part_of[p] for index in part for p in blocks[index].predecessors if p in weights} - {len(most)}
        most.append(own + max((most[p] for p in before), default=0.0))
    return max(most, default=0.0)


def ordered(vertices: Sequence[V], needs: Callable[[V], Iterable[V]]) -> list[list[V]]:
    """The strongly connected parts of a graph, each behind all that its vertices need."""
    index = {vertex: i for i, vertex in enumerate(vertices)}
    edges = [(index[n], i) for i, vertex in enumerate(vertices) for n in needs(vertex) if n in index]
    first = components(len(vertices), [a for a, _ in edges], [b for _, b in edges]).tolist()
    members: dict[int, list[V]] = {}
    for i, vertex in enumerate(vertices):
        members.setdefault(first[i], []).append(vertex)
    ways = dict.fromkeys((first[a], first[b]) for a, b in edges if first[a] != first[b])
    after: dict[int, list[int]] = {part: [] for part in members}
    waiting = dict.fromkeys(members, 0)
    for a, b in ways:
        after[a].append(b)
        waiting[b] += 1
    ready = [part for part, count in waiting.items() if not count]
    order = []
    while ready:
        part = ready.pop()
        order.append(members[part])
        for each in after[part]:
            waiting[each] -= 1
            if not waiting[each]:
                ready.append(each)
    return order
