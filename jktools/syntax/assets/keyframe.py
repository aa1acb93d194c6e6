"""KEY, the animations: how the nodes of a model move (rdKeyframe_LoadEntry in the decompiled engine)."""

from __future__ import annotations

from dataclasses import dataclass

from jktools.diagnostics.wording import numbered
from jktools.source import Source
from jktools.syntax.assets import faults
from jktools.syntax.assets import small_lines as records
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.lines import LineReader
from jktools.syntax.records import Record
from jktools.syntax.rows import floats, ints

EFFECT = "the engine refuses the animation, and a level that lists it"
MOST_MARKERS = 8


@dataclass(frozen=True, slots=True)
class KeyNode:
    """What moves one node."""

    node: int
    name: str
    entries: int


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Keyframe(Asset):
    """A KEY file."""

    frames: int = 0
    fps: float = float("nan")
    joints: int = 0
    """How many nodes the model has that it was made for."""
    markers: tuple[tuple[float, int], ...] = ()
    """Frame and kind of each sound or event."""
    nodes: tuple[KeyNode, ...] = ()


class _MissingLineError(Exception):
    """A line that must be there is not."""


def read_keyframe(source: Source, game: str = "jk") -> Keyframe:
    """Read a KEY. Never raises: what is wrong is told in `Keyframe.diagnostics`."""
    reader = _Reader(LineReader(source, game, EFFECT))
    try:
        reader.file()
        reader.lines.at_end("the animation")
    except _MissingLineError:
        pass
    return Keyframe(
        source=source,
        diagnostics=reader.lines.faults.finish(),
        frames=reader.frames,
        fps=reader.fps,
        joints=reader.joints,
        markers=tuple(reader.markers),
        nodes=tuple(reader.nodes),
    )


class _Reader:
    def __init__(self, lines: LineReader) -> None:
        self.lines = lines
        self.frames, self.joints = 0, 0
        self.fps = float("nan")
        self.markers: list[tuple[float, int]] = []
        self.nodes: list[KeyNode] = []

    def file(self) -> None:
        for record in (records.SECTION, records.FLAGS, records.TYPE):
            self._value(record)
        self.frames = self._int(records.FRAMES)
        self.fps = float(floats([self._value(records.FPS)])[0])
        self.joints = self._int(records.JOINTS)
        if self._value(records.SECTION).lower() == "markers":
            self._markers()
            self._value(records.SECTION)
        announced = self._int(records.NODES)
        heading = self.lines.at - 1
        while self.lines.is_at(records.NODE):
            self._node()
        self.lines.counted(heading, "nodes", announced, len(self.nodes))

    def _markers(self) -> None:
        announced = self._int(records.MARKERS)
        heading = self.lines.at - 1
        if announced > MOST_MARKERS:
            self.lines.fault(
                faults.TOO_MANY_MARKERS, heading,
                f"the animation has {announced} markers, but the engine takes {MOST_MARKERS}",
                f"remove markers; {EFFECT}",
            )  # fmt: skip
        while not self.lines.done and not self.lines.is_at(records.SECTION):
            values = self.lines.record(records.MARKER, self.lines.at, None)
            self.lines.at += 1
            if values is not None:
                self.markers.append((float(floats([str(values[0])])[0]), ints([str(values[1])])[0][0]))
        self.lines.counted(heading, "markers", announced, len(self.markers))

    def _node(self) -> None:
        line = self.lines.at
        number = self._int(records.NODE)
        name = self._value(records.MESH_NAME)
        announced = self._int(records.ENTRIES)
        heading = self.lines.at - 1
        found = 0
        while len(self.lines.labelled_one()):
            self.lines.record(records.KEY_ENTRY, self.lines.at - 1, None)
            if self.lines.done:
                break
            self.lines.skip_blank()
            self.lines.record(records.KEY_SPEED, self.lines.at, None)
            self.lines.at += 1
            found += 1
        self.lines.counted(heading, "entries", announced, found)
        self.nodes.append(KeyNode(number, name, found))
        if not 0 <= number < self.joints:
            self.lines.fault(
                faults.ASSET_INDEX_OUT_OF_RANGE, line,
                f"node {number} ({name}) is moved, but the animation has {numbered(self.joints, 'joint')}",
                "write the number of the model's nodes behind JOINTS; the engine writes beyond its memory",
            )  # fmt: skip

    def _value(self, record: Record) -> str:
        values = self.lines.value(record, (records.SECTION,) if record is not records.SECTION else ())
        if values is None:
            raise _MissingLineError
        return str(values[0])

    def _int(self, record: Record) -> int:
        return ints([self._value(record)])[0][0]
