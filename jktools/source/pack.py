"""Packs, and their bytes: mapped from disk or inflated, and never many of them at once."""

from __future__ import annotations

import mmap
import threading
import weakref
from collections.abc import Callable
from pathlib import Path

from jktools.source.container import PACK_SEPARATOR, Container, Member, describe
from jktools.source.errors import InputError

MOST_MAPPED = 64
"""Packs held open at once: each map keeps a file open, and macOS allows a process 256 of them."""

MOST_KEPT = 2**28
"""Bytes of inflated packs that are kept for the next read, besides the pack used last."""

MOST_INFLATED = 2**30
"""Bytes that a file in a pack may have, together with the inflated packs around it.

More than the CD that the game came on, so no mod meets it, and less than what a machine of today has.
"""

MOST_NESTED = 4
"""Packs inside each other: a site's zip, a mod's zip, its GOB, and one to spare. A zip may contain itself."""


class PackBytes:
    """The bytes of one pack, fetched when asked for and let go when enough other packs were used since.

    So a folder of thousands of GOBs costs no more open files, and a zip of zips no more memory, than the few
    that are being read.
    """

    def __init__(
        self, path: str, fetch: Callable[[], memoryview], *, depth: int = 1, inflated: int = 0, around: int = 0
    ) -> None:
        """Take the path as shown, how to get the bytes, and how many of them that inflates.

        `depth` counts this pack and those around it; `around` is what those hold inflated.
        """
        self.path = path
        self.depth = depth
        self.inflated = inflated
        self.spent = around + inflated
        self._fetch = fetch
        self._data: memoryview | None = None
        self._length: int | None = None

    @classmethod
    def mapped(cls, path: str, file: Path) -> PackBytes:
        """Those of a file on disk. Nothing is opened yet."""
        return cls(path, lambda: _map(path, file))

    @classmethod
    def of(cls, path: str, data: bytes | memoryview) -> PackBytes:
        """Those at hand in memory."""
        return cls(path, lambda: memoryview(data))

    @property
    def room(self) -> int:
        """Bytes that may yet be inflated from within this pack."""
        return max(0, MOST_INFLATED - self.spent)

    def __call__(self) -> memoryview:
        """The bytes. Raises InputError when they cannot be had, or are no longer as long as at first."""
        data = self._data
        if data is None:
            data = self._fetch()
            if self._length not in (None, len(data)):
                raise InputError(f"cannot read {self.path}: it was changed while it was being read")
            self._length = len(data)
            self._data = data
        _RECENT.touch(self)
        return data

    def let_go(self) -> None:
        """Forget the bytes until they are asked for again; views of them stay good."""
        self._data = None


class _Recent:
    """The packs that hold their bytes, the one used last at the end."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._packs: weakref.WeakKeyDictionary[PackBytes, None] = weakref.WeakKeyDictionary()

    def touch(self, pack: PackBytes) -> None:
        """Move a pack to the end and let go of those that are too many."""
        with self._lock:
            self._packs.pop(pack, None)
            self._packs[pack] = None
            held = list(self._packs)
            inflated = sum(p.inflated for p in held)
            for oldest in held[:-1]:
                if len(self._packs) <= MOST_MAPPED and inflated <= MOST_KEPT:
                    break
                oldest.let_go()
                inflated -= oldest.inflated
                self._packs.pop(oldest, None)


_RECENT = _Recent()


class Pack(Container):
    """A container that is one file, on disk or inside another pack."""

    def __init__(self, data: PackBytes) -> None:
        """Take the pack's bytes; a format reads its directory from them."""
        self.path = data.path
        self.data = data

    def _path_of(self, name: str) -> str:
        return f"{self.path}{PACK_SEPARATOR}{name}"


def inner_bytes(outer: Container, member: Member) -> PackBytes:
    """The bytes of a pack that lies in a folder or in another pack. Raises InputError when nested too deep."""
    if member.place is not None:
        return PackBytes.mapped(member.path, member.place)
    around = outer.data if isinstance(outer, Pack) else None
    depth = around.depth + 1 if around else 1
    if depth > MOST_NESTED:
        raise InputError(
            f"cannot read {member.path}: packs are nested {depth} deep, but at most {MOST_NESTED} are read"
        )
    return PackBytes(
        member.path,
        lambda: member.read().data,
        depth=depth,
        inflated=member.size,
        around=around.spent if around else 0,
    )


def _map(path: str, file: Path) -> memoryview:
    try:
        with file.open("rb") as stream:
            if file.stat().st_size == 0:
                raise InputError(f"cannot read {path}: the file is empty")
            return memoryview(mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ))
    except OSError as error:
        raise InputError(f"cannot read {path}: {describe(error)}") from error
