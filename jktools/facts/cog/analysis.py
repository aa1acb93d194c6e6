"""Everything about the flow of one script, each part worked out on first use."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from jktools.facts.cog.dataflow import Known, analyse, initial_ranges
from jktools.facts.cog.lowering import Flow, lower
from jktools.facts.cog.ranges import Range
from jktools.facts.cog.rates import Rates
from jktools.facts.cog.reach import Reach
from jktools.model.cog.program import Program, Slot
from jktools.model.cog.values import Value


class Analysis:
    """Of a script for any values that a level can give it, or for those of one placed instance."""

    def __init__(
        self, program: Program, bound: Mapping[int, Value] | None = None, shared: Analysis | None = None
    ) -> None:
        """`bound` holds an instance's values by slot; `shared` lends what does not depend on them."""
        self.program = program
        self.bound = bound
        self._shared = shared

    @cached_property
    def flow(self) -> Flow:
        """The code as a graph of blocks."""
        return self._shared.flow if self._shared is not None else lower(self.program)

    @cached_property
    def reach(self) -> Reach:
        """Which code can run at all."""
        return self._shared.reach if self._shared is not None else Reach(self.program, self.flow)

    @cached_property
    def known(self) -> Known:
        """What variables, arguments and conditions can be."""
        return analyse(self.program, self.flow, self.reach.live, self.bound)

    def start_of(self, slot: Slot) -> float | None:
        """The number that a symbol holds before any code runs; None where that is not known."""
        return self._starts[slot.index].number

    def start_range(self, slot: int) -> Range:
        """What the symbol of an index can hold before any code runs."""
        return self._starts[slot]

    @cached_property
    def _starts(self) -> list[Range]:
        return initial_ranges(self.program, self.bound)

    @cached_property
    def rates(self) -> Rates:
        """What sends each handler its message, and how often."""
        return Rates(self.program, self.flow, self.reach, self.known)
