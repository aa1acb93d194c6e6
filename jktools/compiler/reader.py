"""Opens a compiled level: every array is a view of the file, none is copied."""

from __future__ import annotations

import mmap
from collections.abc import Mapping
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools._native_file import verify_level  # noqa: TID251 (this package is the door)
from jktools.compiler import level_generated as fb
from jktools.compiler.checksum import is_intact
from jktools.compiler.columns import OMISSION, SECTIONS, TEXT, Column, camel_case
from jktools.compiler.errors import CompiledFileError
from jktools.compiler.packing import INDICES, VECTORS, Stored, absent
from jktools.compiler.queries import Basin, Ledge, basins_of, ledges_at, plan_of
from jktools.compiler.ranges import columns_fault, first_fault, text_fault
from jktools.geometry import SectorMesh, expanded, unpacked

FORMAT_MAJOR, FORMAT_MINOR = 1, 2
"""Version of the format that this code writes; it reads every file of the same major version."""

IDENTIFIER = b"JKLB"
_SMALLEST = 8

TEXT_SINCE = 2
"""Minor version that brought the strings as one vector."""

WORLD = (
    "version", "gravity", "ceiling_sky_z", "horizon_distance", "horizon_pixels_per_rev", "horizon_sky_offset",
    "ceiling_sky_offset", "mipmap_distances", "lod_distances", "perspective_distance", "gouraud_distance",
)  # fmt: skip
"""Fields of the table World."""

ALWAYS = ("resources", "geometry")
"""Sections that every level has."""


class Section:
    """The columns of one section by name: `(n,)` or `(n, width)`, read-only, of the schema's type.

    A column that the file holds in that type is a view of it; one in a smaller form is made when first asked for and
    kept. `stored` gives the parts as they lie in the file, all of them views.
    """

    def __init__(self, stored: Mapping[str, Stored], columns: Mapping[str, Column]) -> None:
        """Hold these columns."""
        self.stored = stored
        self._declared = columns
        self._made: dict[str, npt.NDArray[Any]] = {}

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._made:
            if name in self.stored:
                self._made[name] = self.stored[name].array(self._declared[name])
            elif name in LISTED and "value_list" in self.stored:
                self._made |= _listed(self)
            else:
                raise AttributeError(name)
        return self._made[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.stored]

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

    def __init__(self, data: bytes | memoryview, path: str = "<bytes>", *, verify: bool = False) -> None:
        """Check and view a buffer. Raises CompiledFileError; `verify` compares the checksum too."""
        self.path = path
        self.data = memoryview(data)
        self._root = self._checked_root(verify)
        self._text_columns = self._columns(self._root, TEXT) if self._root.FormatMinor() >= TEXT_SINCE else None
        stored = {
            name: self._columns(table, columns)
            for name, columns in SECTIONS.items()
            if (table := getattr(self._root, camel_case(name))()) is not None
        }
        fault = self._fault(stored)
        if fault:
            raise CompiledFileError(f"cannot read {path}: {self._damage}") from ValueError(fault)
        self.sections: Mapping[str, Section] = {name: Section(each, SECTIONS[name]) for name, each in stored.items()}
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

    @property
    def _damage(self) -> str:
        if self._root.FormatMinor() > FORMAT_MINOR:
            return (
                f"it is of format {self.format}, and this jktools reads up to {FORMAT_MAJOR}.{FORMAT_MINOR} of it; "
                "use a newer version"
            )
        return "the file is damaged; build it again"

    def _fault(self, stored: Mapping[str, Mapping[str, Stored]]) -> str | None:
        missing = next((name for name in ALWAYS if name not in stored), None)
        if missing:
            return f"has no {missing}"
        strings = self._root.StringsLength()
        if self._text_columns is not None:
            fault = text_fault(self._text_columns, len(self.data))
            if fault:
                return fault
            strings = len(self._text_columns["text_start"]) - 1
        fault = first_fault(stored, strings, len(self.data))
        if fault is None and self._text_columns is not None:
            fault = next(
                (each for i in range(self._root.OmissionsLength()) if (each := self._omission_fault(i, strings))), None
            )
        return fault

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        if name in SECTIONS["geometry"] and "sections" in self.__dict__:
            found: npt.NDArray[Any] = getattr(self.sections["geometry"], name)
            return found
        raise AttributeError(name)

    def _columns(self, table: Any, columns: Mapping[str, Column]) -> dict[str, Stored]:
        minor = self._root.FormatMinor()
        stored = {
            name: _stored(table, name, column)
            for name, column in columns.items()
            if column.since <= minor and (column.until is None or minor <= column.until)
        }
        found: dict[str, Stored] = {}
        for name, form in stored.items():
            leader = stored.get(columns[name].rows_of or "")
            found[name] = absent(columns[name], 0 if leader is None else len(leader)) if form is None else form
        return found

    def _text(self, data: bytes) -> str:
        try:
            return data.decode()
        except UnicodeDecodeError as error:
            raise CompiledFileError(f"cannot read {self.path}: the file is damaged; build it again") from error

    @cached_property
    def strings(self) -> tuple[str, ...]:
        """Every text of the level."""
        if self._text_columns is None:
            return tuple(self._text(self._root.Strings(i)) for i in range(self._root.StringsLength()))
        octets = self._text_columns["text"].array(TEXT["text"]).tobytes()
        start = self._text_columns["text_start"].array(TEXT["text_start"]).tolist()
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
    def mesh(self) -> SectorMesh:
        """The sectors as a mesh over the file's own vertices: sight, drop and location, without the level's source.

        At `balanced` and `exact` the file holds the vertices as read, and its mesh answers as the level's own does; a
        file of `fast` answers about vertices on its grid.
        """
        return SectorMesh.from_plan(plan_of(self.geometry))

    def ledges_at(self, body: int, surface: int, corner: int, place: float | None = None) -> list[Ledge]:
        """What a body meets beyond the edge that goes from a corner of a floor to the next one, along the edge.

        With `place`, 0 .. 1 along the edge, the first that holds it. An edge, or a part of one, without a ledge goes
        on level. Raises IndexError for a body that the file does not have.
        """
        if self.ledges is None:
            raise IndexError(f"body {body} does not exist: there are 0")
        found = list(ledges_at(self.ledges, body, surface, corner))
        return found if place is None else [each for each in found if each.start <= place <= each.end][:1]

    def basins_of(self, body: int) -> list[Basin]:
        """Where a body can fall in and every way out goes up; none for a body that the file does not have."""
        return [] if self.basins is None else list(basins_of(self.basins, body))

    @property
    def vertex_step(self) -> float:
        """Of the grid that the vertices are on, JKU; 0 where they are float32 as read."""
        return self.geometry.stored["vertices"].step

    @property
    def text_bytes(self) -> int:
        """What the strings take in the file."""
        if self._text_columns is None:
            return sum(len(self._root.Strings(i)) + 9 for i in range(self._root.StringsLength()))
        return Section(self._text_columns, TEXT).nbytes

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
        if self._text_columns is None:
            names = [self._text(entry.Name(i)) for i in range(entry.NameLength())]
            return {**told, "source": [int(entry.Source(i)) for i in range(entry.SourceLength())], "name": names}
        stored = self._columns(entry, OMISSION)
        found = {name: stored[name].array(column).tolist() for name, column in OMISSION.items()}
        return {**told, "source": found["source"], "name": [self.strings[i] for i in found["name_text"]]}

    def _omission_fault(self, place: int, strings: int) -> str | None:
        stored = self._columns(self._root.Omissions(place), OMISSION)
        return columns_fault({"omission": OMISSION}, {"omission": stored}, strings, len(self.data))

    @property
    def passes(self) -> dict[str, dict[str, Any]]:
        """Which passes ran; `note` says why one did not."""
        entries = [self._root.Passes(i) for i in range(self._root.PassesLength())]
        return {
            self._text(e.Name()): {"ran": e.Ran(), "note": None if e.Note() is None else self._text(e.Note())}
            for e in entries
        }


def _stored(table: Any, name: str, column: Column) -> Stored | None:
    """A column as it lies in the file, None where it is absent; what is wrong with it the range check tells."""
    field = camel_case(name)
    plain = _vector(table, field)
    if plain is not None:
        return Stored(_in_rows(plain, column))
    if not hasattr(table, f"{field}Packed"):  # Level.text, which every language reads in place
        return None
    packed = getattr(table, f"{field}Packed")()
    if packed is None:
        return None
    values = next((v for kind in VECTORS if (v := _vector(packed, camel_case(kind))) is not None), None)
    index = next((v for kind in INDICES if (v := _vector(packed, camel_case(kind))) is not None), None)
    origin = _vector(packed, "Origin")
    return Stored(
        None if values is None else _in_rows(values, column), index, packed.Count(), packed.First(), packed.Step(),
        () if origin is None else tuple(origin.tolist()),
    )  # fmt: skip


def _vector(table: Any, field: str) -> npt.NDArray[Any] | None:
    if getattr(table, f"{field}IsNone")():
        return None
    values: npt.NDArray[Any] = getattr(table, f"{field}AsNumpy")()
    values.flags.writeable = False
    return values


def _in_rows(values: npt.NDArray[Any], column: Column) -> npt.NDArray[Any]:
    if column.width == 1:
        return values
    return values[: len(values) // column.width * column.width].reshape(-1, column.width)


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
