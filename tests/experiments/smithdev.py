"""smithdev as an experiment sees it: the compiled level by names, and what the document measured."""

from __future__ import annotations

import json
import math
import tomllib
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from fixtures.smithdev.pack import HANDLES
from jktools.compiler import CompiledLevel
from jktools.engine.body import Body
from tests.support.levels import ROOT

GOLDEN: dict[str, Any] = tomllib.loads((ROOT / "tests/engine/golden.toml").read_text("utf-8"))
"""Every number that the research document measured."""

HANDLE: dict[str, Any] = json.loads(HANDLES.read_text("ascii"))
"""By chamber: the numbers of what it names (`sectors`, `surfaces`, `things`, `cogs`), and `about`."""

ACTOR, WEAPON, DEBRIS, PLAYER, PARTICLE = 2, 3, 4, 10, 11
"""Types of things."""


class Experiment:
    """A compiled smithdev; names are `chamber/name`, those of surfaces `chamber/sector.face`."""

    def __init__(self, path: Path, level: CompiledLevel, handles: dict[str, Any] = HANDLE) -> None:
        """Take an opened file and its handles."""
        self.path, self.level, self.handles = path, level, handles

    def sector(self, name: str) -> int:
        """A sector's number."""
        return self._held("sectors", name)

    def surfaces(self, name: str) -> list[int]:
        """The surfaces that a face or an opening consists of."""
        chamber, _, own = name.partition("/")
        found: list[int] = self.handles[chamber]["surfaces"][own]
        return found

    def thing(self, name: str) -> int:
        """A thing's position in its section, which is its number too."""
        return self._held("things", name)

    def look(self, name: str) -> list[float]:
        """Where a thing looks, by its yaw: a unit vector."""
        assert self.level.things is not None
        pitch, yaw, roll = self.level.things.angles[self.thing(name)].tolist()
        assert (pitch, roll) == (0, 0)
        return [-math.sin(math.radians(yaw)), math.cos(math.radians(yaw)), 0.0]

    def cog(self, name: str) -> int:
        """A placed script's number."""
        return self._held("cogs", name)

    def about(self, chamber: str) -> Any:
        """What a chamber says of itself."""
        return self.handles[chamber]["about"]

    @cached_property
    def _template_rows(self) -> dict[str, int]:
        assert self.level.templates is not None
        return {self.level.strings[name]: row for row, name in enumerate(self.level.templates.name)}

    def template(self, name: str) -> dict[str, Any]:
        """The record that the engine makes of a template: its numbers, vectors and names by parameter."""
        held, row = self.level.templates, self._template_rows[name]
        assert held is not None
        record: dict[str, Any] = {}
        for i in range(held.value_start[row], held.value_start[row + 1]):
            numbers = held.number[held.number_start[i] : held.number_start[i + 1]].tolist()
            text = int(held.value_text[i])
            value = self.level.strings[text] if not numbers and text >= 0 else numbers
            record[self.level.strings[held.value_key[i]]] = value[0] if len(value) == 1 else value
        # The words of these two stand among the values; their numbers are what the file has by them.
        return record | {"type": int(held.type[row]), "move": int(held.move[row])}

    def motion(self, template: str) -> dict[str, Any]:
        """How an actor or player moves on flat ground, by the file's own names: JKU and seconds."""
        held, templates = self.level.motion, self.level.templates
        assert held is not None and templates is not None
        (row,) = np.flatnonzero(held.template == templates.source[self._template_rows[template]])
        return {name: column[row].tolist() for name, column in held.columns.items()}

    def engine_body(self, template: str) -> Body:
        """The body that a template's compiled record gives; its insert offset is left out."""
        record = self.template(template)
        names = ("maxthrust", "surfdrag", "airdrag", "staticdrag", "mass", "movesize", "jumpspeed", "maxvel")
        numbers = {name: float(record.get(name, 0.0)) for name in names}
        return Body(**numbers, physflags=int(record["physflags"]), player=record["type"] == PLAYER)

    def cog_values(self, name: str) -> list[str]:
        """A placed script's values as written."""
        cogs, cog = self.level.cogs, self.cog(name)
        assert cogs is not None
        return [self.level.strings[i] for i in cogs.value[cogs.value_start[cog] : cogs.value_start[cog + 1]]]

    def body(self, template: str) -> int:
        """The walking body that a template has, as the ledges count them."""
        held = self.level.ledges
        assert held is not None
        for body in range(len(held.body_movesize)):
            names = held.body_name[held.body_name_start[body] : held.body_name_start[body + 1]]
            if template in {self.level.strings[name] for name in names}:
                return body
        raise KeyError(f"no body is that of {template}")

    def ledges(self, body: int, surface: int, below: int | None = None) -> np.ndarray[Any, Any]:
        """The rows of a body's ledges on a surface, all or those that lead to one other."""
        held = self.level.ledges
        assert held is not None
        rows = np.arange(held.body_ledge_start[body], held.body_ledge_start[body + 1])
        rows = rows[held.surface[rows] == surface]
        return rows if below is None else rows[held.below[rows] == below]

    def _held(self, kind: str, name: str) -> int:
        chamber, _, own = name.partition("/")
        return int(self.handles[chamber][kind][own])
