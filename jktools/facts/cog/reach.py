"""Which code can run at all, and how labels lead into each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

from jktools.facts.cog.lowering import Flow
from jktools.model.cog.program import Program
from jktools.syntax.cog.nodes import Block as Braces
from jktools.syntax.cog.nodes import CallLabel, Empty, Goto, Labeled, Statement

MOST_FRAMES = 4
"""How deep `call` and messages nest."""


@dataclass(frozen=True, slots=True)
class Passage:
    """One way from the code of a label to another label."""

    source: str
    target: str
    how: Literal["call", "goto", "falls"]


class Reach:
    """The graph of a script's blocks, seen from what the engine can start."""

    def __init__(self, program: Program, flow: Flow) -> None:
        """Look at nothing yet."""
        self.program = program
        self.flow = flow

    def blocks_from(self, starts: Iterable[int], *, into_calls: bool = True) -> list[int]:
        """The blocks that can run once one of these does, in the order of the text."""
        found = set(starts)
        pending = list(found)
        blocks = self.flow.blocks
        while pending:
            block = blocks[pending.pop()]
            ways = block.successors if block.callee < 0 or not into_calls else [*block.successors, block.callee]
            for successor in ways:
                if successor not in found:
                    found.add(successor)
                    pending.append(successor)
        return sorted(found)

    @cached_property
    def live(self) -> list[int]:
        """Blocks that some message leads to."""
        return self.blocks_from(self.flow.label_block[h.label] for h in self.program.handlers)

    @cached_property
    def handler_blocks(self) -> Mapping[str, frozenset[int]]:
        """For each handler's label, the blocks that it leads to, calls included."""
        return {h.label: frozenset(self.blocks_from([self.flow.label_block[h.label]])) for h in self.program.handlers}

    @cached_property
    def dead(self) -> tuple[Statement, ...]:
        """Statements that nothing leads to, whatever the messages: the first of each run of them.

        A label is led to when it is a handler's, or a `goto` or `call` that can itself run names it. What stands
        below a label that nothing uses is left to the rules on labels.
        """
        labels = {block.index for block in self.flow.blocks if block.labels}
        led = set(self.blocks_from(sorted(labels)))
        found: list[Statement] = []
        before_dead = False
        for block in self.flow.blocks:
            dead = block.index not in led
            told = [s for s in block.statements if not isinstance(s, Labeled | Empty | Braces)]
            if dead and told and not before_dead:
                found.append(told[0])
            before_dead = dead and (before_dead or bool(told)) if told or dead else before_dead
        return tuple(found)

    @cached_property
    def label_of(self) -> Mapping[int, str]:
        """For each block, the nearest label above it in the text; no entry above the first."""
        found: dict[int, str] = {}
        latest: str | None = None
        for block in self.flow.blocks:
            for label in block.labels:
                latest = label.label.name
            if latest is not None:
                found[block.index] = latest
        return found

    @cached_property
    def passages(self) -> tuple[Passage, ...]:
        """How the code below one label leads into another."""
        starts: dict[int, list[str]] = {}
        for block in self.flow.blocks:
            for label in block.labels:
                if self.flow.label_block[label.label.name] == block.index:
                    starts.setdefault(block.index, []).append(label.label.name)
        found: dict[Passage, None] = {}
        for block in self.flow.blocks:
            stacked = starts.get(block.index, [])
            found.update((Passage(above, below, "falls"), None) for above, below in pairwise(stacked))
            source = self.label_of.get(block.index)
            if source is None:
                continue
            for successor in [] if block.goes else block.successors:
                for target in starts.get(successor, [])[:1]:
                    found.setdefault(Passage(source, target, "falls"))
            if block.goes or block.callee >= 0:
                jump = block.statements[-1]
                if isinstance(jump, Goto | CallLabel):
                    found.setdefault(Passage(source, jump.label.name, "goto" if block.goes else "call"))
        return tuple(found)

    @cached_property
    def falls(self) -> tuple[tuple[Labeled, tuple[int, ...]], ...]:
        """Labels that code above falls into, with the blocks that this code ends with."""
        found = []
        for block in self.flow.blocks:
            above = tuple(
                i
                for i in block.predecessors
                if i < block.index and i in self._led and i in self.label_of and not self.flow.blocks[i].goes
            )
            if block.labels and above:
                found.append((block.labels[0], above))
        return tuple(found)

    @cached_property
    def _led(self) -> frozenset[int]:
        return frozenset(self.blocks_from(block.index for block in self.flow.blocks if block.labels))
