"""What differs between two compiled levels."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np

from jktools.compiler.reader import CompiledLevel
from jktools.compiler.records import Records, derived, written

Change = Literal["added", "removed", "changed"]


class FieldChange(NamedTuple):
    """What a field was and is."""

    field: str
    before: Any
    after: Any


@dataclass(frozen=True, slots=True)
class Difference:
    """One record that only one of two levels has, or that they have differently."""

    section: str
    kind: str
    change: Change
    before: int | None
    """Its number in the first level."""
    after: int | None
    """Its number in the second."""
    name: str
    fields: tuple[FieldChange, ...] = ()


def compare(before: CompiledLevel, after: CompiledLevel) -> list[Difference]:
    """Say what differs, in the order of the file.

    Records are matched by their number where both levels have as many of a kind, else by content: those of equal
    identity, in order, and between such neighbours as many others on both sides. Templates, and all that is computed,
    are matched by what they belong to. Where numbers have shifted, references are compared by what they lead to.
    Not compared: what wrote the files, and of which input.
    """
    found: list[Difference] = []
    first, second = ({each.kind: each for each in written(level)} for level in (before, after))
    kinds = [*first, *(kind for kind in second if kind not in first)]
    matches = {kind: _match(first.get(kind), second.get(kind)) for kind in kinds}
    for kind in kinds:
        found += _differences(first.get(kind), second.get(kind), matches[kind], matches)
    found += _visibility(before, after, matches["sector"])

    def translate(kind: str, number: int) -> Hashable:
        if number < 0 or kind not in matches:
            return number
        return matches[kind].translated.get(number, ("gone", number))

    one = {each.kind: each for each in derived(before, translate)}
    other = {each.kind: each for each in derived(after, lambda _, number: number)}
    for kind in [*one, *(kind for kind in other if kind not in one)]:
        match = _match(one.get(kind), other.get(kind))
        found += _differences(one.get(kind), other.get(kind), match, matches)
    return found


class Match(NamedTuple):
    """Which records are the same."""

    pairs: list[tuple[int, int]]
    """Rows of both levels, ascending in the second."""
    removed: list[int]
    added: list[int]
    translated: Mapping[int, int]
    """From numbers of the first level to those of the second."""

    @property
    def shifts(self) -> bool:
        """Whether some record has another number in the second level."""
        return any(before != after for before, after in self.translated.items())


def _match(first: Records | None, second: Records | None) -> Match:
    one, other = 0 if first is None else len(first), 0 if second is None else len(second)
    if first is None or second is None:
        return Match([], list(range(one)), list(range(other)), {})
    if one == other and not first.by_identity:
        pairs = [(i, i) for i in range(one)]
    else:
        pairs = _between(_equal(first.identity, second.identity), one, other)
    left, right = {a for a, _ in pairs}, {b for _, b in pairs}
    return Match(
        sorted(pairs, key=lambda pair: pair[1]),
        [a for a in range(one) if a not in left],
        [b for b in range(other) if b not in right],
        {first.number[a]: second.number[b] for a, b in pairs},
    )


def _equal(first: Sequence[Hashable], second: Sequence[Hashable]) -> list[tuple[int, int]]:
    """Rows of equal identity, the first with the first, the second with the second, and so on."""
    waiting: dict[Hashable, list[int]] = defaultdict(list)
    for row in reversed(range(len(first))):
        waiting[first[row]].append(row)
    return [(waiting[identity].pop(), row) for row, identity in enumerate(second) if waiting.get(identity)]


def _between(pairs: list[tuple[int, int]], one: int, other: int) -> list[tuple[int, int]]:
    """The pairs, and the rows between neighbouring ones where both sides have as many."""
    found = list(pairs)
    right = {row for _, row in pairs}
    ends = [(-1, -1), *sorted(pairs), (one, other)]
    for (a, b), (next_a, next_b) in pairwise(ends):
        if next_a - a == next_b - b:
            between = [(a + k, b + k) for k in range(1, next_a - a) if b + k not in right]
            found += between
            right.update(row for _, row in between)  # where pairs cross, other gaps may hold these rows too
    return found


def _differences(
    first: Records | None, second: Records | None, match: Match, matches: Mapping[str, Match]
) -> list[Difference]:
    found = _in_any_order(first, second, match, matches)
    return sorted(found, key=lambda each: (_number(each.before, each.after), each.change))


def _number(before: int | None, after: int | None) -> int:
    return after if after is not None else before if before is not None else -1


def _in_any_order(
    first: Records | None, second: Records | None, match: Match, matches: Mapping[str, Match]
) -> Iterator[Difference]:
    if first is not None:
        for row in match.removed:
            yield Difference(first.section, first.kind, "removed", first.number[row], None, first.name[row])
    if second is not None:
        for row in match.added:
            yield Difference(second.section, second.kind, "added", None, second.number[row], second.name[row])
    if first is None or second is None:
        return
    shared = [name for name in first.fields if name in second.fields]
    refers = {name: matches.get(first.fields[name].refers or "") for name in shared}
    shifted = {name: each for name, each in refers.items() if each is not None and each.shifts}
    for a, b in match.pairs:
        changes = tuple(
            FieldChange(name, one, other)
            for name in shared
            if not (
                (one := first.fields[name].values[a]) == (other := second.fields[name].values[b])
                and name not in shifted
            )
            and not _same(one, other, refers[name])
        )
        if changes:
            yield Difference(
                first.section, first.kind, "changed", first.number[a], second.number[b], second.name[b], changes
            )


def _same(one: Any, other: Any, refers: Match | None) -> bool:
    """Whether two values say the same; NaN is NaN, and numbers of records are those of the same record."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_same(one[key], other[key], refers) for key in one)
    if isinstance(one, (list, tuple)) and isinstance(other, (list, tuple)):
        return len(one) == len(other) and all(_same(a, b, refers) for a, b in zip(one, other, strict=True))
    if refers is not None and isinstance(one, int) and one >= 0:
        return bool(refers.translated.get(one) == other)
    if isinstance(one, float) and isinstance(other, float) and math.isnan(one) and math.isnan(other):
        return True
    return bool(one == other)


def _visibility(before: CompiledLevel, after: CompiledLevel, sectors: Match) -> Iterator[Difference]:
    """For each sector, which of the sectors that both levels have it sees in one of them only."""
    first, second = before.visible_sectors, after.visible_sectors
    if first is None or second is None:
        if first is not None or second is not None:
            yield Difference("visibility", "visibility", "removed" if second is None else "added", None, None, "")
        return
    if not sectors.pairs:
        return
    one, other = (np.array(each) for each in zip(*sectors.pairs, strict=True))
    gained = ~first[np.ix_(one, one)] & second[np.ix_(other, other)]
    lost = first[np.ix_(one, one)] & ~second[np.ix_(other, other)]
    for row in np.flatnonzero((gained | lost).any(axis=1)):
        fields = []
        if gained[row].any():
            fields.append(FieldChange("gained", [], other[gained[row]].tolist()))
        if lost[row].any():
            fields.append(FieldChange("lost", one[lost[row]].tolist(), []))
        yield Difference("visibility", "view", "changed", int(one[row]), int(other[row]), "", tuple(fields))
