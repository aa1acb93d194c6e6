"""The verbs of the game: what each takes, gives and costs, from `verbs.jsonl`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Literal

import msgspec

Kind = Literal[
    "any", "int", "flex", "vector", "string", "thing", "surface", "sector", "cog", "template", "model", "keyframe",
    "sound", "material", "aiclass",
]  # fmt: skip
"""What an argument is read as. All but flex, vector, string and any are numbers to the engine."""
Result = Literal[
    "void", "any", "int", "flex", "vector", "string", "thing", "surface", "sector", "cog", "template", "model",
    "keyframe", "sound", "material",
]  # fmt: skip
Origin = Literal["jk", "mots", "openjkdf2", "droidworks", "user"]
"""Where a verb was registered first: Mysteries of the Sith has those of Jedi Knight too."""
Sight = Literal["ray", "flood", "cached"]
"""How a verb of sight pays: one ray, a walk through sectors, or the answer of an earlier search."""

REFERENCES = frozenset({"thing", "surface", "sector", "cog", "template", "model", "keyframe", "sound", "material"})
"""Kinds whose values are indices, -1 for none."""


class Argument(msgspec.Struct, frozen=True, array_like=True):
    """One argument, with the values that do anything, where they are known."""

    kind: Kind
    name: str
    least: float | None = None
    greatest: float | None = None


class Verb(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One verb as the decompiled engine registers it; names are lower case."""

    name: str
    args: tuple[Argument, ...] = ()
    returns: Result = "void"
    game: Origin = "user"
    category: str = "user"
    sleeps: bool = False
    """It may suspend the script."""
    delivers: bool = False
    """It may run handlers, of this script too, before it comes back."""
    sight: Sight | None = None
    pure: bool = False
    """A call whose result is not used does nothing."""
    pushes: Literal["once", "maybe", "twice"] = "once"
    """`maybe`: nothing comes back for an invalid target; `twice`: two values can come back."""
    crashes: bool = False
    """A null argument ends the game."""
    same_as: tuple[str, ...] = ()
    note: str = ""

    @property
    def gives(self) -> bool:
        """Whether a call leaves a value on the stack."""
        return self.returns != "void"

    @property
    def signature(self) -> str:
        """For messages: `haslos(thing from_thing, thing to_thing) -> int`."""
        given = f" -> {self.returns}" if self.gives else ""
        return f"{self.name}({', '.join(f'{a.kind} {a.name}' for a in self.args)}){given}"


@cache
def all_verbs() -> Mapping[str, Verb]:
    """Every verb of every game by lower-case name; read once, 2 ms."""
    text = files("jktools.model.cog").joinpath("verbs.jsonl").read_bytes()
    return {verb.name: verb for verb in msgspec.json.Decoder(Verb).decode_lines(text)}


KNOWN_TO: Mapping[str, frozenset[str]] = {
    "jk": frozenset({"jk", "user"}),
    "mots": frozenset({"jk", "mots", "user"}),
}
"""Which origins a game's scripts can call."""


@cache
def verbs_of(game: str) -> Mapping[str, Verb]:
    """The verbs that a game registers, by lower-case name."""
    return {name: verb for name, verb in all_verbs().items() if verb.game in KNOWN_TO[game]}


def verb_from(name: str, args: tuple[Kind, ...], returns: Result, *, sleeps: bool = False) -> Verb:
    """A verb that a custom build registers; nothing is known of what it does, so it may run handlers."""
    return Verb(
        name.lower(),
        tuple(Argument(kind, f"argument{i}") for i, kind in enumerate(args, 1)),
        returns,
        sleeps=sleeps,
        delivers=True,
    )
