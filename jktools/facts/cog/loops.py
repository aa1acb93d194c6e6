"""The loops of a script's code, and those that nothing ends."""

from __future__ import annotations

from collections.abc import Sequence

from jktools.facts.cog import ranges
from jktools.facts.cog.dataflow import Known
from jktools.facts.cog.lowering import Block, Flow, Op
from jktools.facts.cog.reach import Reach

MOST_EFFORT = 50_000
"""Blocks looked at before nothing more is held for bounded; only scripts made to take long come near."""


class Effort:
    """The work done on the loops of one script."""

    def __init__(self) -> None:
        """None yet."""
        self.blocks = 0

    def add(self, blocks: int) -> None:
        """Count blocks that were looked at."""
        self.blocks += blocks

    @property
    def is_spent(self) -> bool:
        """Whether no more is to be done."""
        return self.blocks > MOST_EFFORT


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


def ways(block: Block, known: Known) -> list[int]:
    """The blocks that one can lead to, as far as its condition tells."""
    holds = ranges.truth(known.conditions[block.index]) if block.index in known.conditions else None
    if not block.tests or holds is None:
        return [s for s in block.successors if s in known.visited]
    return [block.successors[0 if holds else 1]]


def _can_end(flow: Flow, known: Known, reach: Reach, part: frozenset[int]) -> bool:
    blocks = flow.blocks
    if any(blocks[i].returns or any(s not in part for s in ways(blocks[i], known)) for i in part):
        return True
    called = reach.blocks_from(blocks[i].callee for i in part if blocks[i].callee >= 0)
    return any(
        op is Op.CALL and (verb.sleeps or verb.game == "user" or verb.name == "jkendlevel")
        for i in part.union(called) for op, verb, _ in blocks[i].code
    )  # fmt: skip
