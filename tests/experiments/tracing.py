"""`jktools trace run` in the compiled smithdev: a script of keys from a thing of a chamber, read back from the CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from jktools.cli import main
from tests.experiments.smithdev import HANDLE

Array = np.ndarray[Any, np.dtype[np.float64]]


class Trace(NamedTuple):
    """A trace: (n,) seconds, (n, 3) JKU, and what was said of it."""

    time: Array
    thrust: Array
    velocity: Array
    position: Array
    attached: Array
    said: list[str]
    """`leaves the ground` and `lands`, in turn."""

    @property
    def speed(self) -> Array:
        """(n,) JKU/s."""
        return np.linalg.norm(self.velocity, axis=1)

    @property
    def ahead(self) -> Array:
        """(n,) JKU from the start, seen from above."""
        way = self.position - self.position[0]
        return np.hypot(way[:, 0], way[:, 1])


Run = Callable[..., Trace]


def run_trace(level: Path, folder: Path, capsys: Any, script: str, start: str, *options: str) -> Trace:
    """Trace in a compiled level, from a thing (`chamber/name`), or from `x,y,z,sector`."""
    file = folder / "keys.txt"
    file.write_text(script)
    chamber, _, name = start.partition("/")
    place = str(HANDLE[chamber]["things"][name]) if name else start
    status = main(["trace", "run", str(file), "--level", str(level), "--at", place, *options])
    out = capsys.readouterr()
    assert status == 0, out.err
    rows = list(csv.DictReader(io.StringIO(out.out)))
    vectors = [
        np.array([[float(row[f"{kind}_{axis}"]) for axis in "xyz"] for row in rows])
        for kind in ("thrust", "velocity", "position")
    ]
    time, attached = (np.array([float(row[name]) for row in rows]) for name in ("time", "attached"))
    said = [line.partition(" s: ")[2].split(",")[0] for line in out.err.splitlines() if " s: " in line]
    return Trace(time, *vectors, attached, said)
