"""Where the game looks for its files: folders and packs, each listed no further than it is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath

from jktools.source.container import PACK_SEPARATOR, Container, Folder, Member, canonical, displayed, file_member
from jktools.source.errors import InputError
from jktools.source.formats import PACK_EXTENSIONS, enter, open_pack
from jktools.source.pack import Pack, PackBytes
from jktools.source.path import resolve

GAME_FOLDERS = ("", "resource", "episode")
"""Below the game's own folder, where its packs lie."""


class Root:
    """One place with files in the engine's folders (`mat`, `3do/mat`, ...); names are free of case and slash."""

    path: str
    """For people and reports."""

    def find(self, name: str) -> Member | None:
        """The file of that name, as `3do/ky.3do`, or None."""
        raise NotImplementedError

    def beneath(self, folders: Sequence[str]) -> Iterator[Member]:
        """Every file that lies directly in one of these folders, in the place's own order."""
        raise NotImplementedError


class PackRoot(Root):
    """A pack, or a folder inside one."""

    def __init__(self, pack: Container, prefix: str = "") -> None:
        """Look in `pack` below `prefix`, which is empty or ends with a slash."""
        self.pack = pack
        self.path = pack.path if not prefix else f"{pack.path}{PACK_SEPARATOR}{prefix.rstrip('/')}"
        self._prefix = prefix

    def find(self, name: str) -> Member | None:
        """See `Root`."""
        return self.pack.find(self._prefix + name)

    def beneath(self, folders: Sequence[str]) -> Iterator[Member]:
        """See `Root`."""
        wanted = {canonical(self._prefix + folder) for folder in folders}
        for member in self.pack.members:
            if canonical(member.name).rpartition("/")[0] in wanted:
                yield member


class FolderRoot(Root):
    """A folder on disk. Only the folders that are asked for are listed, each once."""

    def __init__(self, path: str, folder: Path) -> None:
        """Take the folder as typed and where it is."""
        self.path = path
        self._folder = folder
        self._listed: dict[str, dict[str, Path]] = {}

    def find(self, name: str) -> Member | None:
        """See `Root`. Of names that differ in case alone the first by code point is meant."""
        folder, _, base = canonical(name).rpartition("/")
        found = self._entries(folder).get(base)
        return self._member(found) if found is not None and found.is_file() else None

    def beneath(self, folders: Sequence[str]) -> Iterator[Member]:
        """See `Root`."""
        for folder in folders:
            for entry in self._entries(canonical(folder)).values():
                if entry.is_file():
                    yield self._member(entry)

    def _member(self, path: Path) -> Member:
        name = path.relative_to(self._folder).as_posix()
        return file_member(path, str(PurePosixPath(self.path) / name), name)

    def _entries(self, folder: str) -> dict[str, Path]:
        """What lies in a folder below this one, by lower-case name; nothing where it cannot be read."""
        if folder not in self._listed:
            above, _, own = folder.rpartition("/")
            place = self._entries(above).get(own) if folder else self._folder
            entries: dict[str, Path] = {}
            try:
                for entry in sorted(place.iterdir()) if place is not None and place.is_dir() else ():
                    entries.setdefault(displayed(entry.name).lower(), entry)
            except OSError:
                entries = {}
            self._listed[folder] = entries
        return self._listed[folder]


def home_of(member: Member, folders: Sequence[str]) -> Root:
    """The place that a file was taken from: what its name stands below once one of `folders` (as `jkl`) is taken off.

    A level `mod/jkl/x.jkl` belongs to `mod`; one that lies in no such folder belongs to the folder it lies in.
    """
    if member.place is None and member.holder is not None:
        above = PurePosixPath(member.name).parent
        above = _up(above, _depth(above, folders))
        return PackRoot(member.holder, "" if above == PurePosixPath(".") else f"{above.as_posix()}/")
    on_disk = Path(member.path if member.place is None else member.place).absolute().parent
    depth = _depth(PurePosixPath(on_disk.as_posix()), folders)
    shown = PurePosixPath(member.path).parent
    own = min(depth, len(shown.parts))
    return FolderRoot(
        "/".join([".."] * (depth - own)) or _up(shown, own).as_posix(), on_disk.parents[depth - 1] if depth else on_disk
    )


def _depth(place: PurePosixPath, folders: Sequence[str]) -> int:
    """How many steps up lead out of the longest of some folders, when a place is one of them."""
    parts = tuple(part.lower() for part in place.parts)
    return max(
        (n for f in folders if (n := len(PurePosixPath(f).parts)) and parts[-n:] == PurePosixPath(f).parts), default=0
    )


def _up(place: PurePosixPath, steps: int) -> PurePosixPath:
    return place.parents[steps - 1] if steps else place


def open_roots(typed: str) -> list[Root]:
    """The places that a user names as the game's own: a pack; a zip with the packs in it; or a folder.

    A folder stands for its files and for the packs in it and in its `resource` and `episode`, as the game is
    installed; files come before packs, and packs in the order of their names. Raises InputError when the path is none
    of these, or a pack in it cannot be opened.
    """
    target = resolve(typed)
    if isinstance(target, Member):
        raise InputError(f"cannot use {target.path} as a base: expected a folder or a GOB, GOO or zip, but it is none")
    if isinstance(target, Folder):
        folder = FolderRoot(target.path, target.root)
        packs = (m for m in folder.beneath(GAME_FOLDERS) if m.extension in PACK_EXTENSIONS)
        return [folder, *(PackRoot(open_pack(PackBytes.mapped(m.path, m.place))) for m in packs if m.place)]
    inner = (m for m in target.members if m.extension in PACK_EXTENSIONS) if isinstance(target, Pack) else ()
    return [PackRoot(target), *(PackRoot(enter(target, m)) for m in inner)]
