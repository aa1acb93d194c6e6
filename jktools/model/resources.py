"""The files that a level refers to: where the engine looks for each kind, and what it takes when there is none."""

from __future__ import annotations

import enum
import hashlib
from collections import OrderedDict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from jktools.source import InputError, Member, Source
from jktools.source.container import canonical
from jktools.source.roots import Root, home_of, open_roots
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.material import Material
from jktools.syntax.assets.model import Model
from jktools.syntax.assets.reading import ASSET_EXTENSIONS, read_asset

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

    @classmethod
    def placed(cls, name: str) -> Kind | None:
        """The kind of a file of a mod by its whole name, when it lies where the engine looks for its kind."""
        folder, _, base = canonical(name).rpartition("/")
        kind = cls.of_extension(base.rpartition(".")[2])
        if kind is None or base != _ONLY.get(kind, base):
            return None
        return kind if any(not own or f"/{folder}".endswith(f"/{own}") for own in kind.folders) else None


_ONLY = {Kind.ITEMS: "items.dat", Kind.EPISODE: "episode.jk"}
"""Kinds of which the engine reads one file only."""


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


class LookedFor(NamedTuple):
    """A name that was looked for."""

    folder: str
    """Where it was found, or the first folder that is searched; empty for a file right beside the level."""
    name: str
    """As names are compared."""
    sha256: bytes | None
    """Of the file; None where there is none, or its bytes cannot be had."""

    @property
    def path(self) -> str:
        """As the game names it: `cog/door.cog`."""
        return f"{self.folder}/{self.name}" if self.folder else self.name


_FOLDERS = tuple(dict.fromkeys(folder for kind in Kind for folder in kind.folders if folder))


def _base(path: str) -> list[Root]:
    """The places of one base; a path that was mistyped would make every file a missing one."""
    roots = open_roots(path)
    if all(next(root.beneath(_FOLDERS), None) is None for root in roots):
        raise InputError(
            f"cannot use {path} as a base: it holds none of the game's folders (jkl, cog, mat, 3do, ...), nor packs "
            "with them; name the folder that the game is installed in"
        )
    return roots


def _place(kind: Kind, name: str, found: Found | None) -> tuple[str, str]:
    return (kind.folders[0] if found is None else found.folder), name


class Library:
    """What a run reads files from: its bases, opened once, and the contents that are kept."""

    def __init__(self, base: Sequence[str] = ()) -> None:
        """Open the bases in their order. Raises InputError when one cannot be opened, or holds nothing of a game."""
        self.base: tuple[Root, ...] = tuple(root for path in base for root in _base(path))
        self._homes: OrderedDict[str, Root] = OrderedDict()
        self._kept: OrderedDict[tuple[str, str], tuple[int, object]] = OrderedDict()
        self._bytes = 0

    def resources_of(self, member: Member) -> Resources:
        """The files as the engine finds them for a level, or another file of a mod: those beside it, then the bases."""
        kind = Kind.of_extension(member.extension) or Kind.LEVEL
        home = home_of(member, kind.folders)
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
        before, _ = self._kept.pop((path, what), (0, None))
        self._kept[path, what] = (size, value)
        self._bytes += size - before
        while self._bytes > MOST_CACHED and len(self._kept) > 1:
            _, (let_go, _) = self._kept.popitem(last=False)
            self._bytes -= let_go

    def digest(self, member: Member) -> bytes:
        """SHA-256 of a file. Raises InputError when its bytes cannot be had."""
        kept = self.recall(member.path, "sha256")
        if isinstance(kept, bytes):
            return kept
        digest = hashlib.sha256(self.source(member).data).digest()
        self.keep(member.path, "sha256", len(digest), digest)
        return digest

    def source(self, member: Member) -> Source:
        """The bytes of a file. Raises InputError when they cannot be had."""
        kept = self.recall(member.path, "source")
        if isinstance(kept, Source):
            return kept
        source = member.read()
        self.keep(member.path, "source", len(source.data), source)
        return source


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
        self.library = library or Library()
        """What the run keeps."""
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

    def anew(self) -> Resources:
        """The same files, of which nothing has been looked for yet."""
        return Resources(self.roots, self.library, has_base=self.has_base, loose=self._loose)

    @property
    def looked_for(self) -> list[LookedFor]:
        """All that `find` was asked for so far, each file once, by folder and name."""
        asked = {_place(kind, name, found): found for (kind, name), found in self._found.items() if name}
        return [
            LookedFor(folder, name, None if found is None else self._digest(found))
            for (folder, name), found in sorted(asked.items(), key=lambda each: each[0])
        ]

    def _digest(self, found: Found) -> bytes | None:
        try:
            return self.library.digest(found.member)
        except InputError:
            return None

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

    def in_base(self, kind: Kind, name: str) -> bool:
        """Whether a base has a file of that name, which one beside the level then replaces."""
        return any(root.find(f"{folder}/{name}") is not None for root in self.roots[1:] for folder in kind.folders)

    def own_files(self, kinds: Iterable[Kind] = tuple(Kind)) -> Iterator[tuple[Kind, Member]]:
        """The files that come with the level, kind by kind, those in the engine's folders alone."""
        for kind in kinds:
            for member in self.roots[0].beneath(kind.folders) if self.roots else ():
                if member.extension == kind.extension:
                    yield kind, member

    # ---- contents

    def read(self, found: Found) -> Source:
        """The bytes of a file. Raises InputError when they cannot be had."""
        return self.library.source(found.member)

    def asset(self, kind: Kind, name: str) -> Asset | None:
        """A file by its kind and name, read; None when there is none, its bytes cannot be had, or it is no asset.

        What is wrong with it is in `Asset.diagnostics`. The default file is not given: what the engine takes in place
        of a missing file says nothing about the one that the base may hold.
        """
        found = self.find(kind, name)
        if found is None or kind.extension not in ASSET_EXTENSIONS:
            return None
        kept = self.library.recall(found.path, "asset")
        if isinstance(kept, Asset):
            return kept
        try:
            source = found.member.read()
        except InputError:
            return None
        asset = read_asset(source, kind.extension)
        self.library.keep(found.path, "asset", len(source.data), asset)
        return asset

    def model(self, name: str) -> Model | None:
        """A model by its name; see `asset`."""
        model = self.asset(Kind.MODEL, name)
        return model if isinstance(model, Model) else None

    def material(self, name: str) -> Material | None:
        """A material by its name; see `asset`."""
        material = self.asset(Kind.MATERIAL, name)
        return material if isinstance(material, Material) else None

    @cached_property
    def static(self) -> Found | None:
        """The game's static.jkl, whose resources and templates every level has; None when no base holds one."""
        return self.find(Kind.LEVEL, "static.jkl")
