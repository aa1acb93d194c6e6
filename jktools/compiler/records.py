"""The records of a compiled level as plain values, for comparing two levels.

A record has a number, by which the level's other parts name it, a name where it has one, an identity by which it is
found again where numbers have shifted, and fields. Numbers in fields that count other records say of which kind.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler.columns import RESOURCES
from jktools.compiler.reader import CompiledLevel
from jktools.compiler.section import Section

Translate = Callable[[str, int], Hashable]
"""From a kind of record and a number of the one level to the same of the other; what has none stays apart."""

LEDGE_KINDS = ("level", "seamless", "fall", "water", "none", "step", "lip", "jump", "wall", "unknown")
VERDICTS = ("never", "always", "varies")


@dataclass(frozen=True, slots=True)
class Field:
    """One value a record."""

    values: Sequence[Any]
    refers: str | None = None
    """The kind of records that its numbers, alone or in lists, count."""


@dataclass(frozen=True, slots=True)
class Records:
    """Records of one kind."""

    section: str
    kind: str
    number: Sequence[int]
    """By which the level names each."""
    name: Sequence[str]
    identity: Sequence[Hashable]
    fields: Mapping[str, Field]
    by_identity: bool = False
    """Whether identities are compared even where both levels have as many."""

    def __len__(self) -> int:
        return len(self.number)


def written(level: CompiledLevel) -> Iterator[Records]:
    """What the level was written with, in the order of the file."""
    choices = {"cut_anyway": level.cut_anyway, "only": level.only, "skip": level.skip}
    yield _single("settings", "settings", {**level.settings, **choices})
    yield _single("world", "header", level.world)
    for name in RESOURCES:
        names = _texts(level, getattr(level.resources, name))
        kind = name.removesuffix("es") if name.endswith("sses") else name.removesuffix("s")
        yield Records("resources", kind, range(len(names)), names, names, {"name": Field(names)})
    yield from _geometry(level)
    if level.templates is not None:
        yield _templates(level, level.templates)
    if level.things is not None:
        yield _things(level, level.things)
    if level.cogs is not None:
        yield _cogs(level, level.cogs)


def _single(section: str, kind: str, values: Mapping[str, Any]) -> Records:
    return Records(section, kind, [0], [""], [""], {name: Field([value]) for name, value in values.items()})


def _texts(level: CompiledLevel, index: npt.NDArray[Any]) -> list[str]:
    strings = level.strings
    return [strings[i] if i >= 0 else "" for i in index.tolist()]


def _parts(start: npt.NDArray[Any], values: Sequence[Any]) -> list[Any]:
    """The values as `start` cuts them."""
    return [values[a:b] for a, b in pairwise(start.tolist())]


def _named(index: npt.NDArray[Any], names: Sequence[str]) -> list[Any]:
    """The name that each number counts, or the number where there is none."""
    return [names[i] if 0 <= i < len(names) else i for i in index.tolist()]


def _geometry(level: CompiledLevel) -> Iterator[Records]:
    whole = level.geometry
    positions = [tuple(each) for each in whole.vertices.tolist()]
    no_names = [""] * len(positions)
    yield Records("geometry", "vertex", range(len(positions)), no_names, positions, {"position": Field(positions)})
    inside = _parts(whole.sector_vertex_start, whole.sector_vertex.tolist())
    materials = _texts(level, level.resources.materials)
    colormaps = _texts(level, level.resources.colormaps)
    yield Records(
        "geometry", "sector", range(len(inside)), [""] * len(inside),
        [frozenset(positions[i] for i in each) for each in inside],
        {
            **_plain(whole, "sector", ("flags", "ambient_light", "extra_light", "tint", "bound_box", "collide_box")),
            "colormap": Field(_named(whole.sector_colormap, colormaps)),
            "sound": Field(_texts(level, whole.sector_sound)),
            **_plain(whole, "sector", ("sound_volume", "center", "radius", "surface_count")),
            "vertices": Field(inside, "vertex"),
        },
    )  # fmt: skip
    corners = _parts(whole.surface_corner_start, whole.corner_vertex.tolist())
    texels = [(0.0, 0.0), *(tuple(each) for each in whole.texture_vertices.tolist())]
    texture = _parts(whole.surface_corner_start, [texels[i + 1] for i in whole.corner_texture_vertex.tolist()])
    polygons = [tuple(positions[i] for i in each) for each in corners]
    yield Records(
        "geometry", "surface", range(len(corners)), [""] * len(corners), polygons,
        {
            "material": Field(_named(whole.surface_material, materials)),
            **_plain(
                whole, "surface",
                ("flags", "face_flags", "geometry_mode", "light_mode", "texture_mode", "extra_light", "normal"),
            ),
            "adjoin": Field(whole.surface_adjoin.tolist(), "adjoin"),
            "sector": Field(whole.surface_sector.tolist(), "sector"),
            "vertices": Field(corners, "vertex"),
            "texture": Field(texture),
            "light": Field(_parts(whole.surface_light_start, whole.corner_light.tolist())),
        },
    )  # fmt: skip
    surface = whole.adjoin_surface.tolist()
    yield Records(
        "geometry", "adjoin", range(len(surface)), [""] * len(surface),
        [polygons[i] if i >= 0 else () for i in surface],
        {
            **_plain(whole, "adjoin", ("flags", "distance")),
            "mirror": Field(whole.adjoin_mirror.tolist(), "adjoin"),
            "surface": Field(surface, "surface"),
        },
    )  # fmt: skip


def _plain(section: Section, kind: str, names: Sequence[str]) -> dict[str, Field]:
    """Columns of numbers as they are."""
    prefix = f"{kind}_" if kind else ""
    return {name: Field(getattr(section, f"{prefix}{name}").tolist()) for name in names}


def _templates(level: CompiledLevel, section: Section) -> Records:
    names, source = _texts(level, section.name), section.source.tolist()
    owner = dict(zip(source, names, strict=True))
    fields = {"parent": Field(_texts(level, section.parent))}
    if hasattr(section, "value_start"):
        numbers = _parts(section.number_start, section.number.tolist())
        values = [
            (key, text or numbers[i], owner.get(setter, setter))
            for i, (key, text, setter) in enumerate(
                zip(
                    _texts(level, section.value_key), _texts(level, section.value_text),
                    section.value_source.tolist(), strict=True,
                )
            )
        ]  # fmt: skip
        fields |= _plain(section, "", ("type", "move", "has_ai"))
        fields["values"] = Field(_parts(section.value_start, values))
    if "unused_start" in section.stored:
        fields["unused"] = Field(_pairs(level, section, "unused"))
    return Records("templates", "template", source, names, [name.lower() for name in names], fields, by_identity=True)


def _pairs(level: CompiledLevel, section: Section, name: str) -> list[Any]:
    keys, values = (_texts(level, getattr(section, f"{name}_{part}")) for part in ("key", "value"))
    return _parts(getattr(section, f"{name}_start"), list(zip(keys, values, strict=True)))


def _things(level: CompiledLevel, section: Section) -> Records:
    names, template = _texts(level, section.name), _texts(level, section.template)
    positions = [tuple(each) for each in section.position.tolist()]
    return Records(
        "things", "thing", section.source.tolist(), names, list(zip(template, names, positions, strict=True)),
        {
            "name": Field(names),
            "template": Field(template),
            "position": Field(positions),
            **_plain(section, "", ("angles", "number", "arch_light")),
            "sector": Field(section.sector.tolist(), "sector"),
            "parameters": Field(_pairs(level, section, "parameter")),
        },
    )  # fmt: skip


def _cogs(level: CompiledLevel, section: Section) -> Records:
    scripts = _texts(level, section.script)
    values = [tuple(each) for each in _parts(section.value_start, _texts(level, section.value))]
    return Records(
        "cogs", "cog", section.source.tolist(), scripts, list(zip(scripts, values, strict=True)),
        {"script": Field(scripts), "values": Field(values)},
    )  # fmt: skip


def derived(level: CompiledLevel, translate: Translate) -> Iterator[Records]:
    """What was computed of the level; `translate` gives the identities in the numbers of the level compared with."""
    if level.ledges is not None:
        yield from _ledges(level, level.ledges, translate)
    if level.basins is not None and level.ledges is not None:
        yield _basins(level, level.basins, level.ledges, translate)
    if level.hotspots is not None:
        yield _hotspots(level, level.hotspots, translate)
    if level.lights is not None:
        yield _lights(level.lights, translate)
    if level.particles is not None:
        yield _of_templates(level, level.particles, "particles", translate)
    if level.colour_effects is not None:
        yield _colour_effects(level, level.colour_effects, translate)
    if level.motion is not None:
        yield _of_templates(level, level.motion, "motion", translate)
    yield Records(
        "omissions", "omission", *_omissions(level), {}, by_identity=True
    )  # fmt: skip
    passes = level.passes
    yield Records(
        "passes", "pass", range(len(passes)), list(passes), list(passes),
        {key: Field([each[key] for each in passes.values()]) for key in ("ran", "note")}, by_identity=True,
    )  # fmt: skip


def _bodies(level: CompiledLevel, ledges: Section) -> list[tuple[str, ...]]:
    """The templates of each body."""
    return [tuple(each) for each in _parts(ledges.body_name_start, _texts(level, ledges.body_name))]


def _ledges(level: CompiledLevel, section: Section, translate: Translate) -> Iterator[Records]:
    bodies = _bodies(level, section)
    names = [", ".join(each) for each in bodies]
    body_fields = ("movesize", "hover", "reattach", "step", "jump", "physics_flags", "player")
    yield Records(
        "ledges", "body", range(len(bodies)), names, bodies, _plain(section, "body", body_fields), by_identity=True
    )
    owner = np.repeat(np.arange(len(bodies)), np.diff(section.body_ledge_start).astype(np.int64)).tolist()
    edges: dict[tuple[Any, ...], list[Any]] = {}
    here = ("surface", "corner", "carrier", "carrier_frame", "carrier_face")
    there = (
        "start",
        "end",
        "kind",
        "other_kind",
        "below",
        "thing",
        "onto",
        "onto_face",
        "drop_start",
        "drop_end",
        "traits",
    )
    rows = zip(
        owner, zip(*_columns(section, here), strict=True), zip(*_columns(section, there), strict=True), strict=True
    )
    for body, edge, (start, end, kind, other, below, thing, onto, face, first, last, traits) in rows:
        interval = {
            "from": start, "to": end, "kind": _word(LEDGE_KINDS, kind), "other_profile": _word(LEDGE_KINDS, other),
            "below": translate("surface", below), "thing": translate("thing", thing),
            "onto": (translate("thing", onto), face), "drop": (first, last), "traits": traits,
        }  # fmt: skip
        edges.setdefault((body, *edge), []).append(interval)
    yield Records(
        "ledges", "edge", [surface for _, surface, *_ in edges],
        [f"{_edge(corner, *carrier)}, {names[body]}" for body, _, corner, *carrier in edges],
        [
            (bodies[body], translate("surface", surface), corner, translate("thing", thing), *rest)
            for body, surface, corner, thing, *rest in edges
        ],
        {"intervals": Field(list(edges.values()))}, by_identity=True,
    )  # fmt: skip


def _columns(section: Section, names: Sequence[str]) -> list[list[Any]]:
    """Columns of numbers, those that an older file lacks as none."""
    rows = len(section.stored["surface"])
    return [getattr(section, name).tolist() if name in section.stored else [-1] * rows for name in names]


def _edge(corner: int, carrier: int, frame: int, face: int) -> str:
    if carrier < 0:
        return f"corner {corner}"
    return f"thing {carrier}" + (f" at frame {frame}" if frame >= 0 else "") + f", face {face}, corner {corner}"


def _word(words: Sequence[str], number: int) -> Any:
    return words[number] if 0 <= number < len(words) else number


def _basins(level: CompiledLevel, section: Section, ledges: Section, translate: Translate) -> Records:
    bodies = _bodies(level, ledges)
    owner = [bodies[i] for i in section.body.tolist()]
    floors = _parts(section.surface_start, section.surface.tolist())
    return Records(
        "basins", "basin", range(len(owner)), [", ".join(each) for each in owner],
        [
            (body, frozenset(translate("surface", surface) for surface in each))
            for body, each in zip(owner, floors, strict=True)
        ],
        {**_plain(section, "", ("shallowest", "deepest", "entered", "left")), "surfaces": Field(floors, "surface")},
        by_identity=True,
    )  # fmt: skip


def _hotspots(level: CompiledLevel, section: Section, translate: Translate) -> Records:
    scripts, verbs = _texts(level, section.script), _texts(level, section.verb)
    lines = section.line.tolist()
    identity = [
        (translate("cog", cog), *rest) for cog, *rest in zip(section.cog.tolist(), scripts, verbs, lines, strict=True)
    ]
    names = ("things", "more", "calls_per_second", "mean_sectors", "mean_surfaces", "most_sectors", "most_surfaces",
             "pairs")  # fmt: skip
    return Records(
        "hotspots", "hotspot", section.cog.tolist(),
        [f"{script}:{line} {verb}" for script, line, verb in zip(scripts, lines, verbs, strict=True)], identity,
        {**_plain(section, "", names), "verdict": Field([_word(VERDICTS, each) for each in section.verdict.tolist()])},
        by_identity=True,
    )  # fmt: skip


def _lights(section: Section, translate: Translate) -> Records:
    things = section.thing.tolist()
    lit = list(zip(section.vertex.tolist(), section.amount.tolist(), strict=True))
    return Records(
        "lights", "light", things, [""] * len(things), [translate("thing", each) for each in things],
        {
            **_plain(section, "", ("position", "intensity", "reach")),
            "vertices": Field([[vertex for vertex, _ in each] for each in _parts(section.vertex_start, lit)], "vertex"),
            "amounts": Field([[amount for _, amount in each] for each in _parts(section.vertex_start, lit)]),
        },
        by_identity=True,
    )  # fmt: skip


def _of_templates(level: CompiledLevel, section: Section, name: str, translate: Translate) -> Records:
    """Rows of templates, all of whose columns are numbers but the material."""
    template = section.template.tolist()
    names: dict[int, str] = {}
    if level.templates is not None:
        names = dict(zip(level.templates.source.tolist(), _texts(level, level.templates.name), strict=True))
    fields = {
        key: Field(getattr(section, key).tolist()) for key in section.stored if key not in ("template", "material")
    }
    if "material" in section.stored:
        fields["material"] = Field(_texts(level, section.material))
    return Records(
        name, "cloud" if name == "particles" else "motion", template, [names.get(each, "") for each in template],
        [translate("template", each) for each in template], fields, by_identity=True,
    )  # fmt: skip


def _colour_effects(level: CompiledLevel, section: Section, translate: Translate) -> Records:
    scripts, lines = _texts(level, section.script), section.line.tolist()
    colormaps = _named(section.colormap, _texts(level, level.resources.colormaps))
    return Records(
        "colour_effects", "colour effect", section.cog.tolist(),
        [f"{script}:{line}" for script, line in zip(scripts, lines, strict=True)],
        [
            (translate("cog", cog), *rest)
            for cog, *rest in zip(section.cog.tolist(), scripts, lines, colormaps, strict=True)
        ],
        {**_plain(section, "", ("argument",)), "palette": Field([bytes(each).hex() for each in section.palette])},
        by_identity=True,
    )  # fmt: skip


def _omissions(level: CompiledLevel) -> tuple[list[int], list[str], list[Hashable]]:
    rows = [
        (source, name, (each["section"], each["reason"], name))
        for each in level.omissions
        for source, name in zip(each["source"], each["name"], strict=True)
    ]
    return [source for source, *_ in rows], [name for _, name, _ in rows], [identity for *_, identity in rows]
