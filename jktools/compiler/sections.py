"""The columns of each section, taken from a level."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler.columns import RESOURCES
from jktools.compiler.cut import Omission, choose, choose_names
from jktools.compiler.grid import counted, grid_of
from jktools.compiler.inheritance import NO_BASE, Value, Values, bases, own_columns
from jktools.compiler.packing import Stored
from jktools.compiler.settings import CompileSettings
from jktools.facts import LevelFacts
from jktools.geometry import compressed
from jktools.model import Level
from jktools.model.resolved import Resolved, Setting
from jktools.syntax.jkl import Parameters
from jktools.syntax.template.parameters import MOVES, PARAMETERS, TYPES
from jktools.syntax.template.values import ValueKind

Columns = Mapping[str, npt.NDArray[Any] | Stored]
"""Columns by name; what is stored is written so, the rest in its smallest form."""
Rows = npt.NDArray[np.intp]
ENTRY = np.dtype(np.float64).itemsize


DIGEST = hashlib.sha256().digest_size


@dataclass(frozen=True, slots=True)
class NotNeeded:
    """Nothing in the scene calls for a section."""

    reason: str


@dataclass(frozen=True, slots=True)
class Cut:
    """A section that leaves records out."""

    columns: Columns
    note: str
    omissions: tuple[Omission, ...]


class Strings:
    """Every text of the level once, in order of first use."""

    def __init__(self, first: Iterable[str] = ()) -> None:
        """Hold these, which the most columns name, before all others: small numbers take fewer bytes."""
        self._index: dict[str, int] = {}
        self.indices(first)

    @property
    def texts(self) -> Sequence[str]:
        """The texts; an index counts them."""
        return list(self._index)

    def indices(self, texts: Iterable[str]) -> npt.NDArray[np.uint32]:
        """The index of each text."""
        return np.array([self._index.setdefault(text, len(self._index)) for text in texts], np.uint32)


def parameter_keys(level: Level) -> Iterable[str]:
    """The parameters that some template or thing of the level has, in the order of docs/parameters.md."""
    document = level.document
    used = {key.lower() for each in (document.templates, document.things) for key in each.parameters.keys}
    used.update(key for i in range(len(level.templates)) for key in level.resolved_templates[i].values)
    return (key for key in PARAMETERS if key in used)


def resources(facts: LevelFacts, strings: Strings, settings: CompileSettings) -> Cut:
    """The plain lists, without the names that nothing reaches."""
    chosen = choose_names(facts, cut_anyway=settings.cut_anyway)
    columns = {key: strings.indices(chosen.kept[key]) for key in RESOURCES}
    return Cut(columns, chosen.note, chosen.omissions)


def geometry(facts: LevelFacts, strings: Strings, settings: CompileSettings) -> Columns:
    """Vertices, adjoins, surfaces and sectors, with the references between them; at `fast`, on grids."""
    columns = _geometry(facts.level, strings)
    return {**columns, **counted(columns, grid_of(facts.level))} if settings.accuracy == "fast" else columns


def _geometry(level: Level, strings: Strings) -> dict[str, npt.NDArray[Any]]:
    adjoins, surfaces, sectors = level.document.adjoins, level.document.surfaces, level.document.sectors
    sounds = iter(strings.indices(sound for sound in sectors.sound if sound is not None))
    return {
        "vertices": level.vertices,
        "texture_vertices": level.texture_vertices,
        "adjoin_flags": adjoins.flags,
        "adjoin_mirror": adjoins.mirror,
        "adjoin_distance": adjoins.distance,
        "adjoin_surface": level.adjoin_surface,
        "surface_material": surfaces.material,
        "surface_flags": surfaces.flags,
        "surface_face_flags": surfaces.face_flags,
        "surface_geometry_mode": surfaces.geometry_mode,
        "surface_light_mode": surfaces.light_mode,
        "surface_texture_mode": surfaces.texture_mode,
        "surface_adjoin": surfaces.adjoin,
        "surface_extra_light": surfaces.extra_light,
        "surface_normal": level.document.normals.direction,
        "surface_sector": level.surface_sector,
        "surface_corner_start": surfaces.corner_start,
        "corner_vertex": surfaces.corner_vertex,
        "corner_texture_vertex": surfaces.corner_texture_vertex,
        "surface_light_start": surfaces.light_start,
        "corner_light": surfaces.light,
        "sector_flags": sectors.flags,
        "sector_ambient_light": sectors.ambient_light,
        "sector_extra_light": sectors.extra_light,
        "sector_colormap": sectors.colormap,
        "sector_tint": sectors.tint,
        "sector_bound_box": sectors.bound_box,
        "sector_collide_box": sectors.collide_box,
        "sector_sound": np.array([-1 if sound is None else next(sounds) for sound in sectors.sound], np.int32),
        "sector_sound_volume": sectors.sound_volume,
        "sector_center": sectors.center,
        "sector_radius": sectors.radius,
        "sector_vertex_start": sectors.vertex_start,
        "sector_vertex": sectors.vertex,
        "sector_first_surface": sectors.first_surface,
        "sector_surface_count": sectors.surface_count,
    }


def templates(facts: LevelFacts, strings: Strings, settings: CompileSettings) -> Cut | NotNeeded:
    """The templates that the level can reach, as written and as the engine holds them."""
    level = facts.level
    chosen = choose(facts, cut_anyway=settings.cut_anyway)
    kept = chosen.kept
    if not len(kept):
        return NotNeeded(chosen.note if len(level.templates) else "the level lists no template")
    table = level.document.templates
    columns: Columns = {
        "source": kept,
        "name": strings.indices(table.names[i] for i in kept),
        "parent": strings.indices(table.parents[i] for i in kept),
        **_resolved(level, [level.resolved_templates[i] for i in kept.tolist()], strings, rest=not settings.plain),
    }
    return Cut(columns, chosen.note, chosen.omissions)


def _resolved(level: Level, held: Sequence[Resolved], strings: Strings, *, rest: bool) -> Columns:
    """What templates hold: with `rest` only what differs from the templates that they rest on."""
    lists: dict[bytes, int] = {}
    values = [_values(level, each, strings, lists) for each in held]
    rows = {id(each): row for row, each in enumerate(held)}
    base = bases(values, [rows.get(id(each.parent), NO_BASE) if rest else NO_BASE for each in held])
    unused = [_unused(each) for each in held]
    return {
        "type": np.array([TYPES.index(each.type) for each in held]),
        "move": np.array([MOVES.index(each.move) for each in held]),
        "has_ai": np.array([each.has_ai for each in held]),
        "list_start": _starts([len(each) // ENTRY for each in lists]),
        "list_number": np.frombuffer(b"".join(lists), np.float64),
        "unused_start": _starts([len(each) for each in unused]),
        "unused_key": strings.indices(key for each in unused for key, _ in each),
        "unused_value": strings.indices(value for each in unused for _, value in each),
        **own_columns(values, [each.owner.index for each in held], base),
    }


def _values(level: Level, held: Resolved, strings: Strings, lists: dict[bytes, int]) -> Values:
    """What a template holds; each list of numbers gets a place in `lists`, by its bytes, which tell 0 from -0."""
    found = {}
    for key in PARAMETERS:
        setting = held.values.get(key)
        if setting is None:
            continue
        numbers = np.array(_numbers(setting.value), np.float64).tobytes()
        owner = setting.origins[0].owner
        (name,) = strings.indices([key]).tolist()
        place = lists.setdefault(numbers, len(lists))
        found[name] = Value(_name(setting, strings), owner.index if owner.level is level else -1, place)
    return found


def _unused(held: Resolved) -> list[tuple[str, str]]:
    """The parameters of a line that no known value comes of."""
    told = {
        origin.place
        for setting in held.values.values()
        if setting.value is not None
        for origin in setting.origins
        if origin.owner is held.owner
    }
    return [word for place, word in enumerate(held.owner.parameters) if place not in told]


def _starts(counts: Sequence[int]) -> npt.NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(np.array(counts, np.int64))])


def _name(setting: Setting, strings: Strings) -> int:
    """The name as the engine looks it up, or -1."""
    if setting.use.kind is not ValueKind.WORD or setting.value is None:
        return -1
    names = setting.value if isinstance(setting.value, tuple) else (setting.value,)
    return int(strings.indices([" ".join(map(str, names))])[0])


def _numbers(value: object) -> list[float]:
    if isinstance(value, tuple):
        return [number for part in value for number in _numbers(part)]
    return [float(value)] if isinstance(value, (int, float)) else []


def things(facts: LevelFacts, strings: Strings, _: CompileSettings) -> Columns | NotNeeded:
    """Things as placed, without those that the engine drops."""
    level = facts.level
    table = level.document.things
    kept = np.array([t.index for t in level.things if t.dropped is None], np.intp)
    if not len(kept):
        return NotNeeded("no thing is placed")
    return {
        "source": kept,
        "number": table.number[kept],
        "template": strings.indices(table.templates[i] for i in kept),
        "name": strings.indices(table.names[i] for i in kept),
        "position": table.position[kept],
        "angles": table.angles[kept],
        "sector": table.sector[kept],
        "arch_light": table.arch_light[kept],
        **_parameters(table.parameters, kept, strings),
    }


def cogs(facts: LevelFacts, strings: Strings, _: CompileSettings) -> Columns | NotNeeded:
    """Placed COGs with their values."""
    level = facts.level
    table = level.document.cogs
    if not len(table):
        return NotNeeded("no COG is placed")
    return {
        "source": np.arange(len(table)),
        "script": strings.indices(table.scripts),
        "value_start": table.value_start,
        "value": strings.indices(table.values),
    }


def visibility(facts: LevelFacts, _: Strings, settings: CompileSettings) -> Columns | NotNeeded:
    """Which sectors can be seen from which, a compressed row a sector."""
    rows = [compressed(row.tobytes()) for row in facts.visible_sectors(settings.accuracy).rows]
    if not rows:
        return NotNeeded("the level has no sector")
    return {
        "sector": np.arange(len(rows)),
        "row_start": np.concatenate([[0], np.cumsum([len(row) for row in rows])]),
        "row": np.frombuffer(b"".join(rows), np.uint8),
    }


def files(facts: LevelFacts, strings: Strings, _: CompileSettings) -> Columns | NotNeeded:
    """The files beside the level's source that the passes before looked for."""
    asked = facts.level.resources.looked_for
    if not asked:
        return NotNeeded("no other file was looked for")
    return {
        "name": strings.indices(each.name for each in asked),
        "folder": strings.indices(each.folder for each in asked),
        "found": np.array([each.sha256 is not None for each in asked]),
        "sha256": np.frombuffer(b"".join(each.sha256 or b"" for each in asked), np.uint8).reshape(-1, DIGEST),
    }


def _parameters(parameters: Parameters, kept: Rows, strings: Strings) -> Columns:
    counts = np.diff(parameters.start)
    words = np.concatenate([np.arange(parameters.start[i], parameters.start[i + 1]) for i in kept])
    return {
        "parameter_start": np.concatenate([[0], np.cumsum(counts[kept])]),
        "parameter_key": strings.indices(parameters.keys[i] for i in words),
        "parameter_value": strings.indices(parameters.values[i] for i in words),
    }
