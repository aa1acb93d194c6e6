"""What the viewer of a page draws, taken from the columns of a compiled level."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler import CompiledLevel
from jktools.diagnostics import Subject
from jktools.facts.ledge_kinds import Kind
from jktools.syntax.template.parameters import TYPES

SEEN_THROUGH = 0x1
"""Adjoin flag: visible."""
NOT_DRAWN = 0
"""Geometry mode of a surface that the renderer leaves out."""
SKIES = 0x200 | 0x400
"""Surface flags: horizon sky, ceiling sky."""
TRANSLUCENT = 0x2
"""Face flag."""
MOST_VIEWS = 4096
"""Sectors of the largest level whose views go into the page: its matrix takes n² / 8 bytes."""

LEDGE_NAMES = {
    Kind.SEAMLESS: "stays on the floor, going down",
    Kind.FALL: "falls",
    Kind.WATER: "into water",
    Kind.NONE: "over nothing",
    Kind.STEP: "steps up",
    Kind.LIP: "slides up a lip",
    Kind.JUMP: "up by a jump",
    Kind.UNKNOWN: "not known",
}
"""Kinds of ledges that are drawn, and what a body does there."""

Array = npt.NDArray[Any]


def picture(level: CompiledLevel) -> dict[str, Any]:
    """What the script of the page takes: plain data, and arrays of little-endian numbers, which JSON has as base64."""
    g = level.geometry
    return {
        "vertices": _packed(g.vertices, "<f4"),
        "corner_start": _packed(g.surface_corner_start, "<i4"),
        "corner_vertex": _packed(g.corner_vertex, "<i4"),
        "corner_light": _packed(_light(level), "u1"),
        "surface_normal": _packed(g.surface_normal, "<f4"),
        "surface_sector": _packed(g.surface_sector, "<i4"),
        "surface_flags": _packed(g.surface_flags, "<u4"),
        "surface_look": _packed(_look(level), "u1"),
        "surface_material": _packed(g.surface_material, "<i4"),
        "surface_leads_to": _packed(_leads_to(level), "<i4"),
        "sector_flags": _packed(g.sector_flags, "<u4"),
        "sector_center": _packed(g.sector_center, "<f4"),
        "materials": [level.strings[i] for i in level.resources.materials.tolist()],
        "things": _things(level),
        "bodies": list(_bodies(level)),
        "views": _views(level),
    }


def _packed(values: Array, dtype: str) -> Array:
    return np.ascontiguousarray(values, dtype)


def _look(level: CompiledLevel) -> Array:
    """0 left out, 1 drawn, 2 drawn half through, 3 sky."""
    g = level.geometry
    passes = np.append(g.adjoin_flags & SEEN_THROUGH > 0, False)[g.surface_adjoin]
    drawn = (g.surface_geometry_mode != NOT_DRAWN) & ~(passes & (g.surface_material < 0))
    half = passes | (g.surface_face_flags & TRANSLUCENT > 0)
    return np.select([~drawn, g.surface_flags & SKIES > 0, half], [0, 3, 2], 1)


def _light(level: CompiledLevel) -> Array:
    """The light at each corner as the level says it, 0 .. 255: its own, the surface's and the sector's extra."""
    g = level.geometry
    start, light_start = (each.astype(np.int64) for each in (g.surface_corner_start, g.surface_light_start))
    surface = np.repeat(np.arange(len(start) - 1), start[1:] - start[:-1])
    place = np.arange(len(surface)) - start[surface]
    own = np.zeros(len(surface))
    has = place < (light_start[1:] - light_start[:-1])[surface]
    own[has] = g.corner_light[(light_start[surface] + place)[has]]
    sector = g.surface_sector[surface]
    extra = g.surface_extra_light[surface] + np.append(g.sector_extra_light, 0)[sector]
    ambient = np.append(g.sector_ambient_light, 0)[sector]
    light = np.maximum(np.nan_to_num(own), np.nan_to_num(ambient)) + np.nan_to_num(extra)
    scaled: Array = np.rint(np.clip(light, 0, 1) * 255)
    return scaled


def _leads_to(level: CompiledLevel) -> Array:
    """The sector behind each surface; -1 behind a wall."""
    g = level.geometry
    mirror = np.append(g.adjoin_mirror, -1)[g.surface_adjoin]
    behind = np.append(g.adjoin_surface, -1)[mirror]
    sectors: Array = np.append(g.surface_sector, -1)[behind]
    return sectors


def _things(level: CompiledLevel) -> list[dict[str, Any]]:
    things = level.things
    if things is None:
        return []
    return [
        {
            "index": index,
            "number": number,
            "name": level.strings[name],
            "template": level.strings[template],
            "type": kind,
            "position": [round(x, 4) for x in position],
            "sector": sector,
        }
        for index, number, name, template, kind, position, sector in zip(
            things.source.tolist(), things.number.tolist(), things.name.tolist(), things.template.tolist(),
            _types(level), things.position.tolist(), things.sector.tolist(), strict=True,
        )
    ]  # fmt: skip


def _types(level: CompiledLevel) -> list[str]:
    """The type of each thing, by its template."""
    templates, things = level.templates, level.things
    assert things is not None
    if templates is None:
        return [TYPES[0]] * len(things.source)
    known = {
        level.strings[name].lower(): TYPES[kind] if 0 <= kind < len(TYPES) else TYPES[0]
        for name, kind in zip(templates.name.tolist(), templates.type.tolist(), strict=True)
    }
    return [known.get(level.strings[name].lower(), TYPES[0]) for name in things.template.tolist()]


def _bodies(level: CompiledLevel) -> Iterator[dict[str, Any]]:
    """The bodies that walk, each with the ledges of the level's own floors and with its basins."""
    ledges = level.ledges
    if ledges is None:
        return
    g = level.geometry
    start = g.surface_corner_start.astype(np.int64)
    names, name_start = ledges.body_name.tolist(), ledges.body_name_start.tolist()
    for body in range(len(ledges.body_movesize)):
        first, last = ledges.body_ledge_start[body : body + 2].tolist()
        rows = np.arange(first, last)
        rows = rows[(ledges.surface[rows] >= 0) & np.isin(ledges.kind[rows], list(LEDGE_NAMES))]
        surface, corner = ledges.surface[rows].astype(np.int64), ledges.corner[rows].astype(np.int64)
        following = (corner + 1) % np.maximum(start[surface + 1] - start[surface], 1)
        here, there = (g.vertices[g.corner_vertex[start[surface] + c]] for c in (corner, following))
        ends = [here + (there - here) * part[rows][:, None] for part in (ledges.start, ledges.end)]
        yield {
            "name": level.strings[names[name_start[body]]],
            "others": [level.strings[i] for i in names[name_start[body] + 1 : name_start[body + 1]]],
            "player": bool(ledges.body_player[body]),
            "ends": _packed(np.concatenate(ends, axis=1), "<f4"),
            "kind": _packed(ledges.kind[rows], "u1"),
            "surface": _packed(surface, "<i4"),
            "drop": _packed(np.nan_to_num(np.maximum(ledges.drop_start[rows], ledges.drop_end[rows])), "<f4"),
            "basins": [
                {
                    "surfaces": list(basin.surfaces),
                    "deepest": round(basin.deepest, 4),
                    "stuck": not basin.left and not basin.entered & 0x8,
                }
                for basin in level.basins_of(body)
            ],
        }


def _views(level: CompiledLevel) -> Array | None:
    """Which sectors can be seen from which: rows of bits, the lowest first, each row in whole bytes."""
    seen = level.visible_sectors
    if seen is None or len(seen) > MOST_VIEWS:
        return None
    return _packed(np.packbits(seen, axis=1, bitorder="little"), "u1")


def place_of(level: CompiledLevel, subject: Subject | None, positions: Mapping[int, Sequence[float]]) -> list[float]:
    """Where the object of a finding is, JKU; empty where it has no place. `positions` are those of things, by index."""
    if subject is None or subject.index < 0:
        return []
    g, index = level.geometry, subject.index
    if subject.kind == "thing":
        return list(positions.get(index, ()))
    if subject.kind == "sector" and index < len(g.sector_center):
        return _rounded(g.sector_center[index])
    if subject.kind == "vertex" and index < len(g.vertices):
        return _rounded(g.vertices[index])
    if subject.kind == "adjoin" and index < len(g.adjoin_surface):
        index = int(g.adjoin_surface[index])
    elif subject.kind != "surface":
        return []
    if not 0 <= index < len(g.surface_normal):
        return []
    corners = g.corner_vertex[g.surface_corner_start[index] : g.surface_corner_start[index + 1]]
    return _rounded(g.vertices[corners].mean(axis=0)) if len(corners) else []


def _rounded(point: Array) -> list[float]:
    found = [round(float(x), 4) for x in point]
    return found if np.isfinite(found).all() else []
