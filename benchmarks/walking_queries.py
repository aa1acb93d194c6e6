"""Ledges, ways over floors and basins in the binary records of jklb_query, with what Python answers.

Of each sort, some at random and some where answers change: at the ends of edges and of ledges, a last bit beside them,
on the border of a body's rows, in corners, on floors that share a border with a basin; and what is not there.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from benchmarks.runtime_queries import (
    ANSWER,
    BASIN,
    BASIN_FLOOR,
    LEAVE,
    LEDGE,
    LEDGE_OF_THING,
    QUERY,
    Array,
    Asked,
)
from jktools.compiler import Basin, CompiledLevel, Leave, Ledge

Ints = npt.NDArray[np.int32]


def ledges_of(compiled: CompiledLevel, count: int, rng: np.random.Generator) -> Asked:
    """Places on edges of surfaces."""
    queries = np.zeros(count, QUERY)
    queries["kind"] = LEDGE
    queries["which"][:, 0] = _bodies(compiled, count, rng)
    queries["which"][:, 1:3], queries["origin"][:, 0] = _edges(compiled, queries["which"][:, 0], rng)
    return Asked(queries, _answered(_ledge(compiled, *query["which"][:3].tolist(), query) for query in queries))


def ledges_of_things(compiled: CompiledLevel, count: int, rng: np.random.Generator) -> Asked:
    """Places on edges of things."""
    queries = np.zeros(count, QUERY)
    queries["kind"] = LEDGE_OF_THING
    which = queries["which"]
    which[:, 0] = _bodies(compiled, count, rng)
    which[:, 1] = rng.integers(-1, len(compiled.things.source) + 1 if compiled.things else 2, count)
    which[:, 2], which[:, 3], which[:, 4] = (rng.integers(-1, most, count) for most in (4, 12, 6))
    queries["origin"][:, 0] = _random_places(count, rng)
    ledges = compiled.ledges
    listed = np.zeros(0, np.intp) if ledges is None else np.flatnonzero(ledges.surface < 0)
    if len(listed) and ledges is not None:
        own = np.flatnonzero(rng.random(count) < 0.8)
        row = rng.choice(listed, len(own))
        body = np.searchsorted(ledges.body_ledge_start, row, "right") - 1
        columns = (
            body,
            *(getattr(ledges, name)[row] for name in ("carrier", "carrier_frame", "carrier_face", "corner")),
        )
        for i, column in enumerate(columns):
            which[own, i] = column
        queries["origin"][own, 0] = _changeovers(ledges.start[row], ledges.end[row], rng)
        beside = own[rng.random(len(own)) < 0.2]
        which[beside, rng.integers(1, 5, len(beside))] += rng.choice([-1, 1], len(beside)).astype(np.int32)
    return Asked(queries, _answered(_ledge(compiled, *query["which"].tolist(), query) for query in queries))


def ways_of(compiled: CompiledLevel, count: int, rng: np.random.Generator) -> Asked:
    """Ways over floors, from places on them to places beside and beyond."""
    queries = np.zeros(count, QUERY)
    queries["kind"] = LEAVE
    queries["which"][:, 0] = _bodies(compiled, count, rng)
    edges, at = _edges(compiled, queries["which"][:, 0], rng)
    queries["which"][:, 1] = edges[:, 0]
    start = compiled.geometry.surface_corner_start.astype(np.int64)
    surface = np.clip(edges[:, 0], 0, len(start) - 2)
    first, corners = start[surface], np.diff(start)[surface]
    here = edges[:, 1] % np.maximum(corners, 1)
    # The corners of a surface without any are not looked at.
    vertex = np.append(compiled.geometry.corner_vertex, 0)
    positions = compiled.vertices.astype(np.float64)
    with np.errstate(all="ignore"):  # some vertices are not finite, some ends are meant not to be
        sums = np.concatenate([np.zeros((1, 3)), np.cumsum(positions[compiled.geometry.corner_vertex], axis=0)])
        middle = (sums[start[surface + 1]] - sums[first]) / np.maximum(corners, 1)[:, None]
        ends = [positions[vertex[first + k]] for k in (here, (here + 1) % np.maximum(corners, 1))]
        queries["origin"], queries["target"] = _ways(ends, middle, at, rng)
    told = zip(queries["which"][:, :2].tolist(), queries["origin"].tolist(), queries["target"].tolist(), strict=True)
    return Asked(queries, _answered(_left(compiled, *way) for way in told))


def basins_at(compiled: CompiledLevel, count: int, rng: np.random.Generator) -> Asked:
    """Floors in basins, beside them and elsewhere."""
    queries = np.zeros(count, QUERY)
    queries["kind"] = BASIN
    queries["which"][:, 0] = _bodies(compiled, count, rng)
    surfaces = rng.integers(-1, len(compiled.surface_flags) + 1, count)
    if compiled.basins is not None and len(compiled.basins.surface):
        own = np.flatnonzero(rng.random(count) < 0.7)
        surfaces[own] = rng.choice(compiled.basins.surface, len(own)) + rng.choice([0, 0, -1, 1], len(own))
    queries["which"][:, 1] = surfaces
    by_body = {body: _basins(compiled, body) for body in set(queries["which"][:, 0].tolist())}
    asked = queries["which"][:, :2].tolist()
    return Asked(queries, _answered(by_body[body].get(surface, ([-1], [])) for body, surface in asked))


def floors_of_basins(compiled: CompiledLevel, count: int, rng: np.random.Generator) -> Asked:
    """The basins one by one, and each floor of each."""
    queries = np.zeros(count, QUERY)
    queries["kind"] = BASIN_FLOOR
    basins = compiled.basins
    total = 0 if basins is None else len(basins.body)
    queries["which"][:, 0] = rng.integers(-1, total + 1, count)
    start = np.zeros(1, int) if basins is None else basins.surface_start.astype(int)
    answers: list[tuple[list[int], list[float]]] = []
    for query in queries:
        number = int(query["which"][0])
        if not 0 <= number < total or basins is None:
            answers.append(([-1], []))
            continue
        floors = basins.surface[start[number] : start[number + 1]].tolist()
        k = query["which"][1] = rng.integers(-1, len(floors) + 1)
        floor = floors[k] if 0 <= k < len(floors) else -1
        answers.append(([int(basins.body[number]), len(floors), floor], []))
    return Asked(queries, _answered(answers))


def _there(compiled: CompiledLevel) -> int:
    return 0 if compiled.ledges is None else len(compiled.ledges.body_movesize)


def _bodies(compiled: CompiledLevel, count: int, rng: np.random.Generator) -> Ints:
    """Mostly those that are there."""
    there = _there(compiled)
    bodies = rng.integers(0, max(there, 1), count).astype(np.int32)
    bodies[rng.random(count) < 0.02] = rng.choice([-1, there, 2**31 - 1])
    return bodies


def _edges(compiled: CompiledLevel, bodies: Ints, rng: np.random.Generator) -> tuple[Ints, Array]:
    """Edges of surfaces, (n, 2), and places on them: of ledges, beside those, and of any surface."""
    count = len(bodies)
    surface = rng.integers(-1, len(compiled.surface_flags) + 1, count)
    corner, place = rng.integers(-1, 7, count), _random_places(count, rng)
    ledges = compiled.ledges
    listed = np.zeros(0, np.intp) if ledges is None else np.flatnonzero(ledges.surface >= 0)
    if len(listed) and ledges is not None:
        own = np.flatnonzero(rng.random(count) < 0.8)
        row = rng.choice(listed, len(own))
        # The border between one body's rows and the next's.
        border = np.concatenate([ledges.body_ledge_start[:-1], ledges.body_ledge_start[1:] - 1.0]).astype(np.intp)
        border = border[np.isin(border, listed)]
        at_border = rng.random(len(own)) < 0.05
        if len(border):
            row[at_border] = rng.choice(border, int(at_border.sum()))
        surface[own], corner[own] = ledges.surface[row], ledges.corner[row]
        place[own] = _changeovers(ledges.start[row], ledges.end[row], rng)
        beside = own[rng.random(len(own)) < 0.2]
        corner[beside] += rng.choice([-1, 1, 256], len(beside))
    return np.stack([surface, corner], axis=1).astype(np.int32), place


def _random_places(count: int, rng: np.random.Generator) -> Array:
    ends = np.array([0.0, -0.0, 1.0, -1e-300, np.nextafter(1, 2), np.nan, np.inf, 5e-324])
    return np.where(rng.random(count) < 0.3, rng.choice(ends, count), rng.random(count))


def _changeovers(start: Array, end: Array, rng: np.random.Generator) -> Array:
    """Places within intervals, at their ends and a last bit beside those."""
    ends = np.where(rng.random(len(start)) < 0.5, start, end).astype(np.float64)
    beside = np.nextafter(ends, rng.choice([-1.0, 2.0], len(ends)))
    single = np.nextafter(ends.astype(np.float32), rng.choice([-1.0, 2.0], len(ends)).astype(np.float32))
    within = start + rng.random(len(start)) * (end.astype(np.float64) - start)
    return np.choose(rng.integers(4, size=len(start)), [ends, beside, single.astype(np.float64), within])


def _ways(ends: list[Array], middle: Array, place: Array, rng: np.random.Generator) -> tuple[Array, Array]:
    """From a floor's middle, corner or edge, or from anywhere, over places of edges or along them."""
    count = len(place)
    here, there = ends
    within = np.clip(np.nan_to_num(place), 0, 1)
    over = here + (there - here) * np.where((rng.random(count) < 0.9) | ~np.isfinite(place), within, place)[:, None]
    across = (middle - over) * rng.choice([1.0, 0.5, 1e-3, 1e-12], (count, 1))
    kind = np.broadcast_to(rng.integers(8, size=(count, 1)), (count, 3))
    origin = np.choose(kind, [middle, over, here, over + across, over + across, middle, over - across, there])
    target = np.choose(
        kind,
        [over - across, over - across, there, over - across, over, here - (middle - here) * 0.25, middle, over],
    )
    # As the engine holds positions; beside, and out of bounds.
    single, odd = rng.random((count, 1)) < 0.3, rng.random((count, 1)) < 0.05
    origin, target = (np.where(single, each.astype(np.float32).astype(np.float64), each) for each in (origin, target))
    scale = rng.choice([1.0, 2.0**150, np.nan, 1e-300], (count, 1))
    return np.where(odd, np.nextafter(origin, 1e9), origin), np.where(odd, target * scale, target)


def _ledge(compiled: CompiledLevel, body: int, *edge_and_query: object) -> tuple[list[int], list[float]]:
    *edge, query = edge_and_query
    if not 0 <= body < _there(compiled):
        return [-1, 0], []
    ask = compiled.ledges_at if len(edge) == 2 else compiled.ledges_of_thing
    whole: list[Ledge] = ask(body, *edge)  # type: ignore[arg-type]
    place = float(query["origin"][0])  # type: ignore[index]
    found = next((each for each in whole if each.holds(place)), None)
    if found is None:
        return [-1, len(whole)], []
    told = [found.kind, len(whole), found.other_kind, *_onto(found)]
    return told, [found.start, found.end, found.drop_start, found.drop_end, found.drop(place)]


def _left(
    compiled: CompiledLevel, floor: list[int], origin: list[float], target: list[float]
) -> tuple[list[int], list[float]]:
    body, surface = floor
    if not 0 <= body < _there(compiled):
        return [-1, 9, 9, -1, -1, 0, -1, -1], [1.0, 0.0, np.nan, 0.0, 1.0]
    found: Leave = compiled.leave(body, surface, origin, target)
    told = [found.corner, found.kind, found.ledge.other_kind, *_onto(found.ledge)]
    return told, [found.along, found.place, found.drop, found.ledge.start, found.ledge.end]


def _onto(ledge: Ledge) -> list[int]:
    return [ledge.below, ledge.thing, ledge.traits, ledge.onto, ledge.onto_face]


def _basins(compiled: CompiledLevel, body: int) -> dict[int, tuple[list[int], list[float]]]:
    def told(basin: Basin) -> tuple[list[int], list[float]]:
        whole = [len(basin.surfaces), basin.surfaces[0], basin.entered, basin.left]
        return whole, [basin.shallowest, basin.deepest]

    surfaces = {surface for basin in compiled.basins_of(body) for surface in basin.surfaces}
    found = {surface: compiled.basin_at(body, surface) for surface in surfaces}
    return {surface: told(basin) for surface, basin in found.items() if basin is not None}


def _answered(told: Iterable[tuple[list[int], list[float]]]) -> Array:
    pairs = list(told)
    answers = np.zeros(len(pairs), ANSWER)
    answers["whole"] = [(whole + [0] * 8)[:8] for whole, _ in pairs]
    answers["real"] = [(real + [0.0] * 6)[:6] for _, real in pairs]
    return answers
