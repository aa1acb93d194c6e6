"""Throughput of drop on real levels, in one run, as ratios to CGAL's AABB tree and to a trimesh ray query.

`python -m benchmarks.bench_drop` builds native/benchmarks and prints the table; medians, one thread. trimesh (with
rtree) is measured where it is installed, on fewer points: it is not what jktools depends on.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.bench_sight import RACED, build, geometric_mean, write
from benchmarks.sight_queries import CORPUS, Queries, levels, points, things
from jktools.geometry import CARRIES, STOPS, SectorMesh
from jktools.geometry.drop import ground_of
from jktools.geometry.mesh import mesh_arrays
from jktools.model import Level

SETS = {"things": things, "random": points}
QUERIES = 100_000
QUERIES_OF_TRIMESH = 2_000
ROUNDS = 5


def race(program: Path, name: str, level: Level, sets: list[Queries]) -> list[dict[str, float]]:
    """Run the program on a level; a row for each set."""
    ground = ground_of(level)
    asked = [column for queries in sets for column in (queries.origins, queries.sectors)]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "queries"
        write(file, [*mesh_arrays(level), ground.passes_to, ground.under_water.view(np.uint8), *asked])
        lines = subprocess.run([program, file], check=True, capture_output=True, text=True).stdout.splitlines()
    return [{"level": name, **json.loads(line)} for line in lines]


def trimesh_ratio(level: Level, queries: Queries) -> float | None:
    """How many times longer a trimesh ray query takes than `balanced`, both called from Python, one thread."""
    try:
        import trimesh  # noqa: PLC0415 (may be absent)
        from trimesh.ray.ray_triangle import RayMeshIntersector  # noqa: PLC0415
    except ImportError:
        return None
    positions, start, corners, *_ = mesh_arrays(level)
    kinds = ground_of(level).passes_to
    solid = np.flatnonzero((kinds == CARRIES) | (kinds == STOPS))
    fans = [
        [corners[start[s]], corners[i], corners[i + 1]] for s in solid for i in range(start[s] + 1, start[s + 1] - 1)
    ]
    rays = RayMeshIntersector(trimesh.Trimesh(positions.reshape(-1, 3), np.array(fans), process=False))
    mesh = SectorMesh.from_level(level)
    some = Queries(*(column[:QUERIES_OF_TRIMESH] for column in queries))
    down = np.broadcast_to([0.0, 0.0, -1.0], some.origins.shape)
    mesh.drop(some.origins[:1], some.sectors[:1])
    _first(rays, some.origins[:1], down[:1])
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(ROUNDS):
        for taken, run in zip(
            times,
            (
                lambda: mesh.drop(some.origins, some.sectors, threads=1),
                lambda: _first(rays, some.origins, down),
            ),
            strict=True,
        ):
            begun = time.perf_counter()
            run()
            taken.append(time.perf_counter() - begun)
    return statistics.median(times[1]) / statistics.median(times[0])


def _first(rays: Any, origins: np.ndarray, down: np.ndarray) -> np.ndarray:
    with np.errstate(all="ignore"):  # triangles without area
        return rays.intersects_first(origins, down)


def main() -> None:
    """Print everything, or say that there are no levels to measure."""
    if not CORPUS.exists():
        print(f"no levels at {CORPUS}: nothing measured")
        return
    program = build("drop_race")
    ratios: dict[str, list[float]] = {"fast": [], "tree": [], "trimesh": []}
    print(f"{'level':<32} {'set':<7} {'balanced ns':>11} {'fast':>6} {'tree':>6} {'trimesh':>8} {'tree differs':>12}")
    for name, level in levels():
        if not name.endswith(RACED):
            continue
        rng = np.random.default_rng(1997)
        sets = [make(level, QUERIES, rng) for make in SETS.values()]
        for row, queries in zip(race(program, name, level, sets), sets, strict=True):
            fast, tree = (row[rival] / row["balanced"] for rival in ("fast", "tree"))
            slow = trimesh_ratio(level, queries)
            for rival, ratio in (("fast", fast), ("tree", tree), ("trimesh", slow)):
                if ratio is not None:
                    ratios[rival].append(ratio)
            shown = "absent" if slow is None else f"{slow:.0f}"
            print(
                f"{name[-32:]:<32} {row['set']:<7} {row['balanced']:11.1f} {fast:6.2f} {tree:6.2f} {shown:>8} "
                f"{row['tree differs']:12.2%}"
            )
    for rival, values in ratios.items():
        if values:
            print(f"balanced is {geometric_mean(values):.2f} times as fast as {rival} (geometric mean)")


if __name__ == "__main__":
    main()
