"""Throughput of sight on real levels, in one run, as ratios to CGAL's AABB tree and to Embree.

A second table is about targets whose sector is known: `sees`, which asks the potentially visible sectors first, and
the same by walking alone, against Embree.

`python -m benchmarks.bench_sight` builds native/benchmarks and prints the table.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import nanobind
import numpy as np

from benchmarks.sight_queries import CORPUS, SETS, Queries, levels, things
from jktools.geometry.mesh import SectorMesh, mesh_arrays

ROOT = Path(__file__).parents[1]
BUILD = ROOT / "build/benchmarks"
RACED = ("namek.jkl", "roshihut7.jkl", "azulcity.jkl", "desolation.jkl", "lop_sabers.jkl")
QUERIES = 100_000


def build(target: str = "sight_race") -> Path:
    """Build a race, with Embree where it is installed."""
    configure = ["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 f"-DPython_EXECUTABLE={sys.executable}", f"-Dnanobind_DIR={nanobind.cmake_dir()}"]  # fmt: skip
    subprocess.run([*configure, "-DJKTOOLS_BENCHMARKS=ON"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", BUILD, "--target", target], check=True, stdout=subprocess.DEVNULL)
    return BUILD / target


def write(path: Path, arrays: list[np.ndarray]) -> None:
    with path.open("wb") as stream:
        for array in arrays:
            stream.write(np.int64(array.size).tobytes() + np.ascontiguousarray(array).tobytes())


Row = dict[str, float]


def aimed(mesh: SectorMesh, queries: Queries) -> list[np.ndarray]:
    """The queries whose target lies in a sector, with that sector."""
    aims = mesh.locate(queries.targets)
    inside = aims >= 0
    return [*(column[inside] for column in queries), aims[inside]]


def race(program: Path) -> tuple[list[Row], list[Row]]:
    """Run the program on the raced levels; a row for each level and set, for `sight` and for `sees`."""
    rows = []
    for name, level in levels():
        if not name.endswith(RACED):
            continue
        rng = np.random.default_rng(1997)
        mesh = SectorMesh.from_level(level)
        sets: list[Queries] = [SETS[key](level, QUERIES, rng) for key in SETS]
        columns = [[*queries, mesh.locate(queries.targets), *aimed(mesh, queries)] for queries in sets]
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "queries"
            write(file, [*mesh_arrays(level), mesh.visible_sectors().rows, *(c for each in columns for c in each)])
            lines = subprocess.run([program, file], check=True, capture_output=True, text=True).stdout.splitlines()
        rows += [{"level": name, **json.loads(line)} for line in lines]
    return rows[::2], rows[1::2]


def geometric_mean(values: list[float]) -> float:
    return float(np.exp(np.mean(np.log(values))))


def print_race(rows: list[Row], first: str, others: tuple[str, ...]) -> None:
    rivals = [name for name in others if name in rows[0]]
    head = "  ".join(f"{r + ' ns':>10} {'ratio':>6} {'differs':>8}" for r in rivals)
    print(f"\n{'level':<30} {'set':<7} {first + ' ns':>11}  {head}")
    for row in rows:
        cells = "  ".join(f"{row[r]:10.1f} {row[r] / row[first]:6.2f} {row[r + ' differs']:8.3%}" for r in rivals)
        print(f"{row['level'][-30:]:<30} {row['set']:<7} {row[first]:11.1f}  {cells}")
    for rival in rivals:
        ratio = geometric_mean([row[rival] / row[first] for row in rows])
        print(f"{first} is {ratio:.2f} times as fast as {rival} (geometric mean)")


def print_calls() -> None:
    """The cost of the Python call, and what a second thread brings, on the largest level."""
    _, level = max(levels(), key=lambda item: len(item[1].surfaces))
    mesh = SectorMesh.from_level(level)
    queries = things(level, QUERIES, np.random.default_rng(1))

    def seconds(rows: slice, threads: int) -> float:
        part = [column[rows] for column in queries]
        times = []
        for _ in range(9):
            start = time.perf_counter()
            mesh.sight(*part, threads=threads)
            times.append(time.perf_counter() - start)
        return min(times)

    everything, one = slice(None), slice(0, 1)
    alone, pair, call = seconds(everything, 1), seconds(everything, 2), seconds(one, 1)
    print(f"a call with one query takes {call * 1e6:.1f} us, {call / alone:.2%} of one with {QUERIES:,}")
    print(f"two threads are {alone / pair:.2f} times as fast as one")
    print(f"{level.path}: {mesh.memory / 2**20:.2f} MiB of native memory")


def main() -> None:
    """Print everything, or say that there are no levels to measure."""
    if not CORPUS.exists():
        print(f"no levels at {CORPUS}: nothing measured")
        return
    sight, sees = race(build())
    print_race(sight, "balanced", ("fast", "tree", "embree"))
    print_race(sees, "sees", ("walked", "embree"))
    print_calls()


if __name__ == "__main__":
    main()
