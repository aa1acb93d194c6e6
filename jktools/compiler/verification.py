"""Whether a compiled level holds what comes of its source, and what can be told without the source."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from jktools.compiler.columns import SECTIONS
from jktools.compiler.reader import CompiledLevel
from jktools.compiler.section import Section
from jktools.engine.light import light_on_vertices
from jktools.geometry import Accuracy

LIGHT_WITHIN = 1e-5
"""The pass adds up light in double precision from a place that the file holds in single."""


def first_difference(level: CompiledLevel, again: CompiledLevel) -> str | None:
    """Where a file first differs from the same level compiled again, in one sentence, or None.

    Compared are the values of every column bit for bit, section by section, whatever form they are stored in, the
    header lines, what was left out, and which passes ran and why not. A file of an older format is compared by the
    columns that both have.
    """
    for name, here, there in (("settings", level.settings, again.settings), ("world", level.world, again.world)):
        for key, value in here.items():
            if not _equal(value, there.get(key)):
                return f"{name}.{key} is {value}, but {there.get(key)} when compiled again"
    for section in SECTIONS:
        if all(column.since > level.format_minor for column in SECTIONS[section].values()):
            continue
        mine, other = level.sections.get(section), again.sections.get(section)
        if (mine is None) != (other is None):
            return f"the section {section} is {_there(mine)}, but {_there(other)} when compiled again"
        if mine is not None and other is not None:
            fault = _section(level, again, mine, other)
            if fault:
                return f"{section}.{fault}"
    if level.omissions != again.omissions:
        return "what is left out differs from what is when compiled again"
    for name, state in level.passes.items():
        now = again.passes.get(name)
        if now != state:
            return f"the pass {name} {_outcome(state)}, but {_outcome(now)} when compiled again"
    return None


def changed_inputs(level: CompiledLevel, again: CompiledLevel) -> list[str]:
    """What has become of each input since, in a phrase: changed, gone or new. None for a file that lists none.

    Where inputs changed, others can be looked for: those are told only where nothing else is.
    """
    if level.files is None:
        return []
    then, now = ({**dict.fromkeys(each.missing_inputs), **dict(each.inputs[1:])} for each in (level, again))
    both = [path for path in then if path in now]
    return [_change(path, then[path], now[path]) for path in sorted(both) if then[path] != now[path]] or [
        f"{path} is looked for {'now' if path in now else 'no more'}" for path in sorted(then.keys() ^ now.keys())
    ]


def _change(path: str, then: str | None, now: str | None) -> str:
    if now is None:
        return f"{path} is not at hand"
    return f"{path} was not at hand, but is now" if then is None else f"{path} is SHA-256 {now}, but was {then}"


def _outcome(state: Mapping[str, Any] | None) -> str:
    if state is None:
        return "is unknown"
    outcome = "ran" if state["ran"] else "failed" if state["failed"] else "did not run"
    return outcome + (f" and says {state['note']!r}" if state["note"] else "")


def _there(section: Section | None) -> str:
    return "absent" if section is None else "there"


def _equal(one: Any, other: Any) -> bool:
    return np.array_equal(np.asarray(one), np.asarray(other), equal_nan=not isinstance(one, str))


def _section(level: CompiledLevel, again: CompiledLevel, mine: Section, other: Section) -> str | None:
    for name in mine.stored:
        if not hasattr(other, name):
            continue
        here, there = getattr(mine, name), getattr(other, name)
        if len(here) != len(there):
            return f"{name} has {len(here)} rows, but {len(there)} when compiled again"
        if name in mine.texts:
            if level.strings == again.strings and here.tobytes() == there.tobytes():
                continue
            one, two = (_texts(source, values) for source, values in ((level, here), (again, there)))
            wrong = next((i for i, pair in enumerate(zip(one, two, strict=True)) if pair[0] != pair[1]), None)
            if wrong is not None:
                return f"{name} {wrong} is {one[wrong]!r}, but {two[wrong]!r} when compiled again"
        elif here.tobytes() != there.tobytes():
            wrong = int(np.flatnonzero((_octets(here) != _octets(there)).any(axis=1))[0])
            return f"{name} {wrong} is {here[wrong]}, but {there[wrong]} when compiled again"
    return None


def _octets(values: npt.NDArray[Any]) -> npt.NDArray[np.uint8]:
    return np.ascontiguousarray(values).view(np.uint8).reshape(len(values), -1)


def _texts(level: CompiledLevel, values: npt.NDArray[Any]) -> list[str | None]:
    return [None if i < 0 else level.strings[i] for i in values.tolist()]


def by_itself(level: CompiledLevel, accuracy: Accuracy) -> Iterator[tuple[str, str | None]]:
    """Check what follows from the file's own vertices: what was checked, and what is wrong with it or None.

    Visibility is derived again from the adjoins as they are; scripts can open more, so that the file may show more
    than that, but never less. The light of lamps is computed again on the vertices that the file lists.
    """
    if level.visibility is not None:
        yield "what can be seen through the file's own adjoins", _visibility_fault(level, accuracy)
    if level.lights is not None:
        yield "the light of lamps on the file's own vertices", _light_fault(level)


def _visibility_fault(level: CompiledLevel, accuracy: Accuracy) -> str | None:
    stored = level.visible_sectors
    assert stored is not None
    try:
        derived = level.mesh.visibility(accuracy)
    except ValueError as error:  # a vertex that is not finite
        return f"there is no visibility in such geometry: {error}"
    missing = np.argwhere(derived & ~stored)
    if not len(missing):
        return None
    a, b = missing[0]
    return f"sector {b} can be seen from sector {a}, but the file denies it ({len(missing)} such pairs)"


def _light_fault(level: CompiledLevel) -> str | None:
    lights = level.lights
    assert lights is not None
    for row, position in enumerate(lights.position):
        part = slice(int(lights.vertex_start[row]), int(lights.vertex_start[row + 1]))
        vertices = level.geometry.vertices[lights.vertex[part]]
        amounts = light_on_vertices(vertices, position[None], [float(lights.intensity[row])]).astype(np.float32)
        wrong = np.flatnonzero(~np.isclose(amounts, lights.amount[part], rtol=0, atol=LIGHT_WITHIN))
        if len(wrong):
            vertex = lights.vertex[part][wrong[0]]
            told = lights.amount[part][wrong[0]]
            return f"light {row} gives vertex {vertex} {told:g}, but {amounts[wrong[0]]:g} comes of its place"
    return None
