"""Recorded motion: what a logger in the game wrote, or a simulation.

Two layouts are read.

Raw (`.bin`, `.dat`): no header, one record a frame of seven little-endian IEEE 754 single floats, 28 bytes:
timestamp (s), thrust x y z (JKU/s^2, look frame), velocity x y z (JKU/s, world). The research document says
what its logger ("jacklogvel") wrote but not how; this layout is ours, in that order.

CSV (anything else): a header that names `time`, `thrust_x` .. `velocity_z` in any order, and `position_x` ..
if known.

The thrust of a row is the one that acted in the frame that ends there.
"""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from jktools.engine.arrays import Float64

RAW_SUFFIXES = frozenset({".bin", ".dat"})
RAW_RECORD = np.dtype([("time", "<f4"), ("thrust", "<f4", 3), ("velocity", "<f4", 3)])


class RecordingError(ValueError):
    """A log that cannot be read as motion."""


@dataclass(frozen=True, slots=True)
class Recording:
    """Motion over time: `(n,)` seconds, ascending, and `(n, 3)` vectors; position where it is known."""

    time: Float64
    thrust: Float64
    velocity: Float64
    position: Float64 | None = None

    def between(self, start: float, end: float) -> Recording:
        """Keep the rows from `start` to `end` seconds, both included."""
        keep = (self.time >= start) & (self.time <= end)
        position = None if self.position is None else self.position[keep]
        return Recording(self.time[keep], self.thrust[keep], self.velocity[keep], position)


def read(path: Path) -> Recording:
    """Read a recording by its suffix. Raises RecordingError for a bad layout, OSError for a bad path."""
    if path.suffix.lower() in RAW_SUFFIXES:
        return parse_raw(path.read_bytes())
    return parse_csv(path.read_text(encoding="utf-8"))


def parse_raw(data: bytes) -> Recording:
    """Read the raw layout. Raises RecordingError for a length that is no whole number of records."""
    if len(data) % RAW_RECORD.itemsize:
        raise RecordingError(f"{len(data)} bytes are no whole number of records of {RAW_RECORD.itemsize} bytes")
    rows = np.frombuffer(data, RAW_RECORD)
    return _checked(*(rows[name].astype(np.float64) for name in ("time", "thrust", "velocity")))


def to_raw(recording: Recording) -> bytes:
    """Write the raw layout; time and vectors are rounded to single precision, the position is lost."""
    rows = np.empty(len(recording.time), RAW_RECORD)
    rows["time"], rows["thrust"], rows["velocity"] = recording.time, recording.thrust, recording.velocity
    return rows.tobytes()


def parse_csv(text: str) -> Recording:
    """Read the CSV layout. Raises RecordingError for a missing column or a field that is no number."""
    rows = csv.reader(io.StringIO(text))
    header = [name.strip() for name in next(rows, [])]
    missing = [name for name in ("time", *_axes("thrust"), *_axes("velocity")) if name not in header]
    if missing:
        raise RecordingError(f"the header has no {', '.join(missing)}")
    try:
        table = np.array([[float(field) for field in row] for row in rows if row], np.float64)
        columns = dict(zip(header, table.reshape(-1, len(header)).T, strict=True))
    except ValueError as error:
        raise RecordingError(f"a row is not {len(header)} numbers: {error}") from None
    vectors = {
        name: np.stack([columns[axis] for axis in _axes(name)], axis=1)
        for name in ("thrust", "velocity", "position")
        if all(axis in columns for axis in _axes(name))
    }
    return _checked(columns["time"], vectors["thrust"], vectors["velocity"], vectors.get("position"))


def _axes(name: str) -> tuple[str, ...]:
    return tuple(f"{name}_{axis}" for axis in "xyz")


def _checked(time: Float64, thrust: Float64, velocity: Float64, position: Float64 | None = None) -> Recording:
    for name, values in (("time", time), ("thrust", thrust), ("velocity", velocity), ("position", position)):
        if values is not None and not np.isfinite(values).all():
            raise RecordingError(f"row {int(np.argwhere(~np.isfinite(values))[0][0])}: {name} is not finite")
    back = np.flatnonzero(np.diff(time) <= 0)
    if len(back):
        raise RecordingError(f"row {int(back[0]) + 1}: time does not go on from {time[back[0]]:g}")
    return Recording(time, thrust, velocity, position)
