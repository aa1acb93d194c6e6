"""Opens a compiled level: every array is a view of the file, none is copied."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools._native_file import level_fault, level_parts  # noqa: TID251 (this package is the door)
from jktools.compiler import level_generated as fb
from jktools.compiler.checksum import is_intact
from jktools.compiler.columns import OMISSION, SECTIONS
from jktools.compiler.errors import CompiledFileError
from jktools.compiler.header import Header
from jktools.compiler.held import HeldTemplate, templates_of
from jktools.compiler.leaving import Point
from jktools.compiler.mapping import mapping
from jktools.compiler.queries import plan_of
from jktools.compiler.section import NO_SECTION, TEXTS, Section, layouts, of_table
from jktools.compiler.slots import wanted
from jktools.compiler.text import decoded
from jktools.compiler.walking import Basin, Leave, Ledge, ThingFace, Walking
from jktools.geometry import Plan, SectorMesh, expanded, unpacked

FORMAT_MAJOR, FORMAT_MINOR = 1, 3
"""Version of the format that this code writes; it reads every file of the same major version."""

ALIGNMENT = 8
"""Bytes; a buffer and every vector in it start at a multiple."""

TEXT_SINCE = 2
"""Minor version that brought the strings as one vector."""

ALWAYS = ("resources", "geometry")
"""Sections that every level has; a file without one is refused."""


class CompiledLevel(Header):
    """A compiled level in memory.

    The columns of geometry are attributes of the level itself (`vertices`, `surface_flags`, ...), those of the other
    sections of `resources`, `templates`, `things` and so on; a section that the level did not need is None.
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
        super().__init__(fb.Level.GetRootAs(self.data), path)  # type: ignore[no-untyped-call]
        if verify and not is_intact(self.data):
            raise CompiledFileError(f"cannot read {self.path}: the checksum does not match; build it again")
        parts, steps = level_parts(octets, wanted())
        parts = parts.reshape(len(steps), -1)
        forms = parts[:, 0].tolist()
        sections = {
            name: Section(self.data, (parts, steps), layout)
            for name, layout in layouts(self._root.FormatMinor()).items()
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
        if not self._is_coded:
            return tuple(self._text(octets[a : b - 1]) for a, b in pairwise(start))
        symbols = self._texts.symbols.tobytes().split(b"\0")[:-1]
        return tuple(self._text(decoded(octets[a:b], symbols)) for a, b in pairwise(start))

    @property
    def _is_coded(self) -> bool:
        return len(self._texts.stored.get("symbols", ())) > 0

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

        A frame at which it is as it is placed counts as that. The face is that of its model at rest. An edge without a
        ledge goes on level, or over or against the thing's own faces.
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
        if self.templates is None or not hasattr(self.templates, "value_start"):
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

    @property
    def vertex_step(self) -> float:
        """Of the grid that the vertices are on, JKU; 0 where they are float32 as read."""
        recorded = float(self._root.Settings().VertexStep())
        return recorded or self.geometry.stored["vertices"].step

    @property
    def text_bytes(self) -> int:
        """What the strings take in the file."""
        if self._has_strings:
            return sum(len(self._root.Strings(i)) + 9 for i in range(self._root.StringsLength()))
        return self._texts.nbytes

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
        source = of_table(entry, "source", OMISSION["source"])
        texts = of_table(entry, "name_text", OMISSION["name_text"])
        return {**told, "source": source.tolist(), "name": [self.strings[i] for i in texts.tolist()]}


def open_compiled(path: str | Path, verify: bool = False) -> CompiledLevel:
    """Map a compiled level. Raises CompiledFileError with one sentence on what is wrong.

    Always checks that no offset and no index leads out of the file; `verify` compares the checksum too.
    """
    if not str(path):
        raise CompiledFileError("cannot read an empty path")
    try:
        data = memoryview(mapping(path))
    except ValueError as error:
        raise CompiledFileError(f"cannot read {path}: the file is empty") from error
    except OSError as error:
        raise CompiledFileError(f"cannot read {path}: {(error.strerror or str(error)).lower()}") from error
    return CompiledLevel(data, str(path), verify=verify)
