"""Records of a level's geometry, made on demand over its columns, and what all records have in common."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Generic, TypeVar, overload

import numpy as np

from jktools.diagnostics import Subject
from jktools.source import Span
from jktools.syntax.jkl import Table, records
from jktools.syntax.jkl.document import Float32, Int32
from jktools.syntax.jkl.records import Record

if TYPE_CHECKING:
    from jktools.model.level import Level


class View:
    """One record of a level: its index, its place in the file, and whether the engine drops it."""

    kind = ""
    record: Record

    def __init__(self, level: Level, index: int) -> None:
        """Look at record `index` of `level`."""
        self.level = level
        self.index = index

    def __repr__(self) -> str:
        return f"<{self.title} of {self.level.path}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and (other.level, other.index) == (self.level, self.index)

    def __hash__(self) -> int:
        return hash((type(self), id(self.level), self.index))

    @property
    def _table(self) -> Table:
        raise NotImplementedError

    @property
    def name(self) -> str | None:
        """What it is called, if it has a name."""
        return None

    @property
    def title(self) -> str:
        """For messages: `adjoin 12`."""
        return f"{self.kind} {self.index}"

    @property
    def subject(self) -> Subject:
        """For diagnostics."""
        return Subject(self.kind, self.index, self.name)

    @property
    def line(self) -> int:
        """Its logical line."""
        return int(self._table.lines[self.index])

    @property
    def span(self) -> Span:
        """Its whole line."""
        return self.level.line_span(self.line)

    @property
    def head_span(self) -> Span:
        """The first word of its line: its label or name."""
        whole = self.span
        return whole.source.span(whole.start, whole.start + len(whole.text.split(maxsplit=1)[0]))

    @property
    def broken(self) -> bool:
        """Whether its text could not be read; its values then mean nothing."""
        return bool(self._table.broken[self.index])

    @property
    def dropped(self) -> str | None:
        """Why the engine ignores this record, or None when it does not."""
        return None

    def field_span(self, name: str) -> Span:
        """Where a field stands, by its name in `jktools.syntax.jkl.records`."""
        return self.level.document.field_span(self.record, self.line, self.record.ordinal(name))


ViewT = TypeVar("ViewT", bound=View)


class Records(Sequence[ViewT], Generic[ViewT]):
    """The records of one kind as a sequence of views."""

    def __init__(self, view: Callable[[Level, int], ViewT], level: Level, count: int) -> None:
        """`count` records of `level`, each seen through `view`."""
        self._view, self._level, self._count = view, level, count

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> ViewT: ...
    @overload
    def __getitem__(self, index: slice) -> list[ViewT]: ...
    def __getitem__(self, index: int | slice) -> ViewT | list[ViewT]:
        if isinstance(index, slice):
            return [self._view(self._level, i) for i in range(*index.indices(self._count))]
        if not -self._count <= index < self._count:
            raise IndexError(index)
        return self._view(self._level, index % self._count)

    def __iter__(self) -> Iterator[ViewT]:
        return (self._view(self._level, i) for i in range(self._count))


class Adjoin(View):
    """A portal from one surface to its mirror's."""

    kind = "adjoin"
    record = records.ADJOIN

    @property
    def _table(self) -> Table:
        return self.level.document.adjoins

    @property
    def flags(self) -> int:
        """0x1 visible, 0x2 movement, 0x4 sound, 0x8 not for AI, 0x10 not for the player."""
        return int(self.level.document.adjoins.flags[self.index])

    @property
    def mirror(self) -> int:
        """Index of the adjoin on the other side, as written."""
        return int(self.level.document.adjoins.mirror[self.index])

    @property
    def distance(self) -> float:
        """As written; the engine uses it for sound and light only."""
        return float(self.level.document.adjoins.distance[self.index])

    @property
    def surface(self) -> Surface | None:
        """The surface that carries it."""
        return optional(self.level.surfaces, self.level.adjoin_surface[self.index])

    @property
    def sector(self) -> Sector | None:
        """The sector that it leads into."""
        return optional(self.level.sectors, self.level.adjoin_sector[self.index])


class Surface(View):
    """A polygon of a sector."""

    kind = "surface"
    record = records.SURFACE

    @property
    def _table(self) -> Table:
        return self.level.document.surfaces

    @property
    def title(self) -> str:
        """As editors name it: they count surfaces within a sector."""
        sector = self.sector
        if sector is None:
            return f"surface {self.index}"
        return f"surface {self.index} (sector {sector.index}, surface {self.index - sector.first_surface})"

    @property
    def flags(self) -> int:
        """Surface flags; 0x1 floor, 0x4 collision, ..."""
        return int(self.level.document.surfaces.flags[self.index])

    @property
    def face_flags(self) -> int:
        """Face flags; 0x1 two-sided, 0x2 translucent, ..."""
        return int(self.level.document.surfaces.face_flags[self.index])

    @property
    def material(self) -> int:
        """Index into the materials, -1 for none."""
        return int(self.level.document.surfaces.material[self.index])

    @property
    def adjoin_index(self) -> int:
        """Index of its adjoin as written, -1 for a solid surface."""
        return int(self.level.document.surfaces.adjoin[self.index])

    @property
    def adjoin(self) -> Adjoin | None:
        """Its adjoin."""
        return optional(self.level.adjoins, self.adjoin_index)

    @property
    def sector(self) -> Sector | None:
        """The sector that claims it."""
        return optional(self.level.sectors, self.level.surface_sector[self.index])

    @property
    def vertices(self) -> Int32:
        """(n,) int32: its vertex indices, counter-clockwise seen from inside the sector."""
        table = self.level.document.surfaces
        return table.corner_vertex[table.corner_start[self.index] : table.corner_start[self.index + 1]]

    @property
    def texture_vertices(self) -> Int32:
        """(n,) int32: its texture vertex indices, -1 for none."""
        table = self.level.document.surfaces
        return table.corner_texture_vertex[table.corner_start[self.index] : table.corner_start[self.index + 1]]

    @property
    def light(self) -> Float32:
        """(n,) or (4n,) float32: the intensities as written."""
        table = self.level.document.surfaces
        return table.light[table.light_start[self.index] : table.light_start[self.index + 1]]

    @property
    def positions(self) -> Float32:
        """(n, 3) float32, JKU: where its vertices are. Raises IndexError when one does not exist."""
        return self.level.vertices[self.vertices]

    @property
    def normal(self) -> Float32:
        """(3,) float32: as written, NaN when it is missing."""
        normals = self.level.document.normals.direction
        return normals[self.index] if self.index < len(normals) else np.full(3, np.nan, np.float32)

    def corner_span(self, corner: int, texture: bool = False) -> Span:
        """Where a corner's vertex index stands, or its texture vertex index."""
        ordinal = len(self.record.fields) + 2 * corner + texture
        return self.level.document.field_span(self.record, self.line, ordinal)


class Sector(View):
    """A convex room."""

    kind = "sector"
    record = records.SECTOR_LINES["sector"]

    @property
    def _table(self) -> Table:
        return self.level.document.sectors

    @property
    def flags(self) -> int:
        """0x1 no gravity, 0x2 underwater, 0x8 thrust, 0x40 pit, 0x1000 has a collide box, ..."""
        return int(self.level.document.sectors.flags[self.index])

    @property
    def first_surface(self) -> int:
        """Index of its first surface, as written."""
        return int(self.level.document.sectors.first_surface[self.index])

    @property
    def surface_count(self) -> int:
        """Number of its surfaces, as written."""
        return int(self.level.document.sectors.surface_count[self.index])

    @property
    def surfaces(self) -> list[Surface]:
        """Its surfaces, as far as they exist."""
        first = max(self.first_surface, 0)
        return self.level.surfaces[first : max(first, self.first_surface + self.surface_count)]

    @property
    def vertices(self) -> Int32:
        """(n,) int32: its vertex indices as written."""
        table = self.level.document.sectors
        return table.vertex[table.vertex_start[self.index] : table.vertex_start[self.index + 1]]

    @property
    def positions(self) -> Float32:
        """(n, 3) float32, JKU: where its vertices are. Raises IndexError when one does not exist."""
        return self.level.vertices[self.vertices]

    @property
    def collide_box(self) -> Float32 | None:
        """(2, 3) float32, JKU: least and greatest corner, or None."""
        return _box(self.level.document.sectors.collide_box[self.index])

    @property
    def bound_box(self) -> Float32 | None:
        """(2, 3) float32, JKU: least and greatest corner, or None."""
        return _box(self.level.document.sectors.bound_box[self.index])

    def line_span(self, alias: str, ordinal: int | None = None) -> Span:
        """One of its lines by its name in the grammar (`collide_box`), or one field of it."""
        line = int(self.level.document.sectors.line_of[alias][self.index])
        if line < 0:
            return self.span
        if ordinal is None:
            return self.level.line_span(line)
        return self.level.document.field_span(records.SECTOR_LINES[alias], line, ordinal)

    def vertex_span(self, place: int) -> Span:
        """The entry of its vertex list at `place`."""
        table = self.level.document.sectors
        line = int(table.vertex_lines[table.vertex_start[self.index] + place])
        return self.level.document.field_span(records.SECTOR_VERTEX, line, 1)


def optional(sequence: Records[ViewT], index: int) -> ViewT | None:
    """The record, or None where the index refers to nothing."""
    return sequence[int(index)] if 0 <= index < len(sequence) else None


def _box(corners: Float32) -> Float32 | None:
    return None if np.isnan(corners).any() else corners.reshape(2, 3)
