"""Opens a compiled level: every array is a view of the file, none is copied."""

from __future__ import annotations

import errno
import mmap
import os
import re
import stat
from collections.abc import Mapping
from functools import cache, cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools._native_file import level_fault, level_parts  # noqa: TID251 (this package is the door)
from jktools.compiler import level_generated as fb
from jktools.compiler.checksum import is_intact
from jktools.compiler.columns import OMISSION, SECTIONS, STRINGS, TEXT, Column, camel_case
from jktools.compiler.errors import CompiledFileError
from jktools.compiler.held import HeldTemplate, templates_of
from jktools.compiler.leaving import Point
from jktools.compiler.packing import INDICES, VECTORS, Stored, absent
from jktools.compiler.queries import plan_of
from jktools.compiler.slots import wanted
from jktools.compiler.walking import Basin, Leave, Ledge, ThingFace, Walking
from jktools.geometry import Plan, SectorMesh, expanded, unpacked

FORMAT_MAJOR, FORMAT_MINOR = 1, 2
"""Version of the format that this code writes; it reads every file of the same major version."""

IDENTIFIER = b"JKLB"
ALIGNMENT = 8
"""Bytes; a buffer and every vector in it start at a multiple."""

NO_SECTION, PLAIN, FIRST_VECTOR = -2, 0, 2
"""Forms of a column as `level_parts` tells them."""
_DTYPES: dict[str, np.dtype[Any]] = {kind: np.dtype(f"<{kind}") for kind in ("u1", "i4", "u4", "f4", "f8")}
_OF_VECTORS: list[np.dtype[Any]] = [np.dtype(f"<{kind}") for kind in VECTORS.values()]
_INDICES: dict[int, np.dtype[Any]] = {1: np.dtype("u1"), 2: np.dtype("<u2")}

TEXT_SINCE = 2
"""Minor version that brought the strings as one vector."""

WORLD = (
    "version", "gravity", "ceiling_sky_z", "horizon_distance", "horizon_pixels_per_rev", "horizon_sky_offset",
    "ceiling_sky_offset", "mipmap_distances", "lod_distances", "perspective_distance", "gouraud_distance",
)  # fmt: skip
"""Fields of the table World."""

TEXTS = "strings"
"""Stands for the columns of the strings among sections."""

ALWAYS = ("resources", "geometry")
"""Sections that every level has; a file without one is refused."""


Parts = tuple[npt.NDArray[np.int64], npt.NDArray[np.float64]]
"""What `level_parts` tells, with a row for each column."""


class Layout(NamedTuple):
    """The columns of a section that files of one minor version have."""

    rows: slice
    """Of the section, among those of `level_parts`."""
    columns: tuple[tuple[int, str, Column], ...]
    """Each with its row among them."""
    declared: Mapping[str, Column]


@cache
def _layouts(minor: int) -> dict[str, Layout]:
    """By section, the strings first, in the order in which `level_parts` is asked."""
    found, first = {}, 0
    for name, columns in ((TEXTS, TEXT), *SECTIONS.items()):
        held = tuple(
            (row, key, column)
            for row, (key, column) in enumerate(columns.items())
            if column.since <= minor and (column.until is None or minor <= column.until)
        )
        found[name] = Layout(slice(first, first + len(columns)), held, columns)
        first += len(columns)
    return found


class Section:
    """The columns of one section by name: `(n,)` or `(n, width)`, read-only, of the schema's type.

    A column that the file holds in that type is a view of it; one in a smaller form is made when first asked for and
    kept. `stored` gives the parts as they lie in the file, all of them views.
    """

    def __init__(self, data: memoryview, parts: Parts, layout: Layout) -> None:
        """Hold the columns of a layout, of which `parts` tells where they lie."""
        self._data = data
        self._parts = parts
        self._layout = layout
        self._made: dict[str, npt.NDArray[Any]] = {}

    @cached_property
    def stored(self) -> Mapping[str, Stored]:
        """The columns as they lie in the file; of one that does not, what that stands for."""
        rows, steps = (each[self._layout.rows].tolist() for each in self._parts)
        found = {name: _part(self._data, rows[row], steps[row], column) for row, name, column in self._layout.columns}
        declared = self._layout.declared
        for name in [name for name, stored in found.items() if stored is None]:
            leader = found.get(declared[name].rows_of or "")
            found[name] = absent(declared[name], 0 if leader is None else len(leader))
        return found  # type: ignore[return-value]  # none is absent now

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._made:
            if name in self.stored:
                self._made[name] = self.stored[name].array(self._layout.declared[name])
            elif name in LISTED and "value_list" in self.stored:
                self._made |= _listed(self)
            else:
                raise AttributeError(name)
        return self._made[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.stored]

    @property
    def texts(self) -> frozenset[str]:
        """The columns that count strings."""
        return frozenset(name for name in self.stored if self._layout.declared[name].index_of == STRINGS)

    @property
    def columns(self) -> dict[str, npt.NDArray[Any]]:
        """Every column."""
        return {name: getattr(self, name) for name in self.stored}

    @property
    def nbytes(self) -> int:
        """What its vectors take in the file; one that several columns share counts once."""
        parts = {part.__array_interface__["data"]: part.nbytes for s in self.stored.values() for part in s.vectors}
        return sum(parts.values())


LISTED = ("number_start", "number")
"""The numbers of each value of a template one after the other: what 1.1 has in the file, and later files as lists."""


def _listed(templates: Section) -> dict[str, npt.NDArray[Any]]:
    first = templates.list_start[templates.value_list].astype(np.int64)
    counts = templates.list_start[templates.value_list + 1].astype(np.int64) - first
    start = np.concatenate([[0], np.cumsum(counts)])
    places = np.arange(start[-1]) + np.repeat(first - start[:-1], counts)
    made = {"number_start": start.astype("<u4"), "number": templates.list_number[places]}
    for values in made.values():
        values.flags.writeable = False
    return made


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
    models: Section | None
    files: Section | None

    def __init__(self, data: bytes | memoryview, path: str = "<bytes>", *, verify: bool = False) -> None:
        """Check and view a buffer. Raises CompiledFileError; `verify` compares the checksum too."""
        self.path = path
        self.data = memoryview(data).toreadonly()
        octets = np.frombuffer(self.data, np.uint8)
        if octets.__array_interface__["data"][0] % ALIGNMENT:
            self.data = memoryview(bytes(self.data))
            octets = np.frombuffer(self.data, np.uint8)
        self._refuse(level_fault(octets))
        self._root = fb.Level.GetRootAs(self.data)  # type: ignore[no-untyped-call]
        if verify and not is_intact(self.data):
            raise CompiledFileError(f"cannot read {self.path}: the checksum does not match; build it again")
        parts, steps = level_parts(octets, wanted())
        parts = parts.reshape(len(steps), -1)
        forms = parts[:, 0].tolist()
        sections = {
            name: Section(self.data, (parts, steps), layout)
            for name, layout in _layouts(self._root.FormatMinor()).items()
            if forms[layout.rows.start] != NO_SECTION
        }
        self._texts = sections.pop(TEXTS)
        self.sections: Mapping[str, Section] = sections
        for name in SECTIONS:
            setattr(self, name, sections.get(name))

    def _refuse(self, fault: str) -> None:
        """Raise CompiledFileError for a fault; its cause is what is wrong inside a file that is damaged."""
        if fault:
            inside = re.search(r"\((.*)\)$", fault)
            told = f"cannot read {self.path}: {fault.replace('this reader', 'this jktools')}"
            raise CompiledFileError(told) from (ValueError(inside[1]) if inside else None)

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        if name in SECTIONS["geometry"] and "sections" in self.__dict__:
            found: npt.NDArray[Any] = getattr(self.sections["geometry"], name)
            return found
        raise AttributeError(name)

    def _text(self, data: bytes) -> str:
        try:
            return data.decode()
        except UnicodeDecodeError as error:
            raise CompiledFileError(f"cannot read {self.path}: the file is damaged; build it again") from error

    @property
    def _has_strings(self) -> bool:
        """Whether the strings are a vector each, as up to 1.1."""
        return bool(self._root.FormatMinor() < TEXT_SINCE)

    @cached_property
    def strings(self) -> tuple[str, ...]:
        """Every text of the level."""
        if self._has_strings:
            return tuple(self._text(self._root.Strings(i)) for i in range(self._root.StringsLength()))
        octets, start = self._texts.text.tobytes(), self._texts.text_start.tolist()
        return tuple(self._text(octets[a : b - 1]) for a, b in pairwise(start))

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

    @cached_property
    def plan(self) -> Plan:
        """The geometry as plain arrays."""
        return plan_of(self.geometry)

    @cached_property
    def mesh(self) -> SectorMesh:
        """The sectors as a mesh over the file's own vertices: sight, drop and location, without the level's source.

        At `balanced` and `exact` the file holds the vertices as read, and its mesh answers as the level's own does; a
        file of `fast` answers about vertices on its grid.
        """
        return SectorMesh.from_plan(self.plan)

    @cached_property
    def _walking(self) -> Walking:
        return Walking(self.geometry, self.ledges, self.basins)

    def body_of(self, template: str) -> int:
        """Number of the body of a template, by its name in any case. Raises KeyError for one that has none."""
        return self._walking.body_of(template, self.strings)

    def ledges_at(self, body: int, surface: int, corner: int, place: float | None = None) -> list[Ledge]:
        """What a body meets beyond the edge that goes from a corner of a floor to the next one, along the edge.

        With `place`, 0 .. 1 along the edge, the first that holds it. An edge, or a part of one, without a ledge goes
        on level. Raises IndexError for a body that the file does not have.
        """
        return self._walking.at(body, (surface, corner), place)

    def ledges_of_thing(
        self, body: int, thing: int, frame: int, face: int, corner: int, place: float | None = None
    ) -> list[Ledge]:
        """The same beyond an edge of a face of a thing (source index) where it is placed (-1) or at one of its frames.

        A frame at which it is as it is placed counts as that. The face is that of its model at rest.
        """
        return self._walking.at(body, (thing, frame, face, corner), place)

    def leave(self, body: int, floor: int | ThingFace, origin: Point, target: Point) -> Leave:
        """What comes of a body that moves straight over the floor that it stands on, a surface or a face of a thing.

        By which edge it leaves it, seen from above, and what it comes onto there. Both points are its position, x y z,
        JKU. The way starts over the floor or on an edge of it; of another way, of coordinates that are not finite or
        2^150 or more, and of what is no floor, the kind is UNKNOWN. Raises IndexError for a body that the file does not
        have.
        """
        return self._walking.leave(body, floor, origin, target)

    def basins_of(self, body: int) -> list[Basin]:
        """Where a body can fall in and every way out goes up; none for a body that the file does not have."""
        return list(self._walking.basins_of(body))

    def basin_at(self, body: int, surface: int) -> Basin | None:
        """The basin of a body that holds a surface."""
        return next((each for each in self._walking.basins_of(body) if surface in each.surfaces), None)

    def template(self, name: str) -> HeldTemplate | None:
        """The template of a name, free of case, of those that the file has; the first, as in the engine."""
        return self._templates_by_name.get(name.lower())

    @cached_property
    def _templates_by_name(self) -> dict[str, HeldTemplate]:
        if self.templates is None or "value_start" not in self.templates.stored:
            return {}
        found: dict[str, HeldTemplate] = {}
        for held in templates_of(self.templates, self.strings):
            found.setdefault(held.name.lower(), held)
        return found

    def insert_offset(self, model: str) -> tuple[float, float, float] | None:
        """Where a model's origin lies from the place of its thing, x y z in JKU; None for one that the file lacks."""
        return self._insert_offsets.get(model.lower())

    @cached_property
    def _insert_offsets(self) -> dict[str, tuple[float, float, float]]:
        if self.models is None:
            return {}
        names = (self.strings[i] for i in self.models.name.tolist())
        return {name: (x, y, z) for name, (x, y, z) in zip(names, self.models.insert_offset.tolist(), strict=True)}

    def why_absent(self, section: str) -> str:
        """Why the file does not have a section, as the pass that computes it noted."""
        state = self.passes.get(section)
        return (state and state["note"]) or f"jktools {self.tool_version} did not write it"

    @property
    def vertex_step(self) -> float:
        """Of the grid that the vertices are on, JKU; 0 where they are float32 as read."""
        return self.geometry.stored["vertices"].step

    @property
    def text_bytes(self) -> int:
        """What the strings take in the file."""
        if self._has_strings:
            return sum(len(self._root.Strings(i)) + 9 for i in range(self._root.StringsLength()))
        return self._texts.nbytes

    @property
    def world(self) -> dict[str, Any]:
        """The header lines of the level, by their names in the schema."""
        world = self._root.World()
        if world is None:
            return {}
        found: dict[str, Any] = {}
        for name in WORLD:
            vector = getattr(world, f"{camel_case(name)}AsNumpy", None)
            value = getattr(world, camel_case(name))() if vector is None else vector()
            found[name] = [] if vector is not None and isinstance(value, int) else value
        return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in found.items()}

    @property
    def format(self) -> str:
        """Version of the file format, `major.minor`."""
        return f"{self._root.FormatMajor()}.{self._root.FormatMinor()}"

    @property
    def format_minor(self) -> int:
        """The minor version of the file format."""
        return int(self._root.FormatMinor())

    @property
    def tool_version(self) -> str:
        """Version of the jktools that wrote it."""
        return self._text(self._root.ToolVersion())

    @property
    def checksum(self) -> str:
        """As stored, in hex."""
        return bytes(self._root.ChecksumAsNumpy()).hex()

    @property
    def source(self) -> tuple[str, str]:
        """Path inside the pack, and SHA-256 in hex, of the level that it was made from."""
        path, digest = next(iter(self._sources), ("", ""))
        return path, digest

    @property
    def _sources(self) -> list[tuple[str, str]]:
        entries = [self._root.Inputs(i) for i in range(self._root.InputsLength())]
        return [(self._text(e.Path()), bytes(e.Sha256AsNumpy()).hex()) for e in entries]

    @property
    def inputs(self) -> list[tuple[str, str]]:
        """Path and SHA-256 in hex of each file that it was made from: the level's source, then the others.

        Paths are those of the game, as `cog/door.cog`; the source's is that inside its pack, or its base name. Files
        before 1.2 list the source alone.
        """
        return [*self._sources, *((path, digest) for path, digest in self._looked_for if digest is not None)]

    @property
    def missing_inputs(self) -> list[str]:
        """Names that were looked for and that no file had: where one is added, the level may become another."""
        return [path for path, digest in self._looked_for if digest is None]

    @cached_property
    def _looked_for(self) -> list[tuple[str, str | None]]:
        files = self.files
        if files is None:
            return []
        if int(files.found.astype(bool).sum()) != len(files.sha256):
            raise CompiledFileError(f"cannot read {self.path}: the file is damaged; build it again")
        digests = iter(files.sha256)
        names, folders = ([self.strings[i] for i in column.tolist()] for column in (files.name, files.folder))
        return [
            (f"{folder}/{name}" if folder else name, next(digests).tobytes().hex() if found else None)
            for folder, name, found in zip(folders, names, files.found.tolist(), strict=True)
        ]

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
    def cut_anyway(self) -> bool:
        """Whether it leaves out templates and names that nothing is known to reach."""
        return bool(self._root.Settings().CutAnyway())

    @property
    def only(self) -> list[str]:
        """The passes that alone were asked for; none for all, and for files before 1.2, which do not tell."""
        settings = self._root.Settings()
        return [self._text(settings.Only(i)) for i in range(settings.OnlyLength())]

    @property
    def skip(self) -> list[str]:
        """The passes that were not to run; none for files before 1.2, which do not tell."""
        settings = self._root.Settings()
        return [self._text(settings.Skip(i)) for i in range(settings.SkipLength())]

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
            "models": ("models", "name"),
        }
        return {
            kind: len(self.sections[section].stored[column]) if section in self.sections else 0
            for kind, (section, column) in counted.items()
        }

    @property
    def omissions(self) -> list[dict[str, Any]]:
        """What was left out: section, reason, and for each record its position and name."""
        return [self._omission(self._root.Omissions(i)) for i in range(self._root.OmissionsLength())]

    def _omission(self, entry: Any) -> dict[str, Any]:
        told = {"section": self._text(entry.Section()), "reason": self._text(entry.Reason())}
        if self._has_strings:
            names = [self._text(entry.Name(i)) for i in range(entry.NameLength())]
            return {**told, "source": [int(entry.Source(i)) for i in range(entry.SourceLength())], "name": names}
        source = _of_table(entry, "source", OMISSION["source"])
        texts = _of_table(entry, "name_text", OMISSION["name_text"])
        return {**told, "source": source.tolist(), "name": [self.strings[i] for i in texts.tolist()]}

    @property
    def passes(self) -> dict[str, dict[str, Any]]:
        """Which passes ran, and which failed; `note` says why one did not run."""
        entries = [self._root.Passes(i) for i in range(self._root.PassesLength())]
        return {
            self._text(e.Name()): {
                "ran": bool(e.Ran()),
                "failed": bool(e.Failed()),
                "note": None if e.Note() is None else self._text(e.Note()),
            }
            for e in entries
        }


def _part(data: memoryview, row: list[int], step: float, column: Column) -> Stored | None:
    """A column as it lies in the file, by a row of `level_parts`; None where it is absent."""
    form, place, length, index_size, index_place, index_length, count, first, origin_place, origin_length = row
    if form < PLAIN:
        return None
    width = column.width
    shape = length if width == 1 else (length // width, width)
    if form == PLAIN:
        return Stored(np.ndarray(shape, _DTYPES[column.type], data, place))
    values = None if form < FIRST_VECTOR else np.ndarray(shape, _OF_VECTORS[form - FIRST_VECTOR], data, place)
    index = np.ndarray(index_length, _INDICES[index_size], data, index_place) if index_size else None
    origin = tuple(np.ndarray(origin_length, _DTYPES["i4"], data, origin_place).tolist()) if origin_length else ()
    return Stored(values, index, count, first, step, origin)


def _of_table(table: Any, name: str, column: Column) -> npt.NDArray[Any]:
    """A column of a table that is no section."""
    field = camel_case(name)
    if not getattr(table, f"{field}IsNone")():
        return Stored(getattr(table, f"{field}AsNumpy")()).array(column)
    packed = getattr(table, f"{field}Packed")()
    if packed is None:
        return absent(column, 0).array(column)
    values, index = (
        next(
            (getattr(packed, f"{v}AsNumpy")() for v in map(camel_case, names) if not getattr(packed, f"{v}IsNone")()),
            None,
        )
        for names in (VECTORS, INDICES)
    )
    return Stored(values, index, packed.Count(), packed.First()).array(column)


def mapping(path: str | Path) -> mmap.mmap:
    """Map a file for reading. Raises OSError, and ValueError for an empty file."""
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0))
    try:
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        return mmap.mmap(descriptor, 0, access=mmap.ACCESS_READ)
    finally:
        os.close(descriptor)


def open_compiled(path: str | Path, verify: bool = False) -> CompiledLevel:
    """Map a compiled level. Raises CompiledFileError with one sentence on what is wrong.

    Always checks that no offset and no index leads out of the file; `verify` compares the checksum too.
    """
    try:
        data = memoryview(mapping(path))
    except ValueError as error:
        raise CompiledFileError(f"cannot read {path}: the file is empty") from error
    except OSError as error:
        raise CompiledFileError(f"cannot read {path}: {(error.strerror or str(error)).lower()}") from error
    return CompiledLevel(data, str(path), verify=verify)
