"""Which files the mods of a run name, which of those are there, and which files nobody names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from jktools.diagnostics import Diagnostic, Label
from jktools.facts.references import NONE, file_references
from jktools.facts.usage_codes import MISPLACED_FILE as MISPLACED_FILE
from jktools.facts.usage_codes import UNUSED_FILE as UNUSED_FILE
from jktools.linter.rule import Document
from jktools.model import Level
from jktools.model.resources import Kind, Resources
from jktools.source import Container, Member, Source
from jktools.source.container import canonical
from jktools.syntax.assets.asset import Asset

ALWAYS_READ = frozenset({Kind.LEVEL, Kind.ITEMS, Kind.EPISODE, Kind.STRINGS, Kind.CUTSCENE})
"""Kinds that the engine reads by themselves, or that no file has to name."""

NAMING = (
    Kind.LEVEL, Kind.COG, Kind.MODEL, Kind.SPRITE, Kind.PUPPET, Kind.SOUND_CLASS, Kind.PARTICLES, Kind.ITEMS,
    Kind.EPISODE,
)  # fmt: skip
"""Kinds of file that name others."""

_NAME_IN_CODE = re.compile(
    r"[A-Za-z0-9_.+\-]+\.(?:" + "|".join(kind.extension for kind in Kind if kind not in ALWAYS_READ) + r")\b",
    re.IGNORECASE,
)
"""A file's name anywhere in a script: a symbol's default or a string. Comments count too, in the file's favour."""


@dataclass(frozen=True, slots=True)
class KindCount:
    """One kind of file over a run; a name that several levels of one mod use counts once."""

    kind: str
    own: int
    """Names whose file comes with the mod."""
    base: int
    """Names whose file a base has."""
    missing: int
    """Names without a file; without a base they may be the game's."""
    unused: int
    """Files of the mod that nobody in it names and no base has; they may replace some of a game that is not at hand."""


def added(one: list[KindCount], other: list[KindCount]) -> list[KindCount]:
    """The counts of two runs as one."""
    sums: dict[str, KindCount] = {}
    for count in (*one, *other):
        old = sums.get(count.kind, KindCount(count.kind, 0, 0, 0, 0))
        sums[count.kind] = KindCount(
            count.kind, old.own + count.own, old.base + count.base, old.missing + count.missing,
            old.unused + count.unused,
        )  # fmt: skip
    return [sums[kind.title] for kind in Kind if kind.title in sums]


@dataclass
class _Mod:
    resources: Resources
    named: set[tuple[Kind, str]] = field(default_factory=set)
    read: set[str] = field(default_factory=set)
    """Paths of the files that were read."""


class Usage:
    """Gathers the names that documents give to files, mod by mod."""

    def __init__(self) -> None:
        """Know of no mod."""
        self._mods: dict[str, _Mod] = {}

    def add(self, document: Document, resources: Resources) -> None:
        """Take the names in one document, which are looked for in `resources`."""
        if not resources.roots:
            return
        mod = self._mods.setdefault(resources.roots[0].path, _Mod(resources))
        mod.read.add(document.source.path)
        mod.named.update((kind, canonical(name)) for kind, name in _names(document) if name and name.lower() != NONE)

    def counts(self) -> list[KindCount]:
        """What was found, kind by kind; kinds that occur nowhere are left out."""
        own, base, missing, unused = Counter[Kind](), Counter[Kind](), Counter[Kind](), Counter[Kind]()
        for mod in self._mods.values():
            for kind, name in mod.named:
                found = mod.resources.find(kind, name)
                (missing if found is None else own if found.own else base)[kind] += 1
            unused.update(kind for kind, _ in _unused(mod))
        return [
            KindCount(kind.title, own[kind], base[kind], missing[kind], unused[kind])
            for kind in Kind
            if own[kind] or base[kind] or missing[kind] or unused[kind]
        ]

    def findings(self) -> Iterator[Diagnostic]:
        """JK150 and JK151 over all mods."""
        for mod in self._mods.values():
            for kind, member in _unused(mod):
                yield Diagnostic(
                    UNUSED_FILE, UNUSED_FILE.severity, Label(Source(member.path, b"", member.name)),
                    f"the {kind.title} file is in the mod, but nothing in the mod names it"
                    + ("" if mod.resources.has_base else "; it may replace one of the game's"),
                    "leave it out of the pack, unless it is meant to replace a file of the game",
                )  # fmt: skip
            for kind, member in _misplaced(mod):
                here = member.name.rpartition("/")[0] or "."
                wanted = " and ".join(f'"{folder}"' for folder in kind.folders)
                yield Diagnostic(
                    MISPLACED_FILE, MISPLACED_FILE.severity, Label(Source(member.path, b"", member.name)),
                    f'the file lies in "{here}", but the engine looks for its kind in {wanted}',
                    "move it there; the engine does not find it",
                )  # fmt: skip


def _names(document: Document) -> Iterator[tuple[Kind, str]]:
    if isinstance(document, Level):
        yield from ((reference.kind, reference.name) for reference in file_references(document))
    elif isinstance(document, Asset):
        for reference in document.references:
            kind = Kind.of_extension(reference.extension)
            if kind is not None:
                yield kind, reference.name
    else:
        for name in _NAME_IN_CODE.findall(document.source.text):
            kind = Kind.of_extension(name.rpartition(".")[2])
            if kind is not None:
                yield kind, name


def _unused(mod: _Mod) -> Iterator[tuple[Kind, Member]]:
    """The files that nobody names, where everything in the mod that could name them was read."""
    if any(member.path not in mod.read for _, member in mod.resources.own_files(NAMING)):
        return
    for kind, member in mod.resources.own_files([kind for kind in Kind if kind not in ALWAYS_READ]):
        name = canonical(member.name).rpartition("/")[2]
        if (kind, name) not in mod.named and not mod.resources.in_base(kind, name) and name != kind.default:
            yield kind, member


def _misplaced(mod: _Mod) -> Iterator[tuple[Kind, Member]]:
    """Files of a pack whose kind the engine looks for elsewhere."""
    pack = getattr(mod.resources.roots[0], "pack", None)
    for member in pack.members if isinstance(pack, Container) else ():
        kind = Kind.of_extension(member.extension)
        if kind is None or kind in (Kind.ITEMS, Kind.STRINGS, Kind.CUTSCENE):
            continue
        if Kind.placed(member.name) is None:
            yield kind, member
