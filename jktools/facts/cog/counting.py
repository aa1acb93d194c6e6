"""Loops that end after a known number of turns: those that count, and those that walk through the things in view."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from jktools.facts.cog import ranges
from jktools.facts.cog.dataflow import Known
from jktools.facts.cog.loops import components
from jktools.facts.cog.lowering import Flow, Op
from jktools.facts.cog.reach import Reach
from jktools.facts.cog.stack import is_plain
from jktools.model.cog.program import Program
from jktools.syntax.cog.nodes import Assign, Binary, Call, Expression, Name, Unary

MOST_TESTS = 8
"""Ways out of a loop that are looked at for one that counts."""
MOST_SEEN = 32
"""Things that FirstThingInView finds at most (sithCogFunctionAI_FirstThingInView in the decompiled engine)."""
VIEWS = frozenset({"firstthinginview", "firstthingincone"})
WALKS = frozenset({"nextthinginview", "nextthingincone"})
NO_THING = ranges.Range(ranges.INT, -1, -1)


class CountingLoops:
    """Of one script."""

    def __init__(
        self, program: Program, flow: Flow, reach: Reach, known: Known, *, undisturbed: bool, most_seen: int
    ) -> None:
        """`undisturbed` and `most_seen` are told at `Counter`."""
        self.program, self.flow, self.reach, self.known = program, flow, reach, known
        self.undisturbed, self.most_seen = undisturbed, most_seen
        self.stores = self._stores(Op.STORE)
        self.arrays = [each for stores in self._stores(Op.STORE_AT).values() for each in stores]

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

    def turns(self, header: int, part: frozenset[int]) -> tuple[float, int]:
        """The most turns of a loop whose condition compares a variable that every turn moves by a step, or that walks
        through the things in view.

        With the block that tests it: where that is the header, nothing else is passed once more than the turns.
        """
        testing = [
            i for i in sorted(part)
            if self.flow.blocks[i].tests and any(s not in part for s in self.flow.blocks[i].successors)
        ]  # fmt: skip
        counting = [i for i in testing if isinstance(self.flow.blocks[i].condition, (Binary, Unary))][:MOST_TESTS]
        found = [(self._turns_by(i, header, part), i) for i in counting]
        proven = [each for each in found if each[0] < math.inf and self._every_turn(each[1], header, part)]
        return min(proven, default=(math.inf, -1))

    def _turns_by(self, testing: int, header: int, part: frozenset[int]) -> float:
        block = self.flow.blocks[testing]
        if block.condition is None or not is_plain(self.program, block.condition):
            return math.inf
        best = math.inf
        for compared, stays in _must_hold(block.condition, stays=block.successors[0] in part):
            if compared not in self.known.operands:
                continue
            left, right = self.known.operands[compared]
            sides: list[tuple[Expression, str, ranges.Range, ranges.Range]] = [
                (compared.left, compared.op, left, right),
                (compared.right, ranges.MIRROR.get(compared.op, ""), right, left),
            ]
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
        """The most turns of a loop over what FirstThingInView found: the engine keeps so many, then says none."""
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
            return math.inf if anew or any(index in called for index, _ in stores) else self.most_seen
        return math.inf if anew or self._others_store(part, stores) else self.most_seen

    def _is_call(self, value: Expression, names: frozenset[str]) -> bool:
        verb = self.program.verb_of(value) if isinstance(value, Call) else None
        return verb is not None and verb.name in names

    def _ends(self, stored: ranges.Range, going: str, limit: ranges.Range) -> bool:
        """Whether an assignment in a loop ends it, as `i = 100;` where another language has `break`."""
        return ranges.truth(ranges.binary(going, stored, limit)) is False

    def _step(self, store: Assign, name: str) -> tuple[float, float]:
        """The interval that `name = name + step` adds; (0, 0) for another shape."""
        value = store.value
        if (
            isinstance(value, Binary)
            and value.op in "+-"
            and value in self.known.operands
            and is_plain(self.program, value)
        ):
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


def _must_hold(condition: Expression, *, stays: bool) -> list[tuple[Binary, bool]]:
    """The comparisons that have to come out so for a loop to go on, as both do of `i < 5 && found == 0`.

    `stays` is what the whole condition has to be.
    """
    found: list[tuple[Binary, bool]] = []
    pending = [(condition, stays)]
    while pending:
        at, wanted = pending.pop()
        if isinstance(at, Unary) and at.op == "!":
            pending.append((at.operand, not wanted))
        elif isinstance(at, Binary) and at.op == ("&&" if wanted else "||"):
            pending += ((at.left, wanted), (at.right, wanted))
        elif isinstance(at, Binary):
            found.append((at, wanted))
    return found
