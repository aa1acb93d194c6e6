"""The placed scripts of a compiled smithdev: their values are the file's, their code is the pack's."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import NamedTuple

import numpy as np

from fixtures.smithdev.pack import GOB
from jktools.facts.cog.instance import BoundValue
from jktools.model.cog.program import Program
from jktools.model.cog.values import Value
from jktools.source import Member, resolve
from jktools.syntax.cog import read_script
from tests.experiments.smithdev import Experiment

LINKING = ("thing", "surface", "sector")


class Link(NamedTuple):
    """An object whose messages a script gets, for the types of things that the mask has."""

    kind: str
    number: int
    mask: int


class Placed(NamedTuple):
    """A placed script: its name in its chamber, its code, and what its symbols start as, by slot."""

    name: str
    program: Program
    bound: Mapping[int, Value]
    links: tuple[Link, ...]


@cache
def program(file: str) -> Program:
    """A script of the pack."""
    member = resolve(f"{GOB}!cog/{file}")
    assert isinstance(member, Member)
    read = read_script(member.read())
    assert not read.rejected
    return Program(read.header, read.code)


def placed(smithdev: Experiment, name: str) -> Placed:
    """A placed script by `chamber/name`; a template's value is its row in the compiled file."""
    cogs, strings, templates = smithdev.level.cogs, smithdev.level.strings, smithdev.level.templates
    assert cogs is not None and templates is not None
    (row,) = np.flatnonzero(cogs.source == smithdev.cog(name))
    code = program(strings[cogs.script[row]])
    texts = [strings[i] for i in cogs.value[cogs.value_start[row] : cogs.value_start[row + 1]]]
    rows = {strings[i]: row for row, i in enumerate(templates.name)}
    bound: dict[int, Value] = {}
    links = []
    for position, (slot, text) in enumerate(zip(code.valued, texts, strict=True)):
        value = rows[text] if slot.type == "template" else BoundValue(slot, text, position).value
        assert value is not None and slot.declared is not None
        bound[slot.index] = value
        if slot.type in LINKING and slot.declared.link >= 0:
            links.append(Link(slot.type, int(text), slot.declared.mask))
    return Placed(name.partition("/")[2], code, bound, tuple(links))
