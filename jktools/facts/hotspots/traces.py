"""What an expression of a running script can stand for: followed back to the numbers and calls that are assigned."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.facts.cog import ranges
from jktools.facts.cog.analysis import Analysis
from jktools.model.cog.program import Slot
from jktools.model.cog.values import to_int
from jktools.syntax.cog.nodes import Assign, Call, Expression, Index, Name, Number, Unary

Leaf = int | Call | None
"""A number, a call whose answer it is, or None for what is not known."""


def leaves(analysis: Analysis, expression: Expression, *, starts: bool = False) -> Iterator[Leaf]:
    """All that an expression can stand for; variables take what is assigned to them anywhere in the script.

    With `starts`, those that the level gives no value also stand for what they are before that.
    """
    tracing = _Tracing(analysis, starts)
    pending = [expression]
    while pending:
        for each in tracing.step(pending.pop()):
            if isinstance(each, Call) or each is None or isinstance(each, int):
                yield each
            else:
                pending.append(each)


class _Tracing:
    def __init__(self, analysis: Analysis, starts: bool) -> None:
        self.analysis, self.starts = analysis, starts
        self.program = analysis.program
        self.slots: set[int] = set()

    def step(self, at: Expression) -> Iterator[Leaf | Expression]:
        if isinstance(at, Call):
            yield at
        elif isinstance(at, Number):
            yield to_int(at.value)
        elif isinstance(at, Unary) and at.op == "-" and isinstance(at.operand, Number):
            yield to_int(-at.operand.value)
        elif isinstance(at, Name) and at.name in self.program.slot_of:
            yield from self.slot(self.program.slot_of[at.name])
        elif isinstance(at, Index) and isinstance(at.base, Name) and at.base.name in self.program.slot_of:
            yield from self.entries(at, self.program.slot_of[at.base.name].index)
        else:
            yield None

    def entries(self, at: Index, base: int) -> Iterator[Leaf | Expression]:
        index = self.analysis.known.indices.get(at)
        low, high = (ranges.INT_MIN, ranges.INT_MAX) if index is None else ranges.as_int(index)
        last = min(base + high, len(self.program.slots) - 1)
        if base + low < 0 or high == ranges.INT_MAX:
            yield None
            return
        for slot in range(base + low, last + 1):
            yield from self.slot(self.program.slots[slot])

    def slot(self, held: Slot) -> Iterator[Leaf | Expression]:
        if held.index in self.slots:
            return
        self.slots.add(held.index)
        assigned = [v for s, v in _stores(self.analysis) if s is None or s == held.index]
        if not assigned:
            number = self.analysis.known.invariant[held.index].number
            yield None if number is None else to_int(number)
        elif held.takes_value or self.starts:
            value = self.analysis.start_of(held)
            yield None if value is None else to_int(value)
        yield from assigned


def _stores(analysis: Analysis) -> Iterator[tuple[int | None, Expression]]:
    """Each assignment: its slot, None for any of an array, and the value."""
    program = analysis.program
    for part in program.expressions:
        if isinstance(part, Assign):
            if isinstance(part.target, Name):
                held = program.slot_of.get(part.target.name)
                if held is not None:
                    yield held.index, part.value
            else:
                yield None, part.value
