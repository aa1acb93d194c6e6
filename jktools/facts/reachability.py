"""What a level can reach in play: its templates, and the files that they and its scripts name.

Followed from what is certain to be there: placed things, placed COGs, surfaces and sectors, and what the engine itself
creates by name. From a template to those that it creates, explodes into, shoots, sheds or leaves behind, and to its
model, sprite, puppet, sounds, AI and COG; from a COG to the values and defaults of its symbols and to every string in
its code that names a template or a file; from a file to the files that it names.

A template's parent is not reached through it: the engine copies it while it reads, and needs it no more. A number in
place of a template counts those that the engine keeps (sithTemplate_GetEntryByIdx in the decompiled engine); it is
followed where the script's own code tells which it is.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from jktools.facts.script import ScriptFacts
from jktools.model import Cog, Level
from jktools.model.resolved import Resolved
from jktools.model.resources import Kind
from jktools.model.template_record import NONE
from jktools.source import InputError
from jktools.syntax.assets.reading import read_asset
from jktools.syntax.cog.nodes import String
from jktools.syntax.template.parameters import Refers

PLAYER = "walkplayer"
"""What players are: the level places one at each start."""

ENGINE_TEMPLATES = (PLAYER, "+ssparks_saber", "+ssparks_blood", "+ssparks_wall", "+twinkle", "+backpack")
"""What the engine creates by name: the player, sparks of the saber, twinkles of items and dropped backpacks."""

ITEMS = "items.dat"
STATIC = "static.jkl"

OF_STATIC = 0x8000
"""Added to the numbers of what static.jkl defines."""

_FILES: Mapping[str, Kind] = MappingProxyType(
    {
        "ai": Kind.AI_CLASS, "keyframe": Kind.KEYFRAME, "material": Kind.MATERIAL, "model": Kind.MODEL,
        "sound": Kind.SOUND,
    }
)  # fmt: skip
"""Kinds of file by the type of a script's symbol."""


_NAMING = frozenset({Kind.MODEL, Kind.SPRITE, Kind.PUPPET, Kind.SOUND_CLASS, Kind.PARTICLES, Kind.AI_CLASS, Kind.ITEMS})
"""Kinds of file that name others."""


class Unread(NamedTuple):
    """A script that the level uses, or a list of scripts, whose text is not at hand."""

    name: str
    why: str


@dataclass(frozen=True, slots=True)
class Reach:
    """What can be reached, each with the first way there that was found."""

    templates: Mapping[str, str]
    """By lower-case name."""
    files: Mapping[Kind, Mapping[str, str]]
    """By kind and lower-case name; missing files too."""
    unread: tuple[Unread, ...]
    """Scripts that may reach more than is known: while there is one, no template can be left out."""
    created: frozenset[str]
    """Those of the templates that play can create more things from, by lower-case name."""
    missing: tuple[str, ...]
    """Files that name further files and are not at hand: while there is one, no file can be left out."""

    @property
    def is_complete(self) -> bool:
        """Whether what is not reached cannot be."""
        return not self.unread

    def has(self, held: Resolved) -> bool:
        """Whether a template that the engine keeps is reached."""
        return held.dropped is None and str(held.owner.name).lower() in self.templates


ScriptOf = Callable[[str], "ScriptFacts | None"]
"""A script by its name; None for one that is not at hand."""


def reach(level: Level, script_of: ScriptOf) -> Reach:
    """Follow every way from what is placed. Files are read from the level's resources, each once."""
    search = _Search(level, script_of)
    search.run()
    return Reach(
        MappingProxyType(search.templates),
        MappingProxyType({kind: MappingProxyType(names) for kind, names in search.files.items()}),
        tuple(search.unread),
        frozenset(search.created),
        tuple(search.missing),
    )


class _Search:
    def __init__(self, level: Level, script_of: ScriptOf) -> None:
        self.level, self._script_of = level, script_of
        self.templates: dict[str, str] = {}
        self.created: set[str] = set()
        self.files: dict[Kind, dict[str, str]] = {kind: {} for kind in Kind}
        self.unread: list[Unread] = []
        self.missing: list[str] = []
        self.scripts: dict[str, ScriptFacts | None] = {}
        self._pending: deque[Resolved | tuple[Kind, str]] = deque()

    def run(self) -> None:
        self._start()
        while self._pending:
            at = self._pending.popleft()
            if isinstance(at, Resolved):
                self._follow(at, f"template {at.owner.name}")
            elif at[0] is Kind.COG:
                self._script(at[1])
            else:
                self._file(*at)

    def _start(self) -> None:
        level = self.level
        for thing in level.things:
            if thing.dropped is None:
                self._template(thing.template_name, f"{thing.title} is placed", placed=True)
                self._follow(thing.resolved, thing.title)
        for name in ENGINE_TEMPLATES:
            self._template(name, "the engine creates it by name", placed=name == PLAYER)
        for cog in level.cogs:
            self._reach(Kind.COG, cog.name, f"{cog.title} is placed")
            self._values(cog)
        for index in sorted(set(level.document.surfaces.material.tolist())):
            if 0 <= index < len(level.materials):
                self._reach(Kind.MATERIAL, level.materials[index], "surfaces have it")
        for sound in level.document.sectors.sound:
            if sound is not None:
                self._reach(Kind.SOUND, sound, "a sector has it")
        for name in level.colormaps:
            self._reach(Kind.COLORMAP, name, "sectors have it")
        self._start_with_the_game()

    def _start_with_the_game(self) -> None:
        """The COGs of static.jkl and of items.dat, which run in every level."""
        if self.level.resources.find(Kind.ITEMS, ITEMS) is None:
            self.unread.append(Unread(ITEMS, "not found"))
        else:
            self._reach(Kind.ITEMS, ITEMS, "the engine reads it")
        if self.level.static is None:
            self.unread.append(Unread(STATIC, "not found"))
        else:
            for cog in self.level.static.cogs:
                self._reach(Kind.COG, cog.name, f"{cog.title} of {STATIC}")
                self._values(cog)

    # ---- what is reached

    def _template(self, name: str, why: str, *, placed: bool = False) -> None:
        held = self.level.resolved_templates.get(name)
        if held is not None and not placed:
            self.created.add(name.lower())
        if held is not None and name.lower() not in self.templates:
            self.templates[name.lower()] = why
            self._pending.append(held)

    def _reach(self, kind: Kind, name: str, why: str) -> None:
        if name and name.lower() != NONE and name.lower() not in self.files[kind]:
            self.files[kind][name.lower()] = why
            self._pending.append((kind, name))

    def _follow(self, held: Resolved, why: str) -> None:
        """What a template or thing names; a thing's own name is that of its line, so that both are followed."""
        for key, name, _ in held.templates:
            self._template(name, f"{key} of {why}")
        for key, setting in held.values.items():
            if setting.use.refers is None or setting.use.refers is Refers.TEMPLATE or setting.value is None:
                continue
            kind = Kind.of_extension(setting.use.refers.value)
            if kind is not None:
                self._reach(kind, str(setting.value), f"{key} of {why}")

    def _file(self, kind: Kind, name: str) -> None:
        found = self.level.resources.find(kind, name)
        if kind not in _NAMING or found is None:
            self.missing += [name] if kind in _NAMING else []
            return
        try:
            references = read_asset(self.level.resources.read(found), kind.extension, self.level.game).references
        except InputError:
            self.missing.append(name)
            return
        for reference in references:
            named = Kind.of_extension(reference.extension)
            if named is not None:
                self._reach(named, reference.name, f"{name} names it")

    # ---- scripts

    def _script(self, name: str) -> None:
        facts = self._read(name)
        if facts is None:
            return
        for symbol in facts.script.header.symbols:
            if symbol.default is not None:
                self._value(symbol.type, symbol.default, f"default of {symbol.name.key} in {name}")
        for word in facts.script.code.words:
            if isinstance(word, String):
                self._template(word.value, f'"{word.value}" in the code of {name}')
                self._named(word.value, name)
        for site in facts.rates.sites:
            for argument, value in zip(site.verb.args, site.arguments, strict=False):
                if argument.kind == "template" and value.number is not None:
                    self._numbered(value.number, f"its number in {site.verb.name} of {name}")

    def _numbered(self, number: float, why: str) -> None:
        """A template by its place among those that the engine keeps, the game's own with `OF_STATIC` added."""
        if not 0 <= number < 2 * OF_STATIC:
            return
        level = self.level.static if number >= OF_STATIC else self.level
        kept = [] if level is None else [each for each in level.templates if each.dropped is None]
        index = int(number) % OF_STATIC
        if index < len(kept):
            self._template(kept[index].name, why)

    def _named(self, text: str, script: str) -> None:
        """A string in code that looks like a file."""
        kind = Kind.of_extension(text.rpartition(".")[2]) if "." in text else None
        if kind is not None and kind is not Kind.LEVEL:
            self._reach(kind, text, f"named in the code of {script}")

    def _read(self, name: str) -> ScriptFacts | None:
        """A script that runs: at hand, and taken by the engine."""
        key = name.lower()
        if key not in self.scripts:
            found = self._script_of(key)
            if found is None:
                self.unread.append(Unread(name, "not found"))
            self.scripts[key] = None if found is None or found.script.rejected else found
        return self.scripts[key]

    def _values(self, cog: Cog) -> None:
        facts = self._read(cog.name)
        if facts is not None:
            for slot, value in zip(facts.program.valued, cog.values, strict=False):
                self._value(slot.type, value, f"{slot.name} of {cog.title}")

    def _value(self, type_: str, value: str, why: str) -> None:
        if type_ == "template":
            self._template(value, why)
        elif type_ in _FILES:
            self._reach(_FILES[type_], value, why)
