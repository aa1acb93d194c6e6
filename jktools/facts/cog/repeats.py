"""How often a run of a handler passes each block: loops that end after a known count, and loops that sleep.

A block's passes in `t` seconds with `n` runs of the handler are at most `n * per_run + t * per_second`, and a little
more when messages arrive while the script sleeps: while one is handled the sleep below goes on. A loop whose end
nobody can prove, and which does not sleep in every turn, makes `per_run` infinite. A script that sleeps goes on in a
later frame (sithCogScript_Tick in the decompiled engine): no loop that sleeps turns more than once a frame.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from heapq import heappop, heappush
from typing import NamedTuple

from jktools.facts.cog import ranges
from jktools.facts.cog.dataflow import Known
from jktools.facts.cog.lowering import Block, Flow, Op
from jktools.facts.cog.reach import Reach
from jktools.model.cog.program import Program
from jktools.syntax.cog.nodes import Assign, Binary, Call, Expression, Name

MOST_FRAMES = 4
"""How deep `call` and messages nest."""
MOST_TESTS = 8
"""Ways out of a loop that are looked at for one that counts."""
MOST_EFFORT = 50_000
"""Blocks counted before nothing more is held for bounded; only scripts made to take long come near."""
SHORTEST_SLEEP = 0.1
"""What a sleep of 0 seconds or less lasts."""
MOST_SEEN = 32
"""Things that FirstThingInView finds at most (sithCogFunctionAI_FirstThingInView in the decompiled engine)."""
FRAMES_PER_SECOND = 50.0
"""Of the game as it was played."""
VIEWS = frozenset({"firstthinginview", "firstthingincone"})
WALKS = frozenset({"nextthinginview", "nextthingincone"})
NO_THING = ranges.Range(ranges.INT, -1, -1)
_END = -1


class Repeats(NamedTuple):
    """Bounds on how often something runs."""

    per_run: float
    per_second: float
    per_interruption: float = 0.0
    """More for each message that finds it asleep, to a handler from which it can be reached."""
    pause: float = math.inf
    """Seconds that a turn of the loop around it asks to sleep, at most; infinite where no loop that sleeps is."""

    def most(self, runs: float, seconds: float, interruptions: float = 0.0) -> float:
        """The greatest count in so many seconds with so many runs and messages."""
        fixed = runs * self.per_run if runs else 0.0
        return fixed + seconds * self.per_second + (interruptions * self.per_interruption if interruptions else 0.0)

    def times(self, count: float) -> Repeats:
        """For what runs `count` times as often."""
        return self._replace(
            per_run=self.per_run * count,
            per_second=self.per_second * count,
            per_interruption=self.per_interruption * count,
        )


class _Loop(NamedTuple):
    header: int
    """-1 for a loop that is entered in several places."""
    tests: Repeats
    """Passes of the header."""
    body: Repeats
    """Passes of each other block, as far as no inner loop holds it."""


NEVER = Repeats(0.0, 0.0)
ONCE = Repeats(1.0, 0.0)
UNBOUNDED = Repeats(math.inf, 0.0)


def components(blocks: Sequence[Block], inside: frozenset[int], cut: int = -1) -> list[list[int]]:
    """The strongly connected parts of a subgraph that hold a cycle; edges into `cut` do not count.

    Tarjan's algorithm without recursion.
    """
    if all(s > i or s not in inside or s == cut for i in inside for s in blocks[i].successors):
        return []  # blocks stand in the order of the text, and nothing leads back
    order: dict[int, int] = {}
    low: dict[int, int] = {}
    open_: list[int] = []
    is_open: set[int] = set()
    found: list[list[int]] = []

    def ways(index: int) -> list[int]:
        return [s for s in blocks[index].successors if s in inside and s != cut]

    for root in sorted(inside):
        if root in order:
            continue
        pending = [(root, iter(ways(root)))]
        order[root] = low[root] = len(order)
        open_.append(root)
        is_open.add(root)
        while pending:
            at, rest = pending[-1]
            for successor in rest:
                if successor not in order:
                    order[successor] = low[successor] = len(order)
                    open_.append(successor)
                    is_open.add(successor)
                    pending.append((successor, iter(ways(successor))))
                    break
                if successor in is_open:
                    low[at] = min(low[at], order[successor])
            else:
                pending.pop()
                if pending:
                    above = pending[-1][0]
                    low[above] = min(low[above], low[at])
                if low[at] == order[at]:
                    part = []
                    while True:
                        member = open_.pop()
                        is_open.discard(member)
                        part.append(member)
                        if member == at:
                            break
                    if len(part) > 1 or at in ways(at):
                        found.append(sorted(part))
    return found


def endless_parts(flow: Flow, known: Known, reach: Reach) -> list[frozenset[int]]:
    """The blocks of each loop that nothing ends and that never sleeps: the game hangs in it."""
    parts = [frozenset(part) for part in components(flow.blocks, frozenset(known.visited))]
    return [part for part in parts if not _can_end(flow, known, reach, part)]


def _ways(block: Block, known: Known) -> list[int]:
    """The blocks that one can lead to, as far as its condition tells."""
    holds = ranges.truth(known.conditions[block.index]) if block.index in known.conditions else None
    if not block.tests or holds is None:
        return [s for s in block.successors if s in known.visited]
    return [block.successors[0 if holds else 1]]


def _can_end(flow: Flow, known: Known, reach: Reach, part: frozenset[int]) -> bool:
    blocks = flow.blocks
    if any(blocks[i].returns or any(s not in part for s in _ways(blocks[i], known)) for i in part):
        return True
    called = reach.blocks_from(blocks[i].callee for i in part if blocks[i].callee >= 0)
    return any(
        op is Op.CALL and (verb.sleeps or verb.game == "user" or verb.name == "jkendlevel")
        for i in part.union(called) for op, verb, _ in blocks[i].code
    )  # fmt: skip


class Counter:
    """Counts passes within the code that one start leads to."""

    def __init__(
        self, program: Program, flow: Flow, reach: Reach, known: Known, *, frames: float = FRAMES_PER_SECOND,
        undisturbed: bool = False,
    ) -> None:  # fmt: skip
        """Count nothing yet; `frames` are the game's a second.

        `undisturbed` takes it that no handler which a verb runs in between starts the list of things in view anew, or
        sets a counter back: the counts are then what is meant, and no longer bounds whatever other scripts do.
        """
        self.undisturbed = undisturbed
        self.program = program
        self.flow = flow
        self.reach = reach
        self.known = known
        self.frame = 1.0 / frames
        self._within: dict[int, Mapping[int, Repeats]] = {}
        self._asleep: dict[tuple[int, int], float] = {}
        self._effort = 0
        self.stores = self._stores(Op.STORE)
        self.arrays = [each for stores in self._stores(Op.STORE_AT).values() for each in stores]

    def of_handler(self, start: int) -> Mapping[int, Repeats]:
        """Passes of each block in one run of the handler that starts here, through calls too."""
        total: dict[int, Repeats] = {}
        level = {start: ONCE}
        if self._effort > MOST_EFFORT:
            return dict.fromkeys(self.reach.blocks_from([start]), UNBOUNDED)
        for _ in range(1 + MOST_FRAMES):
            below: dict[int, Repeats] = {}
            for entry, count in level.items():
                if self._effort > MOST_EFFORT:
                    return dict.fromkeys(self.reach.blocks_from([start]), UNBOUNDED)
                for index, inner in self.within(entry).items():
                    passes = _nested(count, inner)
                    total[index] = _sum(total[index], passes) if index in total else passes
                    callee = self.flow.blocks[index].callee
                    if callee >= 0:
                        below[callee] = _sum(below.get(callee, NEVER), passes)
            level = below
            if not level:
                break
        return total

    def within(self, entry: int) -> Mapping[int, Repeats]:
        """Passes of each block after one start here, not counting what it calls."""
        if entry not in self._within:
            inside = frozenset(i for i in self.reach.blocks_from([entry], into_calls=False) if i in self.known.visited)
            found = dict.fromkeys(sorted(inside), ONCE)
            self._effort += len(found)
            pending = [(part, ONCE) for part in components(self.flow.blocks, inside)]
            while pending:
                part, outer = pending.pop()
                loop = self._loop(frozenset(part), inside, outer, entry)
                for index in part:
                    found[index] = loop.tests if index == loop.header else loop.body
                if loop.header >= 0:
                    pending += [(p, loop.body) for p in components(self.flow.blocks, frozenset(part), cut=loop.header)]
            self._within[entry] = found
        return self._within[entry]

    def _loop(self, part: frozenset[int], inside: frozenset[int], outer: Repeats, entry: int) -> _Loop:
        """How often a loop's header and the rest of it are passed."""
        outside = inside - part
        headers = [i for i in sorted(part) if i == entry or outside.intersection(self.flow.blocks[i].predecessors)]
        if len(headers) != 1:
            return _Loop(-1, UNBOUNDED, UNBOUNDED)
        header = headers[0]
        turns, testing = self._turns(header, part)
        if turns < math.inf:
            again = outer.times(turns + 1)
            return _Loop(header, again, outer.times(turns) if testing == header else again)
        pace = self._pace(header, part)
        if pace <= 0:
            return _Loop(header, UNBOUNDED, UNBOUNDED)
        asked = min(outer.pause, self._asked(part))
        passes = Repeats(outer.per_run, outer.per_second + 1 / pace, outer.per_interruption + 1, asked)
        return _Loop(header, passes, passes)

    # ---- loops that sleep

    def _pace(self, header: int, part: frozenset[int]) -> float:
        """The least time that a turn takes by its sleeps; 0 when a turn may not sleep at all."""
        lasting = self._sleeps(header, MOST_FRAMES)
        starts = [(lasting, s) for s in self.flow.blocks[header].successors if s in part]
        return self._search(starts, part - {header}, header, MOST_FRAMES)

    def _search(self, starts: list[tuple[float, int]], inside: AbstractSet[int], goal: int, depth: int) -> float:
        """The least time asleep on a way through blocks to a goal, `_END` for the end of a label's code."""
        blocks = self.flow.blocks
        done: set[int] = set()
        pending = sorted(starts)
        while pending:
            so_far, index = heappop(pending)
            if index == goal:
                return so_far
            if index in done or index not in inside:
                continue
            done.add(index)
            self._effort += 1
            so_far += self._sleeps(index, depth)
            if goal == _END and blocks[index].returns:
                heappush(pending, (so_far, goal))
            for successor in blocks[index].successors:
                heappush(pending, (so_far, successor))
        return math.inf

    def _sleeps(self, index: int, depth: int) -> float:
        """How long a pass of a block sleeps at least, in what it calls too."""
        block = self.flow.blocks[index]
        total = math.fsum(max(least_sleep(seconds), self.frame) for seconds in self._sleep_arguments(block))
        return total + self._sleeps_in(block.callee, depth - 1) if block.callee >= 0 and depth > 0 else total

    def _sleeps_in(self, entry: int, depth: int) -> float:
        """How long the code of a label sleeps at least before it returns; `depth` more labels can be called."""
        key = (entry, depth)
        if key not in self._asleep:
            inside = self.known.visited.intersection(self.reach.blocks_from([entry], into_calls=False))
            free = self._effort > MOST_EFFORT
            self._asleep[key] = 0.0 if free else self._search([(0.0, entry)], inside, _END, depth)
        return self._asleep[key]

    def _sleep_arguments(self, block: Block) -> list[ranges.Range]:
        return [
            self.known.arguments[node][0]
            for op, arg, node in block.code
            if op is Op.CALL and arg.name == "sleep" and node in self.known.arguments
        ]

    def _asked(self, part: frozenset[int]) -> float:
        """What a turn asks to sleep, at most: all sleeps of a loop together, and of what it calls."""
        blocks = self.flow.blocks
        called = self.reach.blocks_from(blocks[i].callee for i in part if blocks[i].callee >= 0)
        return math.fsum(
            most_sleep(seconds) for i in part | frozenset(called) for seconds in self._sleep_arguments(blocks[i])
        )

    # ---- loops that count

    def _stores(self, operation: Op) -> Mapping[int, list[tuple[int, Assign]]]:
        """By slot: the block and node of each assignment that can run; an array's by the slot that it counts from."""
        found: dict[int, list[tuple[int, Assign]]] = {}
        for index in sorted(self.known.visited):
            for op, slot, node in self.flow.blocks[index].code:
                if op is operation:
                    found.setdefault(slot, []).append((index, node))  # type: ignore[arg-type]
        return found

    def is_stored(self, slot: int) -> bool:
        """Whether something can assign a symbol."""
        return slot in self.stores or bool(self.arrays)

    def _turns(self, header: int, part: frozenset[int]) -> tuple[float, int]:
        """The most turns of a loop whose condition compares a variable that every turn moves by a step, or that walks
        through the things in view.

        With the block that tests it: where that is the header, nothing else is passed once more than the turns.
        """
        testing = [
            i for i in sorted(part)
            if self.flow.blocks[i].tests and any(s not in part for s in self.flow.blocks[i].successors)
        ]  # fmt: skip
        counting = [i for i in testing if isinstance(self.flow.blocks[i].condition, Binary)][:MOST_TESTS]
        found = [(self._turns_by(i, header, part), i) for i in counting]
        proven = [each for each in found if each[0] < math.inf and self._every_turn(each[1], header, part)]
        return min(proven, default=(math.inf, -1))

    def _turns_by(self, testing: int, header: int, part: frozenset[int]) -> float:
        block = self.flow.blocks[testing]
        stays = block.successors[0] in part
        condition = block.condition
        if not isinstance(condition, Binary) or condition not in self.known.operands:
            return math.inf
        left, right = self.known.operands[condition]
        sides: list[tuple[Expression, str, ranges.Range, ranges.Range]] = [
            (condition.left, condition.op, left, right),
            (condition.right, ranges.MIRROR.get(condition.op, ""), right, left),
        ]
        best = math.inf
        for variable, operator, own, limit in sides:
            if isinstance(variable, Name) and operator in ranges.INVERSE:
                going = operator if stays else ranges.INVERSE[operator]
                best = min(best, self._walked(variable, going, limit, header, part))
                if going in ("<", "<=", ">", ">="):
                    best = min(best, self._counted(variable, going, own, limit, header, part))
        return best

    def _counted(
        self, variable: Name, going: str, own: ranges.Range, limit: ranges.Range, header: int, part: frozenset[int]
    ) -> float:
        slot = self.program.slot_of.get(variable.name)
        if slot is None or (own.kinds | limit.kinds) & ~ranges.NUMBER:
            return math.inf
        known = self.known
        stores = [*self.stores.get(slot.index, []), *self.arrays]
        moving = [
            (index, node)
            for index, node in stores
            if index in part and not self._ends(known.stored[node], going, limit)
        ]
        if any(index in part for index, _ in self.arrays):
            return math.inf
        if len(moving) != 1 or not self._every_turn(moving[0][0], header, part):
            return math.inf
        if self._others_store(part, stores):
            return math.inf
        step = self._step(moving[0][1], slot.name)
        up = going in ("<", "<=")
        least = step[0] if up else -step[1]
        start, end = (own.low, limit.high) if up else (-own.high, -limit.low)
        if least <= 0 or math.isinf(start) or math.isinf(end):
            return math.inf
        # Adding rounds to float32: where that can eat a sixteenth of a step, nothing is proven.
        farthest = max(abs(start), abs(end)) + max(abs(step[0]), abs(step[1]))
        if farthest * 2.0**-24 > least / 16:
            return math.inf
        exact = all(float(x).is_integer() for x in (least, start, end)) and farthest < ranges.EXACT_INT
        if exact:
            turns = -((start - end) // least) if going in "<>" else (end - start) // least + 1
        else:
            turns = (end - start) // (least * 15 / 16) + 1
        return max(0.0, turns)

    def _walked(self, variable: Name, going: str, limit: ranges.Range, header: int, part: frozenset[int]) -> float:
        """The most turns of a loop over what FirstThingInView found: the engine keeps 32 things, then says none."""
        slot = self.program.slot_of.get(variable.name)
        if slot is None or ranges.truth(ranges.binary(going, NO_THING, limit)) is not False:
            return math.inf
        stores = [*self.stores.get(slot.index, []), *self.arrays]
        moving = [(index, node) for index, node in stores if index in part]
        walks = all(self._is_call(node.value, WALKS) for _, node in moving)
        if not walks or not any(self._every_turn(index, header, part) for index, _ in moving):
            return math.inf
        called = frozenset(self.reach.blocks_from(c for i in part if (c := self.flow.blocks[i].callee) >= 0))
        anew = any(
            op is Op.CALL and (arg.name in VIEWS or (arg.delivers and not self.undisturbed))
            for i in part | called for op, arg, _ in self.flow.blocks[i].code
        )  # fmt: skip
        if self.undisturbed:
            return math.inf if anew or any(index in called for index, _ in stores) else MOST_SEEN
        return math.inf if anew or self._others_store(part, stores) else MOST_SEEN

    def _is_call(self, value: Expression, names: frozenset[str]) -> bool:
        verb = self.program.verb_of(value) if isinstance(value, Call) else None
        return verb is not None and verb.name in names

    def _ends(self, stored: ranges.Range, going: str, limit: ranges.Range) -> bool:
        """Whether an assignment in a loop ends it, as `i = 100;` where another language has `break`."""
        return ranges.truth(ranges.binary(going, stored, limit)) is False

    def _step(self, store: Assign, name: str) -> tuple[float, float]:
        """The interval that `name = name + step` adds; (0, 0) for another shape."""
        value = store.value
        if isinstance(value, Binary) and value.op in "+-" and value in self.known.operands:
            left, right = self.known.operands[value]
            if isinstance(value.left, Name) and value.left.name == name:
                low, high = ranges.as_flex(right)
                return (low, high) if value.op == "+" else (-high, -low)
            if value.op == "+" and isinstance(value.right, Name) and value.right.name == name:
                return ranges.as_flex(left)
        return 0.0, 0.0

    def _others_store(self, part: frozenset[int], stores: Sequence[tuple[int, Assign]]) -> bool:
        """Whether one of the assignments can come between the turns: in what the loop calls, or in other handlers."""
        blocks = self.flow.blocks
        called = frozenset(self.reach.blocks_from(blocks[i].callee for i in part if blocks[i].callee >= 0))
        if any(index in called for index, _ in stores):
            return True
        return len(stores) > 1 and any(
            op is Op.CALL and (arg.sleeps if self.undisturbed else arg.delivers)
            for i in part | called for op, arg, _ in blocks[i].code
        )  # fmt: skip

    def _every_turn(self, index: int, header: int, part: frozenset[int]) -> bool:
        """Whether each way round the loop passes a block, and none passes it twice."""
        without = part - {index}
        if index != header and any(header in p for p in components(self.flow.blocks, without)):
            return False
        return not any(index in p for p in components(self.flow.blocks, part, cut=header)) or index == header


def least_sleep(seconds: ranges.Range) -> float:
    """How long `Sleep` asks to sleep at least: 0 or less is 0.1 s."""
    low, high = ranges.as_flex(seconds)
    if low > 0:
        return low
    return SHORTEST_SLEEP if high <= 0 else 0.0


def most_sleep(seconds: ranges.Range) -> float:
    """How long `Sleep` asks to sleep at most."""
    low, high = ranges.as_flex(seconds)
    return high if low > 0 else max(high, SHORTEST_SLEEP)


def _sum(a: Repeats, b: Repeats) -> Repeats:
    return Repeats(
        a.per_run + b.per_run,
        a.per_second + b.per_second,
        a.per_interruption + b.per_interruption,
        min(a.pause, b.pause),
    )


def _nested(outer: Repeats, inner: Repeats) -> Repeats:
    """Passes of what runs `inner` each time that something runs which itself runs `outer`.

    What goes on by time goes on once at most at a time: a script runs one frame, the others wait.
    """
    if outer == NEVER:
        return NEVER
    if math.isinf(outer.per_run) or math.isinf(inner.per_run):
        return UNBOUNDED
    if outer == ONCE:
        return inner
    again = outer.times(inner.per_run)
    return Repeats(
        again.per_run,
        again.per_second + inner.per_second,
        again.per_interruption + inner.per_interruption,
        min(outer.pause, inner.pause),
    )
