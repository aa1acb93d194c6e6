"""Folders and packs through one interface."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from jktools.source.errors import InputError
from jktools.source.text import Source

PACK_SEPARATOR = "!"
"""Between a pack and the name inside it: `masspack.gob!jkl/lagoon.jkl`."""


def canonical(name: str) -> str:
    """The form in which names are compared: lower case, with slashes, as the engine looks files up."""
    return name.replace("\\", "/").strip("/").lower()


@dataclass(frozen=True, slots=True)
class Member:
    """One file of a container, not yet read."""

    path: str
    """For people and reports: the container as typed, the separator, the name as the container spells it."""
    name: str
    """Inside the container, with slashes."""
    size: int
    """Bytes that `read` yields; fewer than `declared` where the container is cut off."""
    declared: int
    """Bytes that the container's directory claims."""
    _read: Callable[[], bytes | memoryview]
    place: Path | None = None
    """Where it lies on disk, unless it is in a pack."""
    stored: bytes | None = None
    """The name as a GOB's directory stores it, with what its padding holds; None elsewhere."""
    holder: Container | None = field(default=None, compare=False, repr=False)
    """The pack that it lies in; None for a file on disk."""

    def read(self) -> Source:
        """Read the file. Raises InputError when it cannot be opened, or a zip holds it damaged."""
        return Source(self.path, self._read(), self.name, self.declared)

    @property
    def extension(self) -> str:
        """What follows the last dot of the name, in lower case, without the dot."""
        return self.name.rpartition(".")[2].lower() if "." in self.name else ""


class Container:
    """A set of named files: a folder or a pack. Names are compared as the engine does: case and slash free."""

    path: str
    """As users wrote it, with slashes."""

    def _scan(self) -> Iterator[Member]:
        raise NotImplementedError

    @cached_property
    def members(self) -> tuple[Member, ...]:
        """Every file, in the container's own order (folders: sorted by name)."""
        return tuple(self._scan())

    @cached_property
    def _by_name(self) -> dict[str, Member]:
        index: dict[str, Member] = {}
        for member in self.members:
            index.setdefault(canonical(member.name), member)
        return index

    def find(self, name: str) -> Member | None:
        """The file of that name, or None. Where a container holds a name twice the first is meant."""
        return self._by_name.get(canonical(name))


def read_file(path: Path, shown: str) -> bytes:
    """All bytes of a file on disk. Raises InputError."""
    try:
        return path.read_bytes()
    except OSError as error:
        raise InputError(f"cannot read {shown}: {describe(error)}") from error


def describe(error: OSError) -> str:
    """An operating system error in one lower-case phrase."""
    return (error.strerror or str(error)).lower()


def describe_bytes(error: UnicodeDecodeError) -> str:
    """What keeps bytes from being UTF-8, in one phrase."""
    return f"it is no text in UTF-8, its byte {error.start} is {error.object[error.start]:#04x}"


def displayed(path: str) -> str:
    """A path that can be shown and written: bytes that are no UTF-8 as escapes."""
    return path.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def file_member(path: Path, shown: str, name: str) -> Member:
    """A file on disk as a member. Raises InputError when it is not there."""
    try:
        size = path.stat().st_size
    except OSError as error:
        raise InputError(f"cannot read {shown}: {describe(error)}") from error
    shown, name = displayed(shown), displayed(name)
    return Member(shown, name, size, size, lambda: read_file(path, shown), path)


class Folder(Container):
    """A folder on disk with everything below it; links to folders are not followed."""

    def __init__(self, path: str, root: Path) -> None:
        """Take the folder as typed and where it is."""
        self.path = path.rstrip("/") or "/"
        self.root = root

    def _scan(self) -> Iterator[Member]:
        prefix = "" if self.path == "." else self.path.rstrip("/") + "/"
        for path in sorted(self._files(self.root)):
            name = path.relative_to(self.root).as_posix()
            yield file_member(path, prefix + name, name)

    def _files(self, folder: Path) -> Iterator[Path]:
        pending = [folder]
        while pending:
            try:
                entries = list(pending.pop().iterdir())
            except OSError as error:
                raise InputError(f"cannot read {self.path}: {describe(error)}") from error
            for entry in entries:
                if entry.is_dir():
                    if not entry.is_symlink():
                        pending.append(entry)
                elif entry.is_file():
                    yield entry
