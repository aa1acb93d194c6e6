"""A script as a level places it: the values of its `cogs` line, its number, and its flow under those values."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.dataflow import default_value
from jktools.facts.script import ScriptFacts
from jktools.model.cog.program import Slot
from jktools.model.cog.values import Value, Vector, flex
from jktools.model.objects import Cog
from jktools.source import Span

NUMBERED = frozenset({"thing", "surface", "sector", "cog"})
"""Symbols whose values are numbers of the level's own objects."""
RESOURCES = frozenset({"template", "model", "keyframe", "sound", "material", "ai"})
"""Symbols whose values are names; what number the engine gives them is not known here."""

_INT = re.compile(r"[-+]?\d+")
_FLEX = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_VECTOR = re.compile(r"\(([^/()]*)/([^/()]*)/([^/()]*)\)")


@dataclass(frozen=True, slots=True)
class BoundValue:
    """One value of a `cogs` line and the symbol that it goes to."""

    slot: Slot
    text: str
    """As written."""
    position: int
    """Among the values of the line, from 0."""

    @property
    def is_read_whole(self) -> bool:
        """Whether the engine's reading of a number takes all of the text."""
        if self.slot.type in ("flex", "float"):
            return _FLEX.fullmatch(self.text) is not None
        if self.slot.type == "vector":
            match = _VECTOR.fullmatch(self.text)
            return match is not None and all(_FLEX.fullmatch(part.strip()) for part in match.groups())
        return self.slot.type in RESOURCES or _INT.fullmatch(self.text) is not None

    @property
    def value(self) -> Value | None:
        """What the symbol starts as; None for the number of a resource."""
        if self.slot.type in RESOURCES:
            return None
        if self.slot.type == "vector":
            match = _VECTOR.match(self.text)
            parts = match.groups() if match is not None else ("0", "0", "0")
            return Vector(*(flex(float(m.group()) if (m := _FLEX.match(p.strip())) else 0.0) for p in parts))
        return default_value(self.slot.type, self.text)


class InstanceFacts:
    """One placed script, each fact worked out on first use."""

    def __init__(self, cog: Cog, script: ScriptFacts | None, number: int) -> None:
        """`script` is None for one that cannot be found; `number` is the engine's, -1 where it makes no cog."""
        self.cog = cog
        self.script = script
        self.number = number

    @cached_property
    def values(self) -> tuple[BoundValue, ...]:
        """The values that a symbol takes, in the order of the line."""
        if self.script is None:
            return ()
        pairs = zip(self.script.program.valued, self.cog.values, strict=False)
        return tuple(BoundValue(slot, text, position) for position, (slot, text) in enumerate(pairs))

    @cached_property
    def bound(self) -> Mapping[int, Value]:
        """The values that are known, by slot."""
        return {each.slot.index: value for each in self.values if (value := each.value) is not None}

    @cached_property
    def analysis(self) -> Analysis | None:
        """Its flow under these values; None for a script that cannot be found or that the engine refuses."""
        if self.script is None or self.script.script.rejected:
            return None
        return Analysis(self.script.program, self.bound, self.script.analysis)

    def value_span(self, position: int) -> Span:
        """Where a value of its line stands; the whole line where that cannot be told."""
        whole = self.cog.span
        words = list(re.finditer(r"[^\s,]+", whole.text))
        if len(words) < position + 3 or words[position + 2].group() != self.cog.values[position]:
            return whole
        word = words[position + 2]
        return whole.source.span(whole.start + word.start(), whole.start + word.end())
