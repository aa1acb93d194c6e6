"""Both layouts, read and written, and what is refused."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from jktools.trace import recording
from jktools.trace.recording import RecordingError, parse_csv, parse_raw

ROWS = b"".join(struct.pack("<7f", t, 0, 2, 0, 0, t / 2, 0) for t in (0.0, 0.5, 1.0))
HEADER = "time,thrust_x,thrust_y,thrust_z,velocity_x,velocity_y,velocity_z"


def test_raw() -> None:
    log = parse_raw(ROWS)
    assert log.time.tolist() == [0.0, 0.5, 1.0]
    assert log.thrust.tolist() == [[0, 2, 0]] * 3
    assert log.velocity[:, 1].tolist() == [0.0, 0.25, 0.5]
    assert recording.to_raw(log) == ROWS


def test_csv_in_any_order() -> None:
    text = "velocity_y, time,thrust_x,thrust_y,thrust_z,velocity_x,velocity_z,note\n1,0,0,2,0,0,0,7\n3,1,0,2,0,0,0,7\n"
    log = parse_csv(text)
    assert log.velocity.tolist() == [[0, 1, 0], [0, 3, 0]] and log.position is None


def test_by_suffix(tmp_path: Path) -> None:
    (tmp_path / "a.BIN").write_bytes(ROWS)
    (tmp_path / "a.csv").write_text(HEADER + "\n0,0,0,0,0,0,0\n")
    assert len(recording.read(tmp_path / "a.BIN").time) == 3
    assert len(recording.read(tmp_path / "a.csv").time) == 1


def test_between() -> None:
    assert parse_raw(ROWS).between(0.5, 1.0).time.tolist() == [0.5, 1.0]


@pytest.mark.parametrize(
    ("read", "said"),
    [
        (lambda: parse_raw(ROWS[:-1]), "83 bytes are no whole number of records of 28 bytes"),
        (lambda: parse_raw(ROWS + ROWS), "row 3: time does not go on from 1"),
        (lambda: parse_raw(struct.pack("<7f", 0, 0, 0, 0, 0, np.nan, 0)), "row 0: velocity is not finite"),
        (lambda: parse_csv(""), "the header has no time, thrust_x"),
        (lambda: parse_csv(HEADER + "\n0,0,0,0,0,0,x\n"), "a row is not 7 numbers"),
        (lambda: parse_csv(HEADER + "\n0,0\n"), "a row is not 7 numbers"),
        (lambda: parse_csv(HEADER + "\n0,0,0,0,0,0,0\n0,0\n"), "a row is not 7 numbers"),
    ],
)
def test_what_is_refused(read: object, said: str) -> None:
    with pytest.raises(RecordingError, match=said):
        read()  # type: ignore[operator]
