"""The C++ runtime and Python side by side: queries in the binary records of jklb_query, and what differs."""

from __future__ import annotations

import re
import subprocess
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from benchmarks.sight_queries import Queries, near, points, things, through_edges
from jktools.compiler import CompiledLevel
from jktools.model import Level

Array = npt.NDArray[Any]

QUERY = np.dtype([("kind", "<u4"), ("which", "<i4", 5), ("origin", "<f8", 3), ("target", "<f8", 3)])
ANSWER = np.dtype([("whole", "<i4", 8), ("real", "<f8", 6)])
"""The records Query and Answer of runtime/sample/jklb_query.cpp."""

SIGHT, DROP, LOCATE, VISIBLE, LEDGE, LEDGE_OF_THING, LEAVE, BASIN, BASIN_FLOOR = range(9)
LIMITS = (np.inf, np.inf, 1.0, 0.25)
"""JKU: the greatest distances of falls asked for, in turn."""


class Asked(NamedTuple):
    """Queries and what Python answers."""

    queries: Array
    answers: Array


def sight_of(compiled: CompiledLevel, asked: Queries, threads: int = 0) -> Asked:
    """Segments."""
    queries, answers = _records(SIGHT, asked)
    queries["target"] = asked.targets
    _fill(answers["whole"], compiled.mesh.sight(*asked, threads=threads))
    return Asked(queries, answers)


def drop_of(compiled: CompiledLevel, asked: Queries, threads: int = 0) -> Asked:
    """Falls from the origins."""
    queries, answers = _records(DROP, asked)
    limits = np.resize(LIMITS, len(queries))
    queries["target"][:, 0] = limits
    found = compiled.mesh.drop(asked.origins, asked.sectors, limits, threads=threads)
    _fill(answers["whole"], (found.ending, found.met, found.sector))
    answers["real"][:, 0] = found.distance
    return Asked(queries, answers)


def location_of(compiled: CompiledLevel, asked: Queries, threads: int = 0) -> Asked:
    """The targets."""
    queries, answers = _records(LOCATE, asked)
    queries["origin"] = asked.targets
    _fill(answers["whole"], compiled.mesh.location(asked.targets, threads=threads))
    return Asked(queries, answers)


def visible_of(compiled: CompiledLevel, asked: Queries, rng: np.random.Generator) -> Asked:
    """Pairs of sectors."""
    queries, answers = _records(VISIBLE, asked)
    matrix = compiled.visible_sectors
    others = rng.integers(len(compiled.geometry.sector_flags), size=len(queries))
    queries["which"][:, 1] = others
    answers["whole"][:, 0] = True if matrix is None else matrix[asked.sectors, others]
    return Asked(queries, answers)


def _records(kind: int, asked: Queries) -> tuple[Array, Array]:
    queries = np.zeros(len(asked.sectors), QUERY)
    queries["kind"], queries["which"][:, 0], queries["origin"] = kind, asked.sectors, asked.origins
    return queries, np.zeros(len(queries), ANSWER)


def _fill(whole: Array, columns: Iterable[Array]) -> None:
    for i, column in enumerate(columns):
        whole[:, i] = column


Maker = Callable[[Level, int, np.random.Generator], Queries]


def ending(level: Level, count: int, rng: np.random.Generator) -> Queries:
    """Segments that start or end on faces, run in them, or stop at the last double before or after."""
    asked = through_edges(level, count, rng)
    table = level.document.surfaces
    surface = level.document.sectors.first_surface[asked.sectors] + rng.integers(
        level.document.sectors.surface_count[asked.sectors]
    )
    corners = np.array([_face_points(level, s, rng) for s in surface.tolist()]).reshape(-1, 2, 3)
    kind = rng.integers(4, size=count)
    origins, targets = asked.origins.copy(), corners[:, 0].copy()
    origins[kind == 1] = corners[kind == 1, 1]  # within the plane, as far as it is one
    nudged = np.nextafter(targets, rng.choice([-1e9, 1e9], targets.shape))
    targets[kind == 2] = nudged[kind == 2]
    away = np.nan_to_num(asked.targets)
    origins[kind == 3], targets[kind == 3] = corners[kind == 3, 1], away[kind == 3]
    assert len(table) > 0
    return Queries(origins, asked.sectors, targets)


def _face_points(level: Level, surface: int, rng: np.random.Generator) -> Array:
    """Two means of a surface's corners, in float32: corners, middles of edges, places on the face and beside it."""
    start = level.document.surfaces.corner_start
    own = level.vertices[level.document.surfaces.corner_vertex[start[surface] : start[surface + 1]]].astype(np.float64)
    weights = rng.choice([0.0, 0.0, 0.5, 1.0], (2, len(own)))
    weights[weights.sum(axis=1) == 0] = 1
    return np.asarray((weights @ own / weights.sum(axis=1, keepdims=True)).astype(np.float32), np.float64)


def far(level: Level, count: int, rng: np.random.Generator) -> Queries:
    """Ends at the extremes of what can be asked: 2^149 away, and subnormal parts."""
    asked = points(level, count, rng)
    scale = 2.0 ** rng.choice([20, 60, 149], (count, 1)) * rng.choice([-1.0, 0.0, 1.0], (count, 3))
    tiny = 2.0 ** rng.choice([-1074, -400, -170], (count, 3))
    flip = rng.random((count, 1)) < 0.5
    origins = np.where(rng.random((count, 1)) < 0.3, np.where(asked.origins == 0, tiny, asked.origins), asked.origins)
    origins[::7] = np.sign(origins[::7]) * tiny[::7]
    return Queries(np.where(flip, origins, asked.origins), asked.sectors, np.where(flip, asked.targets, scale))


KINDS: dict[str, Maker] = {
    "things": things,
    "random": points,
    "near": near,
    "edges": through_edges,
    "faces": ending,
    "far": far,
}


def ask(program: Path, level: Path, queries: Array) -> tuple[Array, float]:
    """What the runtime answers, and its seconds of processor."""
    with tempfile.TemporaryDirectory() as folder:
        asked, answered = Path(folder, "queries"), Path(folder, "answers")
        asked.write_bytes(queries.tobytes())
        done = subprocess.run([program, level, "--binary", asked, answered], capture_output=True, text=True, check=True)
        taken = re.search(r"answers, (\S+) s", done.stdout)
        assert taken
        return np.frombuffer(answered.read_bytes(), ANSWER), float(taken[1])


def differing(one: Array, other: Array) -> npt.NDArray[np.intp]:
    """Rows that differ in any bit; one that is no number is like any other."""
    bits = [answers["real"].copy().view(np.uint64) for answers in (one, other)]
    nowhere = np.isnan(one["real"]) & np.isnan(other["real"])
    real = ((bits[0] != bits[1]) & ~nowhere).any(axis=1)
    return np.flatnonzero((one["whole"] != other["whole"]).any(axis=1) | real)
