"""From what a user typed to a folder, a pack or one file."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from pathlib import Path

from jktools.source.container import PACK_SEPARATOR, Container, Folder, Member, describe, file_member
from jktools.source.errors import InputError
from jktools.source.gob import MAGIC, Gob

PACK_EXTENSIONS = frozenset({"gob", "goo"})

Target = Folder | Gob | Member
"""What a path can name."""


def resolve(typed: str) -> Target:
    """Open what a path names: a folder, a pack, a file, or `pack!member`.

    Where a file's own name holds `!`, the longest prefix that exists wins. Raises InputError.
    """
    shown = typed.replace("\\", "/") if "\\" in typed and not Path(typed).exists() else typed
    for outer, inner in _splits(shown):
        path = Path(outer)
        if not path.exists():
            continue
        opened = _open(outer, path)
        if not inner:
            return opened
        return _member(opened, inner)
    raise InputError(f"cannot read {shown}: no such file or folder")


def _splits(typed: str) -> Iterator[tuple[str, str]]:
    """Every way to cut the path at a separator, longest prefix first."""
    at = len(typed)
    while at != -1:
        yield typed[:at], typed[at + 1 :]
        at = typed.rfind(PACK_SEPARATOR, 0, at)


def _open(shown: str, path: Path) -> Target:
    if path.is_dir():
        return Folder(shown, path)
    if is_pack(shown, path):
        return Gob(shown, path)
    return file_member(path, shown, path.name)


def is_pack(shown: str, path: Path) -> bool:
    """Whether a file on disk is a pack, by its extension or, failing that, its first bytes."""
    if path.suffix.lower().lstrip(".") in PACK_EXTENSIONS:
        return True
    try:
        with path.open("rb") as stream:
            return stream.read(len(MAGIC)) == MAGIC
    except OSError as error:
        raise InputError(f"cannot read {shown}: {describe(error)}") from error


def _member(opened: Target, inner: str) -> Member:
    if not isinstance(opened, Container):
        raise InputError(f"cannot read {opened.path}{PACK_SEPARATOR}{inner}: {opened.path} is not a pack")
    member = opened.find(inner)
    if member is None:
        near = difflib.get_close_matches(inner, [m.name for m in opened.members], n=1)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise InputError(f"cannot read {opened.path}{PACK_SEPARATOR}{inner}: no such file in the pack{hint}")
    return member
