"""A level: the columns of its document, and what they refer to."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from jktools.diagnostics import Diagnostic
from jktools.model.objects import Cog, Template, Thing
from jktools.model.resolved import Resolved
from jktools.model.resources import Resources
from jktools.model.templates import TemplateSet
from jktools.model.views import Adjoin, Records, Sector, Surface
from jktools.source import InputError, Source, Span
from jktools.syntax.jkl import Document, Header, read
from jktools.syntax.jkl.document import Bool, Float32, Int32
from jktools.syntax.jkl.reader import GEOMETRY

MOST_CORNERS = 24
"""Corners of one surface (sithSurface_Load in the decompiled engine)."""

NONE = -1
"""An index that refers to nothing."""


class Level:
    """One JKL as the engine would hold it, with everything that it drops still at hand.

    Sequences have one entry a record as written; an entry that the engine drops says why in `dropped`. Large
    sections are columns in `document`; records are views made on demand.
    """

    def __init__(self, document: Document, resources: Resources | None = None) -> None:
        """Resolve the references of a document. Never raises: what points nowhere resolves to -1.

        `resources` are the files that it can name; without them none is found.
        """
        self.document = document
        self.resources = resources or Resources()
        self.kept: dict[type, object] = {}
        """What higher layers keep with the level, one of a type; no part of it."""

    def anew(self) -> Level:
        """The same level, of which nothing is worked out and no file looked for yet."""
        return Level(self.document, self.resources.anew())

    def __repr__(self) -> str:
        return (
            f"Level({self.path!r}, {len(self.sectors)} sectors, {len(self.surfaces)} surfaces, "
            f"{len(self.things)} things)"
        )

    # ---- the file

    @property
    def path(self) -> str:
        """Where it was read from."""
        return self.source.path

    @property
    def source(self) -> Source:
        """Its bytes."""
        return self.document.source

    @property
    def game(self) -> str:
        """`jk` or `mots`."""
        return self.document.game

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """What reading found."""
        return self.document.diagnostics

    @property
    def has_geometry(self) -> bool:
        """False for static.jkl, which holds resources and templates only."""
        return GEOMETRY in self.document.sections

    def line_span(self, line: int) -> Span:
        """The bytes of a logical line."""
        return self.document.lines.span(line)

    # ---- header and lists

    @property
    def header(self) -> Header:
        """The HEADER section."""
        return self.document.header

    def names(self, key: str) -> tuple[str, ...]:
        """A plain list by its key in `Document.lists`: `materials`, `sounds`, `models`, ..."""
        return self.document.lists[key].names

    @property
    def materials(self) -> tuple[str, ...]:
        """The MATERIALS list; surfaces count it."""
        return self.names("materials")

    @property
    def colormaps(self) -> tuple[str, ...]:
        """The colormaps of GEORESOURCE; sectors count it."""
        return self.names("colormaps")

    # ---- records

    @property
    def vertices(self) -> Float32:
        """(n, 3) float32, JKU; NaN for a vertex that could not be read."""
        return self.document.vertices.position

    @property
    def texture_vertices(self) -> Float32:
        """(n, 2) float32, texels."""
        return self.document.texture_vertices.coordinate

    @cached_property
    def surfaces(self) -> Records[Surface]:
        """The surfaces as written."""
        return Records(Surface, self, len(self.document.surfaces))

    @cached_property
    def sectors(self) -> Records[Sector]:
        """The sectors as written."""
        return Records(Sector, self, len(self.document.sectors))

    @cached_property
    def adjoins(self) -> Records[Adjoin]:
        """The adjoins as written."""
        return Records(Adjoin, self, len(self.document.adjoins))

    @cached_property
    def things(self) -> Records[Thing]:
        """The things as placed."""
        return Records(Thing, self, len(self.document.things))

    @cached_property
    def templates(self) -> Records[Template]:
        """The templates as written."""
        return Records(Template, self, len(self.document.templates))

    @cached_property
    def cogs(self) -> Records[Cog]:
        """The placed COGs."""
        return Records(Cog, self, len(self.document.cogs))

    # ---- references

    @cached_property
    def surface_sector(self) -> Int32:
        """(surfaces,) int32: the sector that claims each surface; the last where several do, -1 where none does."""
        owner = np.full(len(self.surfaces), NONE, np.int32)
        table = self.document.sectors
        for sector, (first, count) in enumerate(
            zip(table.first_surface.tolist(), table.surface_count.tolist(), strict=True)
        ):
            if first >= 0 and count > 0:
                owner[first : first + count] = sector
        return owner

    @cached_property
    def adjoin_surface(self) -> Int32:
        """(adjoins,) int32: the surface that carries each adjoin; the last where several do, -1 where none does."""
        carrier = np.full(len(self.adjoins), NONE, np.int32)
        used = self.document.surfaces.adjoin
        surfaces = np.flatnonzero((used >= 0) & (used < len(carrier)))
        carrier[used[surfaces]] = surfaces  # assignment in order: the last one wins
        return carrier

    @cached_property
    def mirror_surface(self) -> Int32:
        """(adjoins,) int32: the surface on the other side of each adjoin, -1 where there is none."""
        mirror = self.document.adjoins.mirror
        return _take(self.adjoin_surface, mirror)

    @cached_property
    def adjoin_sector(self) -> Int32:
        """(adjoins,) int32: the sector that each adjoin leads into, -1 where there is none."""
        return _take(self.surface_sector, self.mirror_surface)

    @cached_property
    def template_by_name(self) -> dict[str, int]:
        """Template index by lower-case name: the first of a name wins, as in the engine."""
        index: dict[str, int] = {}
        for i, name in enumerate(self.document.templates.names):
            index.setdefault(name.lower(), i)
        return index

    @cached_property
    def game_templates(self) -> frozenset[str]:
        """Names of the templates of the game's static.jkl, in lower case; none where no base holds it."""
        return frozenset() if self.static is None else frozenset(self.static.template_by_name)

    @property
    def nobody_defines(self) -> str:
        """What a message says of a template that neither level nor static.jkl has; empty where that is not at hand."""
        return "" if self.static is None else f"neither the level nor {self.static.path} defines one of that name"

    @cached_property
    def resolved_templates(self) -> TemplateSet:
        """The templates with all that they inherit, as the engine holds them."""
        heading = self.document.templates.heading
        return TemplateSet(
            self.templates,
            None if heading is None else heading.count,
            game=self.game,
            base=None if self.static is None else self.static.resolved_templates,
            radius_of=self._radius_of,
        )

    @cached_property
    def static(self) -> Level | None:
        """The game's static.jkl, which the engine reads before any level; None where no base holds one."""
        found = self.resources.static
        if found is None or found.path == self.path or not self.has_geometry:
            return None
        try:
            return Level(read(self.resources.read(found), self.game))
        except InputError:
            return None

    def _radius_of(self, name: str) -> float | None:
        model = self.resources.model(name)
        return None if model is None else model.radius

    @cached_property
    def resolved_things(self) -> tuple[Resolved, ...]:
        """The things with all that their templates give them."""
        return tuple(self.resolved_templates.thing(thing) for thing in self.things)

    # ---- geometry that can be computed with

    @cached_property
    def finite_vertices(self) -> Bool:
        """(vertices,) bool: vertices that were read and lie within float32."""
        return np.asarray(np.isfinite(self.vertices).all(axis=1))

    @cached_property
    def sound_surfaces(self) -> Bool:
        """(surfaces,) bool: surfaces that were read, with corners that all name vertices with finite coordinates.

        A surface with more corners than the engine takes is none: nothing can be said of a level that is refused, and
        the tests of its plane would take their time.
        """
        table = self.document.surfaces
        sound = ~table.broken
        vertices = len(self.vertices)
        inside = (table.corner_vertex >= 0) & (table.corner_vertex < vertices)
        good = np.zeros(len(inside), np.bool_)
        good[inside] = self.finite_vertices[table.corner_vertex[inside]]
        corners = np.diff(table.corner_start)
        bad = np.bincount(np.repeat(np.arange(len(corners)), corners)[~good], minlength=len(corners))
        sound &= (bad == 0) & (corners <= MOST_CORNERS)
        return sound

    @cached_property
    def sound_sectors(self) -> Bool:
        """(sectors,) bool: sectors that were read, whose surfaces are all sound and whose vertices exist."""
        table = self.document.sectors
        sound = ~table.broken
        surfaces, vertices = len(self.surfaces), len(self.vertices)
        for i in np.flatnonzero(sound).tolist():
            first, count = int(table.first_surface[i]), int(table.surface_count[i])
            own = table.vertex[table.vertex_start[i] : table.vertex_start[i + 1]]
            sound[i] = (
                first >= 0
                and count >= 0
                and first + count <= surfaces
                and bool(self.sound_surfaces[first : first + count].all())
                and bool(((own >= 0) & (own < vertices)).all())
                and bool(self.finite_vertices[own].all())
            )
        return sound


def _take(values: Int32, indices: Int32) -> Int32:
    """`values[indices]`, and -1 where an index is out of range."""
    out = np.full(len(indices), NONE, np.int32)
    inside = (indices >= 0) & (indices < len(values))
    out[inside] = values[indices[inside]]
    return out
