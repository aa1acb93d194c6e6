"""Opens a compiled level: every array is a view of the file, none is copied."""

from __future__ import annotations

import mmap
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools._native_file import verify_level  # noqa: TID251 (this package is the door)
from jktools.compiler import level_generated as fb
from jktools.compiler.checksum import is_intact
from jktools.compiler.columns import SECTIONS, Column, camel_case
from jktools.compiler.errors import CompiledFileError
from jktools.compiler.ranges import first_fault
from jktools.geometry import expanded, unpacked

FORMAT_MAJOR, FORMAT_MINOR = 1, 1
"""Version of the format that this code writes; it reads every file of the same major version."""

IDENTIFIER = b"JKLB"
_SMALLEST = 8

ALWAYS = ("resources", "geometry")
"""Sections that every level has."""


class Section:
    """The columns of one section by name: `(n,)` or `(n, width)` views, read-only."""

    def __init__(self, columns: Mapping[str, npt.NDArray[Any]]) -> None:
        """Hold these columns."""
        self.columns = columns

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        try:
            return self.columns[name]
        except KeyError:
            raise AttributeError(name) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.columns]


class CompiledLevel:
    """A compiled level in memory.

    The columns of geometry are attributes of the level itself (`vertices`, `surface_flags`, ...), those of the
    other sections of `resources`, `templates`,
    `things`, `cogs`, `ledges` and `basins`; a section that the level did not need is None.
    grammars/level.fbs says what each holds.
    """

    geometry: Section
    resources: Section
    templates: Section | None
    things: Section | None
    cogs: Section | None
    visibility: Section | None
    hotspots: Section | None
    lights: Section | None
    particles: Section | None
    colour_effects: Section | None
    motion: Section | None
    ledges: Section | None
    basins: Section | None

    def __init__(self, data: bytes | memoryview, path: str = "<bytes>", *, verify: bool = False) -> None:
        """Check and view a buffer. Raises CompiledFileError; `verify` compares the checksum too."""
        self.path = path
        self.data = memoryview(data)
        self._root = self._checked_root(verify)
        arrays = {name: self._columns(name) for name in SECTIONS if self._table(name) is not None}
        missing = next((name for name in ALWAYS if name not in arrays), None)
        fault = f"has no {missing}" if missing else first_fault(arrays, self._root.StringsLength())
        if fault:
            raise CompiledFileError(f"cannot read {path}: the file is damaged") from ValueError(fault)
        self.sections: Mapping[str, Section] = {name: Section(columns) for name, columns in arrays.items()}
        for name in SECTIONS:
            setattr(self, name, self.sections.get(name))

    def _checked_root(self, verify: bool) -> Any:
        octets = np.frombuffer(self.data, np.uint8)
        if len(octets) < _SMALLEST or bytes(self.data[4:8]) != IDENTIFIER:
            raise CompiledFileError(f"cannot read {self.path}: not a compiled level (no {IDENTIFIER.decode()} mark)")
        if not verify_level(octets):
            raise CompiledFileError(f"cannot read {self.path}: the file is cut off or damaged; build it again")
        root = fb.Level.GetRootAs(self.data)  # type: ignore[no-untyped-call]
        if root.FormatMajor() != FORMAT_MAJOR:
            raise CompiledFileError(
                f"cannot read {self.path}: format version {root.FormatMajor()}.{root.FormatMinor()}, but this jktools "
                f"reads {FORMAT_MAJOR}.x; build it again or use another version"
            )
        if verify and not is_intact(self.data):
            raise CompiledFileError(f"cannot read {self.path}: the checksum does not match; build it again")
        return root

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        if name in SECTIONS["geometry"] and "sections" in self.__dict__:
            return self.sections["geometry"].columns[name]
        raise AttributeError(name)

    def _table(self, section: str) -> Any:
        return getattr(self._root, camel_case(section))()

    def _columns(self, section: str) -> dict[str, npt.NDArray[Any]]:
        table = self._table(section)
        minor = self._root.FormatMinor()
        return {name: _view(table, name, column) for name, column in SECTIONS[section].items() if column.since <= minor}

    def _text(self, data: bytes) -> str:
        try:
            return data.decode()
        except UnicodeDecodeError as error:
            raise CompiledFileError(f"cannot read {self.path}: the file is damaged; build it again") from error

    @cached_property
    def strings(self) -> tuple[str, ...]:
        """Every text of the level."""
        return tuple(self._text(self._root.Strings(i)) for i in range(self._root.StringsLength()))

    @cached_property
    def visible_sectors(self) -> npt.NDArray[np.bool_] | None:
        """Which sectors can be seen from which, (n, n): row a, column b. None for a file without that section.

        Expanded when first asked for. Raises CompiledFileError when a row is damaged.
        """
        if self.visibility is None:
            return None
        count = len(self.geometry.sector_flags)
        matrix = np.zeros((count, (count + 7) // 8), np.uint8)
        start, data = self.visibility.row_start, self.visibility.row.tobytes()
        try:
            for i, sector in enumerate(self.visibility.sector):
                matrix[sector] = np.frombuffer(expanded(data[start[i] : start[i + 1]], matrix.shape[1]), np.uint8)
        except ValueError as error:
            raise CompiledFileError(f"cannot read {self.path}: the file is damaged; build it again") from error
        return unpacked(matrix)

    @property
    def format(self) -> str:
        """Version of the file format, `major.minor`."""
        return f"{self._root.FormatMajor()}.{self._root.FormatMinor()}"

    @property
    def tool_version(self) -> str:
        """Version of the jktools that wrote it."""
        return self._text(self._root.ToolVersion())

    @property
    def checksum(self) -> str:
        """As stored, in hex."""
        return bytes(self._root.ChecksumAsNumpy()).hex()

    @property
    def inputs(self) -> list[tuple[str, str]]:
        """Path inside the pack and SHA-256 of each file that it was made from."""
        entries = [self._root.Inputs(i) for i in range(self._root.InputsLength())]
        return [(self._text(e.Path()), bytes(e.Sha256AsNumpy()).hex()) for e in entries]

    @property
    def settings(self) -> dict[str, str]:
        """What it was compiled for."""
        settings = self._root.Settings()
        return {
            "game": self._text(settings.Game()),
            "engine": self._text(settings.Engine()),
            "accuracy": self._text(settings.Accuracy()),
        }

    @property
    def counts(self) -> dict[str, int]:
        """How many of each kind of object it holds."""
        counted = {
            "vertices": ("geometry", "vertices"),
            "texture_vertices": ("geometry", "texture_vertices"),
            "surfaces": ("geometry", "surface_flags"),
            "sectors": ("geometry", "sector_flags"),
            "adjoins": ("geometry", "adjoin_flags"),
            "templates": ("templates", "source"),
            "things": ("things", "source"),
            "cogs": ("cogs", "source"),
            "hotspots": ("hotspots", "cog"),
            "lights": ("lights", "thing"),
            "particles": ("particles", "template"),
            "colour_effects": ("colour_effects", "cog"),
            "motions": ("motion", "template"),
            "bodies": ("ledges", "body_movesize"),
            "ledges": ("ledges", "surface"),
            "basins": ("basins", "body"),
        }
        return {
            kind: len(self.sections[section].columns[column]) if section in self.sections else 0
            for kind, (section, column) in counted.items()
        }

    @property
    def omissions(self) -> list[dict[str, Any]]:
        """What was left out: section, reason, and for each record its position and name."""
        entries = [self._root.Omissions(i) for i in range(self._root.OmissionsLength())]
        return [
            {
                "section": self._text(e.Section()),
                "reason": self._text(e.Reason()),
                "source": [int(e.Source(i)) for i in range(e.SourceLength())],
                "name": [self._text(e.Name(i)) for i in range(e.NameLength())],
            }
            for e in entries
        ]

    @property
    def passes(self) -> dict[str, dict[str, Any]]:
        """Which passes ran; `note` says why one did not."""
        entries = [self._root.Passes(i) for i in range(self._root.PassesLength())]
        return {
            self._text(e.Name()): {"ran": e.Ran(), "note": None if e.Note() is None else self._text(e.Note())}
            for e in entries
        }


def _view(table: Any, name: str, column: Column) -> npt.NDArray[Any]:
    values = getattr(table, f"{camel_case(name)}AsNumpy")()
    if isinstance(values, int):  # the generated code answers 0 for a vector that is absent
        values = np.zeros(0, f"<{column.type}")
    values.flags.writeable = False
    if column.width == 1:
        return np.asarray(values)
    return np.asarray(values[: len(values) // column.width * column.width].reshape(-1, column.width))


def open_compiled(path: str | Path, verify: bool = False) -> CompiledLevel:
    """Map a compiled level. Raises CompiledFileError with one sentence on what is wrong.

    Always checks that no offset and no index leads out of the file; `verify` compares the checksum too.
    """
    file = Path(path)
    try:
        with file.open("rb") as stream:
            if file.stat().st_size == 0:
                raise CompiledFileError(f"cannot read {path}: the file is empty")
            data = memoryview(mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ))
    except OSError as error:
        raise CompiledFileError(f"cannot read {path}: {(error.strerror or str(error)).lower()}") from error
    return CompiledLevel(data, str(path), verify=verify)
