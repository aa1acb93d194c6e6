"""A template of a compiled level, as the engine holds it: the values of its row by their parameters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import pairwise

from jktools.compiler.queries import Columns
from jktools.syntax.template.parameters import MOVES, TYPES


class HeldTemplate:
    """One template: what its line and all that it inherits give it. docs/parameters.md tells of the parameters."""

    def __init__(self, templates: Columns, strings: Sequence[str], row: int) -> None:
        """Look at a row of the section."""
        self._templates, self._strings, self._row = templates, strings, row

    @property
    def name(self) -> str:
        """As written."""
        return str(self._strings[self._templates.name[self._row]])

    @property
    def source(self) -> int:
        """Position of the record in its section."""
        return int(self._templates.source[self._row])

    @property
    def type(self) -> str:
        """As `type` spells it: `actor`."""
        return TYPES[self._templates.type[self._row]]

    @property
    def move(self) -> str:
        """As `move` spells it: `physics`."""
        return MOVES[self._templates.move[self._row]]

    def number(self, key: str) -> float:
        """A number that a parameter holds; 0 where nothing sets it, and for what is no single number."""
        held = self._numbers(key)
        return held[0] if len(held) == 1 else 0.0

    def flags(self, key: str) -> int:
        """The flags that a parameter holds."""
        return int(self.number(key))

    def name_in(self, key: str) -> str | None:
        """The name that a parameter holds, in lower case; of debris all names, parted by a blank."""
        place = self._places.get(key)
        text = -1 if place is None else int(self._templates.value_text[place])
        return None if text < 0 else self._strings[text]

    def _numbers(self, key: str) -> list[float]:
        place = self._places.get(key)
        if place is None:
            return []
        first, end = self._templates.number_start[place : place + 2].tolist()
        found: list[float] = self._templates.number[first:end].tolist()
        return found

    @cached_property
    def _places(self) -> dict[str, int]:
        first, end = self._templates.value_start[self._row : self._row + 2].tolist()
        keys = self._templates.value_key[first:end].tolist()
        return {self._strings[key]: first + i for i, key in enumerate(keys)}


def templates_of(templates: Columns, strings: Sequence[str]) -> Iterator[HeldTemplate]:
    """The templates of a section in its order."""
    return (HeldTemplate(templates, strings, row) for row, _ in enumerate(pairwise(templates.value_start.tolist())))
