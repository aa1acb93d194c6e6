"""How far the answer of one tier is from that of `exact`.

The same answers give the same numbers, whatever the machine does meanwhile.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.facts.ledges import Kind
from jktools.geometry import Drop
from jktools.geometry.ledges import BEYOND
from jktools.geometry.mesh import Location, Sight
from jktools.tradeoff.answers import Hollow, Stop, Viewed, Walked
from jktools.tradeoff.overlay import Pieces, overlay

Bool = npt.NDArray[np.bool_]
Float64 = npt.NDArray[np.float64]

AT_EDGES = "edges"
"""The kind of queries that are aimed at edges and vertices; all other kinds are what games and mods ask."""
ROUNDING = 1e-9
"""JKU: what differs by less is the same but for its last digits. Texts do not tell it; pieces of ledges as short have
no kind."""


@dataclass(frozen=True, slots=True)
class Error:
    """What one tier gets wrong."""

    worst: float
    """The one number that plots show; its unit is the pass's `Measure`."""
    measures: Mapping[str, float]
    """All numbers, by the names of docs/tradeoff.schema.json; JKU for lengths."""
    text: str = field(default="none")


class Tally(NamedTuple):
    """How many answers of one kind there are, and how many of them differ."""

    asked: int
    wrong: int
    unlike: int
    """Right in what was asked, but other sectors are crossed, or another wall blocks."""


def unlike_rows(one: Sequence[npt.NDArray[Any]], other: Sequence[npt.NDArray[Any]]) -> Bool:
    """Rows in which any column differs, bit by bit but for NaN, which equals NaN."""
    return np.asarray(np.any([(a != b) & ~((a != a) & (b != b)) for a, b in zip(one, other, strict=True)], axis=0))


def wrong_sight(found: Sight, exact: Sight) -> Bool:
    """Queries whose verdict differs."""
    return np.asarray(found.visible != exact.visible)


def wrong_location(found: Location, exact: Location) -> Bool:
    """Points that are put into another sector."""
    return np.asarray(found.sector != exact.sector)


def wrong_drop(found: Drop, exact: Drop) -> Bool:
    """Falls that end on another floor or otherwise."""
    return np.asarray((found.surface != exact.surface) | (found.ending != exact.ending))


def sight_error(found: Mapping[str, Sight], exact: Mapping[str, Sight]) -> Error:
    """Wrong verdicts, by kind of query."""
    return _of_queries({k: _asked(wrong_sight(found[k], exact[k]), found[k], exact[k]) for k in exact})


def location_error(found: Mapping[str, Location], exact: Mapping[str, Location]) -> Error:
    """Wrong sectors, by kind of point."""
    return _of_queries({k: _asked(wrong_location(found[k], exact[k]), found[k], exact[k]) for k in exact})


def drop_error(found: Mapping[str, Drop], exact: Mapping[str, Drop]) -> Error:
    """Wrong floors, by kind of point, and how far off the depth is where both find one."""
    most = 0.0
    for kind, true in exact.items():
        both = np.isfinite(found[kind].distance) & np.isfinite(true.distance) & (found[kind].ending == true.ending)
        most = max(most, float(np.abs(found[kind].distance[both] - true.distance[both]).max(initial=0.0)))
    asked = {k: _asked(wrong_drop(found[k], exact[k]), _where(found[k]), _where(exact[k])) for k in exact}
    return _of_queries(asked, {"depth_most": most}, _off(most))


def _where(drop: Drop) -> tuple[npt.NDArray[Any], ...]:
    """What a fall meets, without how deep."""
    return drop.surface, drop.ending, drop.met, drop.sector


def _asked(wrong: Bool, found: Sequence[npt.NDArray[Any]], exact: Sequence[npt.NDArray[Any]]) -> Tally:
    unlike = unlike_rows(found, exact)
    return Tally(len(wrong), int(wrong.sum()), int((unlike & ~wrong).sum()))


def _of_queries(by_kind: Mapping[str, Tally], more: Mapping[str, float] | None = None, off: str = "") -> Error:
    edges = by_kind.get(AT_EDGES, Tally(0, 0, 0))
    others = [tally for kind, tally in by_kind.items() if kind != AT_EDGES]
    count, wrong = sum(a.asked for a in others), sum(a.wrong for a in others)
    unlike = edges.unlike + sum(a.unlike for a in others)
    measures = {
        "asked": count, "wrong": wrong, "asked_at_edges": edges.asked, "wrong_at_edges": edges.wrong, "unlike": unlike,
        **(more or {}),
    }  # fmt: skip
    said = [
        f"{wrong:,} of {count:,} wrong" if wrong else "",
        f"at edges {edges.wrong:,} of {edges.asked:,}" if edges.wrong else "",
        f"{unlike:,} right by another way" if unlike else "",
        off,
    ]
    return Error(_share(wrong, count), measures, _joined(said))


def visibility_error(found: Viewed, exact: Viewed) -> Error:
    """Pairs of sectors that `exact` does not have, that only it has, and segments that prove a pair missing.

    A pair that a tier does not have is certain, so that only segments can show a fault; one that it has may be false.
    """
    one, true = found.visible.matrix, exact.visible.matrix
    missed, false, pairs = int((true & ~one).sum()), int((one & ~true).sum()), int(true.sum())
    lost = int((true & ~found.filed).sum())
    measures = {
        "pairs": pairs, "missed": missed, "false": false, "missed_in_file": lost, "segments": found.segments,
        "refuted": found.refuted, "cut_short": found.visible.cut_short, "cut_short_exact": exact.visible.cut_short,
    }  # fmt: skip
    said = [
        f"{found.refuted:,} segments see a pair denied" if found.refuted else "",
        f"{missed:,} pairs missed" if missed else "",
        f"{false:,} false pairs beside {pairs:,}" if false else "",
        f"{lost:,} missed in the file" if lost > missed else "",
    ]
    return Error(_share(missed + false, pairs), measures, _joined(said))


class _Counted(NamedTuple):
    """Of one body's ledges."""

    whole: float
    wrong: float
    longest: float
    ledges: int
    missed: int
    false: int
    compared: float
    off: float
    most: float


def ledge_error(found: Sequence[Walked], exact: Sequence[Walked]) -> Error:
    """Length of edges that is classed otherwise, and how far off the depth is where the class is the same."""
    each = [_ledges_of_body(*both) for both in zip(found, exact, strict=True)]
    total = _Counted(*(sum(column) for column in zip(*each, strict=True))) if each else _Counted(*[0] * 9)
    most, longest = (max((getattr(body, key) for body in each), default=0.0) for key in ("most", "longest"))
    measures = {
        "length": total.whole, "wrong_length": total.wrong, "wrong_longest": longest, "ledges": total.ledges,
        "missed": total.missed, "false": total.false,
        "depth_mean": total.off / total.compared if total.compared else 0.0, "depth_most": most,
    }  # fmt: skip
    share = _share(total.wrong, total.whole)
    said = [
        f"{length(total.wrong)} of {length(total.whole)} classed wrong" if total.wrong else "",
        f"{total.missed:,} of {total.ledges:,} ledges missed" if total.missed else "",
        f"{total.false:,} false" if total.false else "",
        _off(most),
    ]
    return Error(share, measures, _joined(said))


def _ledges_of_body(found: Walked, exact: Walked) -> _Counted:
    pieces = overlay(found.intervals, exact.intervals)
    size = (pieces.end - pieces.start) * exact.length[pieces.edge]
    same = (_kinds(found, pieces.one) == _kinds(exact, pieces.other)) | (size <= ROUNDING)
    ledges, missed = _missed(exact, pieces.other, same)
    _, false = _missed(found, pieces.one, same)
    off = _apart(found, exact, pieces)
    compared = same & ~np.isnan(off)
    long = compared & (size > BEYOND)
    return _Counted(
        float(size.sum()), float(size[~same].sum()), float(size[~same].max(initial=0.0)), ledges, missed, false,
        float(size[compared].sum()),
        float((size * off)[compared].sum()), float(off[long].max(initial=0.0)),
    )  # fmt: skip


def _kinds(of: Walked, rows: npt.NDArray[np.intp]) -> npt.NDArray[np.int64]:
    """The kind of each row; of row -1 a number that equals no other's."""
    kinds = np.append(of.kind.astype(np.int64), -1)
    return np.where(rows < 0, -1 - len(Kind) - len(kinds), kinds[rows])


def _missed(of: Walked, rows: npt.NDArray[np.intp], same: Bool) -> tuple[int, int]:
    """How many ledges there are, longer than the way looked at beyond an edge, and how many the other has nowhere.

    A ledge is a row of intervals of one kind along one edge; floors that go on level are none.
    """
    edge, kind = of.intervals.edge, of.kind
    if not len(edge):
        return 0, 0
    begins = np.append(True, (edge[1:] != edge[:-1]) | (kind[1:] != kind[:-1]))
    number = np.cumsum(begins) - 1
    size = np.bincount(number, weights=(of.intervals.end - of.intervals.start) * of.length[edge])
    met = np.zeros(len(size), np.bool_)
    met[number[rows[same]]] = True
    counts = (kind[begins] != Kind.LEVEL) & (size > BEYOND)
    return int(counts.sum()), int((counts & ~met).sum())


def _apart(found: Walked, exact: Walked, pieces: Pieces) -> Float64:
    """The greater difference in depth at both ends of each piece, JKU; NaN where one has none."""
    ends = (pieces.start, pieces.end)
    first, last = (np.abs(_depth(found, pieces.one, t) - _depth(exact, pieces.other, t)) for t in ends)
    return np.asarray(np.maximum(first, last))


def _depth(of: Walked, row: npt.NDArray[np.intp], place: Float64) -> Float64:
    if not len(of.kind):
        return np.full(len(row), np.nan)
    start, end = of.intervals.start[row], of.intervals.end[row]
    part = np.divide(place - start, end - start, out=np.zeros_like(place), where=end > start)
    return np.asarray(of.drop_start[row] * (1 - part) + of.drop_end[row] * part)


def basin_error(found: Sequence[Hollow], exact: Sequence[Hollow]) -> Error:
    """Basins that are missed, false or told otherwise, and how far off their depths are."""
    pairs = [(each, _same_place(each, found)) for each in exact]
    missed = sum(mate is None for _, mate in pairs)
    false = sum(_same_place(each, exact) is None for each in found)
    matched = [(true, mate) for true, mate in pairs if mate is not None]
    unlike = sum((a.surfaces, a.entered, a.left) != (b.surfaces, b.entered, b.left) for a, b in matched)
    most = max(
        (max(abs(a.shallowest - b.shallowest), abs(a.deepest - b.deepest)) for a, b in matched),
        default=0.0,
    )
    measures = {"basins": len(exact), "missed": missed, "false": false, "unlike": unlike, "depth_most": most}
    said = [
        f"{missed} of {len(exact)} missed" if missed else "",
        f"{false} false" if false else "",
        f"{unlike} told otherwise" if unlike else "",
        _off(most),
    ]
    return Error(_share(missed + false + unlike, len(exact)), measures, _joined(said))


def _same_place(basin: Hollow, others: Sequence[Hollow]) -> Hollow | None:
    """The basin of the same body that shares most floors, None where none shares one."""
    near = [each for each in others if each.body == basin.body and each.surfaces & basin.surfaces]
    return max(near, key=lambda each: len(each.surfaces & basin.surfaces), default=None)


def motion_error(found: Sequence[Stop], exact: Sequence[Stop]) -> Error:
    """How far the way to rest can be from what is said, over the frame rates that `exact` tries."""
    worst, outside, unlike = 0.0, 0, 0
    for said, true in zip(found, exact, strict=True):
        if not all(map(math.isfinite, (*said[2:], *true[2:]))):
            unlike += any(math.isfinite(v) for v in (*said[2:], *true[2:]))
            continue
        worst = max(worst, abs(said.least - true.least), abs(said.most - true.most))
        outside += said.least < true.least or said.most > true.most
    widest = max((each.most - each.least for each in exact if math.isfinite(each.most - each.least)), default=0.0)
    measures = {"stops": len(exact), "off_most": worst, "outside": outside, "unlike": unlike, "widest": widest}
    text = [
        f"stops up to {length(worst)} elsewhere at other frame rates" if worst else "",
        f"{outside} of {len(exact)} outside all" if outside else "",
        f"{unlike} never stop in one alone" if unlike else "",
    ]
    return Error(worst, measures, _joined(text))


def geometry_error(found: Float64, exact: Float64) -> Error:
    """How far vertices are moved, JKU."""
    apart = np.linalg.norm(found - exact, axis=1)
    most, mean = float(apart.max(initial=0.0)), float(apart.mean()) if len(apart) else 0.0
    text = f"vertices moved by up to {length(most)}" if most else "none"
    return Error(most, {"vertices": len(apart), "moved_most": most, "moved_mean": mean}, text)


def length(value: float) -> str:
    """A length for reading."""
    return f"{value:.3g} JKU" if value < 1000 else f"{value:,.0f} JKU"


def _off(depth: float) -> str:
    return f"depth off by up to {length(depth)}" if depth > ROUNDING else ""


def _share(part: float, whole: float) -> float:
    return part / whole if whole else float(part > 0)


def _joined(said: Sequence[str]) -> str:
    return ", ".join(filter(None, said)) or "none"
