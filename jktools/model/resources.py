"""The files that a level refers to: where the engine looks for each kind, and what it takes when there is none."""

from __future__ import annotations

import enum
from collections import OrderedDict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

from jktools.source import InputError, Member, Source
from jktools.source.container import canonical
from jktools.source.roots import Root, home_of, open_roots
from jktools.syntax.assets.model import Model
from jktools.syntax.assets.threedo import read_model

MOST_CACHED = 2**26
"""Bytes of files whose contents are kept, as read or as parsed; parsed, they take a few times that."""


class Kind(enum.Enum):
    """A kind of file: its folders in the order of the search, its extension, and what stands in for a missing one.

    Folders: `facts` of the decompiled engine, sithWorld and the loaders of each kind. A missing model, material, sprite
    or AI class is replaced by the default file; where that is missing too, the level fails but for models, which are
    left out.
    """

    MATERIAL = ("material", "mat", ("mat", "3do/mat"), "dflt.mat")
    MODEL = ("model", "3do", ("3do",), "dflt.3do")
    SPRITE = ("sprite", "spr", ("misc/spr",), "default.spr")
    KEYFRAME = ("keyframe", "key", ("3do/key",), None)
    PUPPET = ("puppet", "pup", ("misc/pup",), None)
    SOUND_CLASS = ("soundclass", "snd", ("misc/snd",), None)
    SOUND = ("sound", "wav", ("sound", "voice"), None)
    AI_CLASS = ("aiclass", "ai", ("misc/ai",), "default.ai")
    PARTICLES = ("particles", "par", ("misc/par",), None)
    COLORMAP = ("colormap", "cmp", ("misc/cmp",), None)
    COG = ("cog", "cog", ("cog",), None)
    LEVEL = ("level", "jkl", ("jkl",), None)
    ITEMS = ("items", "dat", ("misc",), None)
    EPISODE = ("episode", "jk", ("",), None)
    STRINGS = ("strings", "uni", ("misc", "ui"), None)
    CUTSCENE = ("cutscene", "smk", ("video",), None)

    def __init__(self, title: str, extension: str, folders: tuple[str, ...], default: str | None) -> None:
        self.title = title
        self.extension = extension
        self.folders = folders
        self.default = default

    @classmethod
    def of_extension(cls, extension: str) -> Kind | None:
        """The kind of a file by the extension of its name, without the dot."""
        return next((kind for kind in cls if kind.extension == extension.lower()), None)


@dataclass(frozen=True, slots=True)
class Found:
    """A file that a name leads to."""

    kind: Kind
    name: str
    """As it was asked for."""
    member: Member
    own: bool
    """Whether it comes with the level, and not from a base."""
    folder: str
    """The search folder that it lies in; empty for one beside the level, where an editor keeps a project."""

    @property
    def path(self) -> str:
        """The file, for people and reports."""
        return self.member.path


_Parsed = TypeVar("_Parsed")


class Library:
    """What a run reads files from: its bases, opened once, and the contents that are kept."""

    def __init__(self, base: Sequence[str] = ()) -> None:
        """Open the bases in their order. Raises InputError when one cannot be opened."""
        self.base: tuple[Root, ...] = tuple(root for path in base for root in open_roots(path))
        self._homes: OrderedDict[str, Root] = OrderedDict()
        self._kept: OrderedDict[tuple[str, str], tuple[int, object]] = OrderedDict()
        self._bytes = 0

    def resources_of(self, member: Member) -> Resources:
        """The files as the engine finds them for a level: those beside it, then the bases."""
        home = home_of(member, Kind.LEVEL.folders[0])
        home = self._homes.setdefault(home.path, home)
        while len(self._homes) > 1 and next(iter(self._homes)) != home.path:  # levels come pack by pack
            self._homes.popitem(last=False)
        return Resources((home, *self.base), self, has_base=bool(self.base), loose=member.place is not None)

    def recall(self, path: str, what: str) -> object | None:
        """What is kept of a file."""
        kept = self._kept.get((path, what))
        if kept is None:
            return None
        self._kept.move_to_end((path, what))
        return kept[1]

    def keep(self, path: str, what: str, size: int, value: object) -> None:
        """Keep what was made of a file's bytes, and let go of what was not asked for longest."""
        self._kept[path, what] = (size, value)
        self._bytes += size
        while self._bytes > MOST_CACHED and len(self._kept) > 1:
            _, (let_go, _) = self._kept.popitem(last=False)
            self._bytes -= let_go


class Resources:
    """The files that one level can name. Names are free of case; nothing is read before it is asked for."""

    def __init__(
        self, roots: Sequence[Root] = (), library: Library | None = None, *, has_base: bool = False, loose: bool = False
    ) -> None:
        """Look in `roots`, of which the first is the level's own.

        `loose` is for a level that lies in a folder on disk: files beside it count as well, as in an editor's project.
        """
        self.roots = tuple(roots)
        self.has_base = has_base
        """Whether the game's own files can be known: without a base, a file that is not found proves nothing."""
        self._library = library or Library()
        self._loose = loose
        self._found: dict[tuple[Kind, str], Found | None] = {}

    def find(self, kind: Kind, name: str) -> Found | None:
        """The file that the engine takes for a name, or None; the default file that it may then take is not given.

        Each folder of the kind is searched in all places before the next, as the engine tries one path after another
        and each path in its packs.
        """
        key = (kind, canonical(name))
        if key not in self._found:
            self._found[key] = self._search(kind, name)
        return self._found[key]

    def default(self, kind: Kind) -> Found | None:
        """The file that stands in for a missing one of a kind."""
        return None if kind.default is None else self.find(kind, kind.default)

    def _search(self, kind: Kind, name: str) -> Found | None:
        if not name:
            return None
        for folder in kind.folders:
            for index, root in enumerate(self.roots):
                member = root.find(f"{folder}/{name}" if folder else name)
                if member is not None:
                    return Found(kind, name, member, index == 0, folder)
        member = self.roots[0].find(name) if self._loose and self.roots else None
        return None if member is None else Found(kind, name, member, True, "")

    def own_files(self, kinds: Iterable[Kind] = tuple(Kind)) -> Iterator[tuple[Kind, Member]]:
        """The files that come with the level, kind by kind, those in the engine's folders alone."""
        for kind in kinds:
            for member in self.roots[0].beneath(kind.folders) if self.roots else ():
                if member.extension == kind.extension:
                    yield kind, member

    # ---- contents

    def read(self, found: Found) -> Source:
        """The bytes of a file. Raises InputError when they cannot be had."""
        kept = self._library.recall(found.path, "source")
        if isinstance(kept, Source):
            return kept
        source = found.member.read()
        self._library.keep(found.path, "source", len(source.data), source)
        return source

    def model(self, name: str) -> Model | None:
        """A model by its name, read; None when there is no such file or its bytes cannot be had.

        What is wrong with it is in `Model.diagnostics`. The default model is not given: what the engine shows in place
        of a model says nothing about the one that the base may hold.
        """
        found = self.find(Kind.MODEL, name)
        if found is None:
            return None
        kept = self._library.recall(found.path, "model")
        if isinstance(kept, Model):
            return kept
        try:
            source = found.member.read()
        except InputError:
            return None
        model = read_model(source)
        self._library.keep(found.path, "model", len(source.data), model)
        return model

    @cached_property
    def static(self) -> Found | None:
        """The game's static.jkl, whose resources and templates every level has; None when no base holds one."""
        return self.find(Kind.LEVEL, "static.jkl")
