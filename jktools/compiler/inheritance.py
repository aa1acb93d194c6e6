"""The values of templates as they lie in the file: each template's own, and those of the one that it rests on.

A template that has a value for every parameter that its parent has one for rests on its parent, and only the values
that differ are its own; any other one rests on nothing, and all its values are. The base comes before what rests on
it, so that a reader that goes through the rows in order, or from a row to its base and on, comes to an end.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

NO_BASE = -1
ITSELF, OF_THE_GAME = 0, -1
"""In `own_setter`: the template's own line, and one of the game's static.jkl; else 1 more than a position."""


class Value(NamedTuple):
    """What the file tells of a template's value."""

    text: int
    """Index of a string, or -1."""
    setter: int
    """Position of the template whose line set it; -1 for one of the game's static.jkl."""
    numbers: int
    """Which list of numbers."""


Values = Mapping[int, Value]
"""By the index of the parameter's name."""


class Columns(Protocol):
    """Anything that has the columns of a section as attributes."""

    def __getattr__(self, name: str) -> Array: ...


def bases(values: Sequence[Values], parents: Sequence[int]) -> list[int]:
    """The row that each template rests on, of the rows of their parents; NO_BASE for none."""
    return [
        parent if 0 <= parent < row and values[parent].keys() <= values[row].keys() else NO_BASE
        for row, parent in enumerate(parents)
    ]


def own_columns(values: Sequence[Values], source: Sequence[int], base: Sequence[int]) -> dict[str, Array]:
    """The columns `base` and `own_*` of templates at these positions of their section."""
    own = [
        sorted((key, value) for key, value in mine.items() if rest < 0 or values[rest].get(key) != value)
        for mine, rest in zip(values, base, strict=True)
    ]
    flat = [(key, value, row) for row, each in enumerate(own) for key, value in each]
    return {
        "base": np.array(base, np.int32),
        "own_start": np.concatenate([[0], np.cumsum([len(each) for each in own], dtype=np.int64)]),
        "own_key": np.array([key for key, _, _ in flat], np.uint32),
        "own_text": np.array([value.text for _, value, _ in flat], np.int32),
        "own_setter": np.array([_relative(value.setter, source[row]) for _, value, row in flat], np.int32),
        "own_list": np.array([value.numbers for _, value, _ in flat], np.uint32),
    }


def _relative(setter: int, source: int) -> int:
    return OF_THE_GAME if setter < 0 else ITSELF if setter == source else setter + 1


def inherited(templates: Columns) -> dict[str, Array]:
    """Every value of every template, `value_start`, `value_key`, `value_text`, `value_source` and `value_list`."""
    start, base, source = (getattr(templates, name).tolist() for name in ("own_start", "base", "source"))
    own = list(
        zip(*(getattr(templates, f"own_{part}").tolist() for part in ("key", "text", "setter", "list")), strict=True)
    )
    held: list[dict[int, tuple[int, int, int]]] = []
    for row, rest in enumerate(base):
        values = dict(held[rest]) if rest >= 0 else {}
        for key, text, setter, numbers in own[start[row] : start[row + 1]]:
            values[key] = (text, source[row] if setter == ITSELF else max(setter - 1, -1), numbers)
        held.append(values)
    return _flat(held)


def _flat(held: Iterable[Mapping[int, tuple[int, int, int]]]) -> dict[str, Array]:
    rows = [sorted(values.items()) for values in held]
    flat = [(key, *value) for each in rows for key, value in each]
    table = np.array(flat, np.int64).reshape(-1, 4)
    made = {
        "value_start": np.concatenate([[0], np.cumsum([len(each) for each in rows], dtype=np.int64)]).astype("<u4"),
        **{
            name: table[:, i].astype(kind)
            for i, (name, kind) in enumerate(
                (("value_key", "<u4"), ("value_text", "<i4"), ("value_source", "<i4"), ("value_list", "<u4"))
            )
        },
    }
    for array in made.values():
        array.flags.writeable = False
    return made
