"""The frozen document that a JKL is read into: columns for what is numerous, one line index a record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import lark

from jktools.diagnostics import Diagnostic
from jktools.source import Source, Span
from jktools.syntax.arrays import Bool as Bool
from jktools.syntax.arrays import Float32 as Float32
from jktools.syntax.arrays import Int32 as Int32
from jktools.syntax.arrays import UInt32 as UInt32
from jktools.syntax.lines import LogicalLines
from jktools.syntax.records import Record


@dataclass(frozen=True, slots=True)
class Heading:
    """`World vertices 1683`: what was announced, and on which logical line."""

    line: int
    count: int


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Records of one kind, in the order of the file. A broken record keeps its place, so that indices hold."""

    heading: Heading | None
    lines: Int32
    """Logical line of each record."""
    broken: Bool
    """Records that could not be read: their integers are 0 and their floats NaN."""

    def __len__(self) -> int:
        return len(self.lines)


@dataclass(frozen=True, slots=True, eq=False)
class NameList(Table):
    """A plain list of file names."""

    names: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Vertices(Table):
    """`position` is (n, 3) float32, JKU."""

    position: Float32


@dataclass(frozen=True, slots=True, eq=False)
class TextureVertices(Table):
    """`coordinate` is (n, 2) float32, texels."""

    coordinate: Float32


@dataclass(frozen=True, slots=True, eq=False)
class Adjoins(Table):
    """Adjoins as written."""

    flags: UInt32
    mirror: Int32
    distance: Float32


@dataclass(frozen=True, slots=True, eq=False)
class Surfaces(Table):
    """Surfaces as written. Surface i has the corners corner_start[i] .. corner_start[i + 1]."""

    material: Int32
    flags: UInt32
    face_flags: UInt32
    geometry_mode: Int32
    light_mode: Int32
    texture_mode: Int32
    adjoin: Int32
    extra_light: Float32
    corner_start: Int32
    corner_vertex: Int32
    corner_texture_vertex: Int32
    light_start: Int32
    """Cuts `light`: one intensity a corner, or four (mono, red, green, blue)."""
    light: Float32


@dataclass(frozen=True, slots=True, eq=False)
class Normals(Table):
    """`direction` is (n, 3) float32, one a surface, as written."""

    direction: Float32


@dataclass(frozen=True, slots=True, eq=False)
class Sectors(Table):
    """Sectors as written; boxes are (n, 6) `x0 y0 z0 x1 y1 z1`, NaN where there is none."""

    flags: UInt32
    ambient_light: Float32
    extra_light: Float32
    colormap: Int32
    tint: Float32
    bound_box: Float32
    collide_box: Float32
    sound: tuple[str | None, ...]
    sound_volume: Float32
    center: Float32
    radius: Float32
    vertex_start: Int32
    vertex: Int32
    vertex_lines: Int32
    """Logical line of each entry of `vertex`."""
    first_surface: Int32
    surface_count: Int32
    line_of: Mapping[str, Int32]
    """Logical line of each kind of sector line (by its name in the grammar), -1 where it is missing."""


@dataclass(frozen=True, slots=True, eq=False)
class Parameters:
    """`key=value` words, cut by `start`; a word without `=` is its own value, as in the engine."""

    start: Int32
    keys: tuple[str, ...]
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Templates(Table):
    """Templates as written."""

    names: tuple[str, ...]
    parents: tuple[str, ...]
    parameters: Parameters


@dataclass(frozen=True, slots=True, eq=False)
class Things(Table):
    """Things as written; `arch_light` is -1 where the line has no such field."""

    number: Int32
    templates: tuple[str, ...]
    names: tuple[str, ...]
    position: Float32
    angles: Float32
    sector: Int32
    arch_light: Int32
    parameters: Parameters


@dataclass(frozen=True, slots=True, eq=False)
class Cogs(Table):
    """Placed COGs as written; values are cut by `value_start`."""

    scripts: tuple[str, ...]
    value_start: Int32
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class ArchLights:
    """ARCHLIGHTING: object i has the meshes mesh_start[i] .. , mesh j the vertices vertex_start[j] .. ."""

    heading: Heading | None
    mesh_start: Int32
    vertex_start: Int32
    light: Float32
    """(n, 4): mono, red, green, blue."""


@dataclass(frozen=True, slots=True, eq=False)
class EditorLights(Table):
    """Lights of JED or SED, which the engine skips. JED writes no layer (-1); only SED for MotS a colour (else NaN)."""

    flags: UInt32
    """SED's flags, JED's type."""
    layer: Int32
    position: Float32
    range: Float32
    intensity: Float32
    color: Float32


@dataclass(frozen=True, slots=True)
class EditorLayer:
    """A layer of SED: its name, and the sectors and things in it. The engine skips it."""

    name: str
    sectors: tuple[int, ...]
    things: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Header:
    """The HEADER section; what a file does not say stays 0, as in the engine."""

    version: int = 0
    values: Mapping[str, Float32] = field(default_factory=dict)
    """By the line's name in the grammar: `gravity`, `horizon_sky_offset`, ..."""
    lines: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class Document:
    """One JKL file as written."""

    source: Source
    game: str
    lines: LogicalLines
    sections: Mapping[str, int]
    """Logical line of each section's heading, by lower-case name."""
    header: Header
    lists: Mapping[str, NameList]
    """`sounds materials colormaps aiclasses models sprites keyframes animclasses soundclasses cogscripts`."""
    vertices: Vertices
    texture_vertices: TextureVertices
    adjoins: Adjoins
    surfaces: Surfaces
    normals: Normals
    sectors: Sectors
    cogs: Cogs
    templates: Templates
    things: Things
    arch_lights: ArchLights
    lights: EditorLights
    layers: tuple[EditorLayer, ...]
    diagnostics: tuple[Diagnostic, ...]

    def field_span(self, record: Record, line: int, ordinal: int) -> Span:
        """The bytes of one field, found by parsing its line with the grammar.

        `ordinal` counts the record's fields and, behind them, what the rule repeats (a surface's corners). The
        span of the whole line where there is no such field.
        """
        try:
            tokens = record.parse(self.lines.text(line))
        except lark.UnexpectedInput:
            return self.lines.span(line)
        if not 0 <= ordinal < len(tokens):
            return self.lines.span(line)
        start, end = tokens[ordinal].start_pos, tokens[ordinal].end_pos
        assert start is not None
        assert end is not None
        return self.lines.part(line, start, end)
