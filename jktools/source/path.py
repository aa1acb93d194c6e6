"""From what a user typed to a folder, a pack or one file."""

from __future__ import annotations

import difflib
import errno
from collections.abc import Iterator
from pathlib import Path

from jktools.source.container import PACK_SEPARATOR, Container, Folder, Member, describe, file_member
from jktools.source.errors import InputError
from jktools.source.formats import HEAD, PACK_EXTENSIONS, enter, open_pack, starts_as_pack
from jktools.source.pack import Pack, PackBytes

Target = Folder | Pack | Member
"""What a path can name."""


def resolve(typed: str) -> Target:
    """Open what a path names: a folder, a pack, a file, `pack!member`, or `pack!inner pack!member` to any depth.

    Where a name itself holds `!`, the longest prefix that exists wins, on disk and in each pack. A file on disk is a
    pack by its extension or its first bytes, one in a pack by its extension, or because more follows. Raises
    InputError.
    """
    if not typed:
        raise InputError("cannot read an empty path")
    shown = typed.replace("\\", "/") if "\\" in typed and not _exists(Path(typed)) else typed
    for outer, inner in _splits(shown):
        path = Path(outer)
        if _exists(path):
            return _descend(_open(outer, path), inner)
    raise InputError(f"cannot read {shown}: no such file or folder")


def on_disk(typed: str) -> Path:
    """The part of a path that is on disk: the longest prefix that exists, or all of it when none does."""
    return Path(split_on_disk(typed)[0])


def split_on_disk(typed: str) -> tuple[str, str]:
    """The part of a path that is on disk, as in `on_disk`, and what follows: nothing, or the separator and names."""
    outer = next((outer for outer, _ in _splits(typed) if outer and _exists(Path(outer))), typed)
    return outer, typed[len(outer) :]


def _splits(typed: str) -> Iterator[tuple[str, str]]:
    """Every way to cut the path at a separator, longest prefix first."""
    at = len(typed)
    while at != -1:
        yield typed[:at], typed[at + 1 :]
        at = typed.rfind(PACK_SEPARATOR, 0, at)


def _exists(path: Path) -> bool:
    try:
        return path.exists()
    except OSError as error:
        if error.errno == errno.ENAMETOOLONG:  # not on this disk, but the start of it may name a pack
            return False
        raise InputError(f"cannot read {path}: {describe(error)}") from error


def _open(shown: str, path: Path) -> Target:
    if path.is_dir():
        return Folder(shown, path)
    if not path.is_file():
        raise InputError(f"cannot read {shown}: it is neither a file nor a folder")
    if is_pack(shown, path):
        return open_pack(PackBytes.mapped(shown, path))
    return file_member(path, shown, path.name)


def is_pack(shown: str, path: Path) -> bool:
    """Whether a file on disk is a pack, by its extension or, failing that, its first bytes."""
    if path.suffix.lower().lstrip(".") in PACK_EXTENSIONS:
        return True
    try:
        with path.open("rb") as stream:
            return starts_as_pack(stream.read(HEAD))
    except OSError as error:
        raise InputError(f"cannot read {shown}: {describe(error)}") from error


def _descend(opened: Target, inner: str) -> Target:
    """Follow the names after the separators, each in the pack that the one before it named."""
    while inner:
        if not isinstance(opened, Container):
            raise InputError(f"cannot read {opened.path}{PACK_SEPARATOR}{inner}: {opened.path} is not a pack")
        member, inner = _find(opened, inner)
        opened = enter(opened, member) if inner or member.extension in PACK_EXTENSIONS else member
    return opened


def _find(container: Container, inner: str) -> tuple[Member, str]:
    """The member with the longest name that the rest of a path starts with, and what then is left of it."""
    for name, rest in _splits(inner):
        member = container.find(name)
        if member is not None:
            return member, rest
    wanted = inner.partition(PACK_SEPARATOR)[0]
    near = difflib.get_close_matches(wanted, [m.name for m in container.members], n=1)
    hint = f"; did you mean {near[0]}?" if near else ""
    kind = "pack" if isinstance(container, Pack) else "folder"
    raise InputError(f"cannot read {container.path}{PACK_SEPARATOR}{inner}: no such file in the {kind}{hint}")
