"""The numeric columns of a compiled level, declared once for writer, reader and range check.

Each entry mirrors a field of grammars/level.fbs, whose attributes say the same; a test compares the two.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

STRINGS = "strings"
"""What indices into Level.strings count."""


@dataclass(frozen=True, slots=True)
class Column:
    """One column of a section.

    `rows_of` names the column of the section that has as many rows; None for a column that counts itself. `cuts`
    names the column that a `*_start` column cuts. `index_of` names what its numbers count: a column of geometry
    (`vertices`), of another section (`resources.materials`), the parts that a `*_start` column cuts, or `strings`.
    """

    type: str
    width: int = 1
    rows_of: str | None = None
    cuts: str | None = None
    index_of: str | None = None
    or_none: bool = False
    since: int = 0
    """Minor version of the format that brought it; older files lack it."""
    until: int | None = None
    """Minor version of the format that wrote it last; newer files say the same by other columns."""
    group: str | None = None
    """Columns of one group often repeat whole rows, and are packed together."""


def camel_case(name: str) -> str:
    """A section or field as the generated code spells it: `ColourEffects`."""
    return "".join(part.capitalize() for part in name.split("_"))


def _grouped(name: str, columns: Mapping[str, Column]) -> dict[str, Column]:
    """The columns as one group."""
    return {key: replace(column, group=name) for key, column in columns.items()}


def _rows(leader: str, columns: Mapping[str, Column]) -> dict[str, Column]:
    """Columns that all have as many rows as `leader`; `*_start` columns have one more."""
    return {name: replace(c, rows_of=None if name == leader else leader) for name, c in columns.items()}


_TEXT = Column("u4", index_of=STRINGS)

GEOMETRY: Mapping[str, Column] = MappingProxyType(
    {
        "vertices": Column("f4", 3),
        "texture_vertices": Column("f4", 2),
        **_rows(
            "adjoin_flags",
            {
                "adjoin_flags": Column("u4", group="adjoin"),
                "adjoin_mirror": Column("i4", index_of="adjoin_flags"),
                "adjoin_distance": Column("f4", group="adjoin"),
                "adjoin_surface": Column("i4", index_of="surface_flags", or_none=True),
            },
        ),
        **_rows(
            "surface_flags",
            {
                "surface_material": Column("i4", index_of="resources.materials", or_none=True, group="surface"),
                "surface_flags": Column("u4", group="surface"),
                "surface_face_flags": Column("u4", group="surface"),
                "surface_geometry_mode": Column("i4", group="surface"),
                "surface_light_mode": Column("i4", group="surface"),
                "surface_texture_mode": Column("i4", group="surface"),
                "surface_adjoin": Column("i4", index_of="adjoin_flags", or_none=True),
                "surface_extra_light": Column("f4", group="surface"),
                "surface_normal": Column("f4", 3),
                "surface_sector": Column("i4", index_of="sector_flags", or_none=True),
                "surface_corner_start": Column("u4", cuts="corner_vertex"),
            },
        ),
        "corner_vertex": Column("i4", index_of="vertices"),
        "corner_texture_vertex": Column("i4", rows_of="corner_vertex", index_of="texture_vertices", or_none=True),
        "surface_light_start": Column("u4", rows_of="surface_flags", cuts="corner_light"),
        "corner_light": Column("f4"),
        **_rows(
            "sector_flags",
            {
                "sector_flags": Column("u4", group="sector"),
                "sector_ambient_light": Column("f4", group="sector"),
                "sector_extra_light": Column("f4", group="sector"),
                "sector_colormap": Column("i4", group="sector"),
                "sector_tint": Column("f4", 3, group="sector"),
                "sector_bound_box": Column("f4", 6),
                "sector_collide_box": Column("f4", 6),
                "sector_sound": Column("i4", index_of=STRINGS, or_none=True, group="sector"),
                "sector_sound_volume": Column("f4", group="sector"),
                "sector_center": Column("f4", 3),
                "sector_radius": Column("f4"),
                "sector_vertex_start": Column("u4", cuts="sector_vertex"),
            },
        ),
        "sector_vertex": Column("i4", index_of="vertices"),
        "sector_first_surface": Column("i4", rows_of="sector_flags"),
        "sector_surface_count": Column("i4", rows_of="sector_flags"),
    }
)

_PARAMETERS: Mapping[str, Column] = MappingProxyType(
    {
        "parameter_start": Column("u4", rows_of="source", cuts="parameter_key"),
        **_grouped(
            "parameter",
            {"parameter_key": _TEXT, "parameter_value": Column("u4", rows_of="parameter_key", index_of=STRINGS)},
        ),
    }
)

_RESOLVED: Mapping[str, Column] = MappingProxyType(
    {
        "type": Column("i4", rows_of="source", since=1, group="template"),
        "move": Column("i4", rows_of="source", since=1, group="template"),
        "has_ai": Column("i4", rows_of="source", since=1, group="template"),
        "value_start": Column("u4", rows_of="source", cuts="value_key", since=1, until=2),
        "value_key": replace(_TEXT, since=1, until=2),
        "value_text": Column("i4", rows_of="value_key", index_of=STRINGS, or_none=True, since=1, until=2),
        "value_source": Column("i4", rows_of="value_key", since=1, until=2),
        "number_start": Column("u4", rows_of="value_key", cuts="number", since=1, until=1),
        "number": Column("f8", since=1, until=1),
        "value_list": Column("u4", rows_of="value_key", index_of="list_start", since=2, until=2),
        "list_start": Column("u4", cuts="list_number", since=2),
        "list_number": Column("f8", since=2),
        "unused_start": Column("u4", rows_of="source", cuts="unused_key", since=2),
        **_grouped(
            "unused",
            {
                "unused_key": replace(_TEXT, since=2),
                "unused_value": Column("u4", rows_of="unused_key", index_of=STRINGS, since=2),
            },
        ),
        "base": Column("i4", rows_of="source", index_of="source", or_none=True, since=3),
        "own_start": Column("u4", rows_of="source", cuts="own_key", since=3),
        **_grouped(
            "value",
            {
                "own_key": replace(_TEXT, since=3),
                "own_text": Column("i4", rows_of="own_key", index_of=STRINGS, or_none=True, since=3),
                "own_setter": Column("i4", rows_of="own_key", since=3),
                "own_list": Column("u4", rows_of="own_key", index_of="list_start", since=3),
            },
        ),
    }
)

TEMPLATES: Mapping[str, Column] = MappingProxyType(
    {
        **_rows("source", {"source": Column("i4"), "name": _TEXT, "parent": replace(_TEXT, group="template")}),
        **{name: replace(column, until=1) for name, column in _PARAMETERS.items()},
        **_RESOLVED,
    }
)

THINGS: Mapping[str, Column] = MappingProxyType(
    {
        **_rows(
            "source",
            {
                "source": Column("i4"),
                "number": Column("i4"),
                "template": _TEXT,
                "name": _TEXT,
                "position": Column("f4", 3),
                "angles": Column("f4", 3),
                "sector": Column("i4", index_of="geometry.sector_flags"),
                "arch_light": Column("i4"),
            },
        ),
        **_PARAMETERS,
    }
)

COGS: Mapping[str, Column] = MappingProxyType(
    {
        **_rows("source", {"source": Column("i4"), "script": _TEXT, "value_start": Column("u4", cuts="value")}),
        "value": _TEXT,
    }
)

VISIBILITY: Mapping[str, Column] = MappingProxyType(
    {
        **_rows(
            "sector",
            {
                "sector": Column("i4", index_of="geometry.sector_flags"),
                "row_start": Column("u4", cuts="row"),
            },
        ),
        "row": Column("u1"),
    }
)

HOTSPOTS: Mapping[str, Column] = MappingProxyType(
    _rows(
        "cog",
        {
            "cog": Column("i4"),
            "script": _TEXT,
            "verb": _TEXT,
            "line": Column("i4"),
            "things": Column("i4"),
            "more": Column("u1"),
            "calls_per_second": Column("f8"),
            "mean_sectors": Column("f8"),
            "mean_surfaces": Column("f8"),
            "most_sectors": Column("i4"),
            "most_surfaces": Column("i4"),
            "pairs": Column("i4"),
            "verdict": Column("i4"),
        },
    )
)

LIGHTS: Mapping[str, Column] = MappingProxyType(
    {
        **_rows(
            "thing",
            {
                "thing": Column("i4"),
                "position": Column("f4", 3),
                "intensity": Column("f4"),
                "reach": Column("f4"),
                "vertex_start": Column("u4", cuts="vertex"),
            },
        ),
        "vertex": Column("i4", index_of="geometry.vertices"),
        "amount": Column("f4", rows_of="vertex"),
    }
)

PARTICLES: Mapping[str, Column] = MappingProxyType(
    _rows(
        "template",
        {
            "template": Column("i4"),
            **_grouped(
                "cloud",
                {
                    "material": Column("i4", index_of=STRINGS, or_none=True),
                    "cels": Column("i4"),
                    "spawned": Column("i4"),
                    "timer_ms": Column("i4"),
                    "flags": Column("u4"),
                    **dict.fromkeys(("range", "minsize"), Column("f4")),
                    "lost_a_step": Column("i4"),
                    **dict.fromkeys(("maxthrust", "elementsize", "pitchrange", "yawrange"), Column("f4")),
                    "light_mode": Column("i4"),
                },
            ),
        },
    )
)

COLOUR_EFFECTS: Mapping[str, Column] = MappingProxyType(
    _rows(
        "cog",
        {
            "cog": Column("i4"),
            "script": _TEXT,
            "line": Column("i4"),
            "argument": Column("f8", 10),
            "colormap": Column("i4", index_of="resources.colormaps", or_none=True),
            "palette": Column("u1", 768),
        },
    )
)

MOTION: Mapping[str, Column] = MappingProxyType(
    _rows(
        "template",
        {
            "template": Column("i4"),
            **_grouped(
                "way",
                {
                    **dict.fromkeys(("walk", "back", "strafe", "run", "crouch", "air", "swim"), Column("f8")),
                    **dict.fromkeys(("stop_walk", "stop_run"), Column("f8", 2)),
                    **dict.fromkeys(
                        ("jump_height", "crouched_jump_height", "jump_reach", "run_jump_reach"), Column("f8")
                    ),
                },
            ),
        },
    )
)

_SURFACES = "geometry.surface_flags"

LEDGES: Mapping[str, Column] = MappingProxyType(
    {
        **_rows(
            "body_movesize",
            {
                "body_movesize": Column("f4"),
                "body_hover": Column("f4"),
                "body_reattach": Column("f4"),
                "body_step": Column("f4"),
                "body_jump": Column("f4"),
                "body_physics_flags": Column("u4"),
                "body_player": Column("u1"),
                "body_name_start": Column("u4", cuts="body_name"),
            },
        ),
        "body_name": _TEXT,
        "body_ledge_start": Column("u4", rows_of="body_movesize", cuts="surface"),
        **_rows(
            "surface",
            {
                "surface": Column("i4", index_of=_SURFACES, or_none=True),
                **_grouped(
                    "edge",
                    {
                        "corner": Column("u1"),
                        "start": Column("f4"),
                        "end": Column("f4"),
                        "kind": Column("u1"),
                        "other_kind": Column("u1"),
                        "below": Column("i4", index_of=_SURFACES, or_none=True),
                        "thing": Column("i4"),
                        "drop_start": Column("f4"),
                        "drop_end": Column("f4"),
                        "traits": Column("u1"),
                        **{
                            name: Column("i4", or_none=True, since=2)
                            for name in ("carrier", "carrier_frame", "carrier_face", "onto", "onto_face")
                        },
                    },
                ),
            },
        ),
    }
)

BASINS: Mapping[str, Column] = MappingProxyType(
    {
        "body": Column("i4", index_of="ledges.body_movesize"),
        "surface_start": Column("u4", rows_of="body", cuts="surface"),
        "surface": Column("i4", index_of=_SURFACES),
        **{
            name: Column(kind, rows_of="body")
            for name, kind in {"shallowest": "f4", "deepest": "f4", "entered": "u1", "left": "u1"}.items()
        },
    }
)

MODELS: Mapping[str, Column] = MappingProxyType(
    _rows(
        "name",
        {
            "name": replace(_TEXT, since=3),
            "insert_offset": Column("f4", 3, since=3, group="model"),
            "radius": Column("f4", since=3, group="model"),
            "known": Column("u1", since=3, group="model"),
        },
    )
)

FILES: Mapping[str, Column] = MappingProxyType(
    {
        **_rows(
            "name",
            {
                "name": replace(_TEXT, since=3),
                "folder": replace(_TEXT, since=3, group="file"),
                "found": Column("u1", since=3, group="file"),
            },
        ),
        "sha256": Column("u1", 32, since=3),
    }
)

_LISTS = (
    "sounds", "materials", "colormaps", "aiclasses", "models", "sprites", "keyframes", "animclasses", "soundclasses",
    "cogscripts",
)  # fmt: skip

RESOURCES: Mapping[str, Column] = MappingProxyType(dict.fromkeys(_LISTS, _TEXT))

SECTIONS: Mapping[str, Mapping[str, Column]] = MappingProxyType(
    {
        "resources": RESOURCES,
        "geometry": GEOMETRY,
        "templates": TEMPLATES,
        "things": THINGS,
        "cogs": COGS,
        "visibility": VISIBILITY,
        "hotspots": HOTSPOTS,
        "lights": LIGHTS,
        "particles": PARTICLES,
        "colour_effects": COLOUR_EFFECTS,
        "motion": MOTION,
        "ledges": LEDGES,
        "basins": BASINS,
        "models": MODELS,
        "files": FILES,
    }
)
"""The sections of the file in its order, with their columns."""

TEXT: Mapping[str, Column] = MappingProxyType(
    {"text": Column("u1"), "text_start": Column("u4", cuts="text"), "symbols": Column("u1", since=3)}
)
"""Columns of the level itself: its strings. Since 1.2."""

OMISSION: Mapping[str, Column] = MappingProxyType(
    {"source": Column("i4"), "name_text": Column("u4", rows_of="source", index_of=STRINGS)}
)
"""Columns of an omission. `name_text` since 1.2."""
