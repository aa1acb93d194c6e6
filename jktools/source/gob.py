"""GOB and GOO packs, mapped and never loaded whole."""

from __future__ import annotations

import mmap
import struct
from collections.abc import Iterator
from pathlib import Path

from jktools.source.container import PACK_SEPARATOR, Container, Member, describe
from jktools.source.errors import InputError

MAGIC = b"GOB "
VERSION = 20
_HEADER = struct.Struct("<4sII")
_COUNT = struct.Struct("<I")
_ENTRY = struct.Struct("<II128s")


class Gob(Container):
    """A GOB (Jedi Knight) or GOO (Mysteries of the Sith); both have one layout.

    Little-endian: `GOB `, version 20, offset of the directory; there a count and, an entry a file, offset,
    size and a name of 128 bytes padded with NUL. Opening reads the directory alone. A member that the file
    is too short for is yielded with the bytes there are; `Member.declared` tells what was claimed.
    """

    def __init__(self, path: str, file: Path) -> None:
        """Map the pack. Raises InputError when it is no GOB or its directory does not fit into the file."""
        self.path = path
        self._data = _map(path, file)
        if len(self._data) < _HEADER.size or bytes(self._data[:4]) != MAGIC:
            raise InputError(f"cannot read {path}: not a GOB pack (it does not start with 'GOB ')")
        _, version, directory = _HEADER.unpack_from(self._data)
        if version != VERSION:
            raise InputError(f"cannot read {path}: GOB version {version}, but only {VERSION} is known")
        if directory + _COUNT.size > len(self._data):
            raise InputError(
                f"cannot read {path}: the directory should be at byte {directory}, but the file ends at "
                f"{len(self._data)}; the pack is cut off, copy it again"
            )
        (self._count,) = _COUNT.unpack_from(self._data, directory)
        self._entries = directory + _COUNT.size
        room = (len(self._data) - self._entries) // _ENTRY.size
        if self._count > room:
            raise InputError(
                f"cannot read {path}: the directory claims {self._count} files, but the pack has room for "
                f"at most {room}; it is cut off or damaged, copy it again"
            )

    def _scan(self) -> Iterator[Member]:
        for index in range(self._count):
            offset, size, raw = _ENTRY.unpack_from(self._data, self._entries + index * _ENTRY.size)
            name = raw.split(b"\0", 1)[0].decode("latin-1").replace("\\", "/")
            start = min(offset, len(self._data))
            end = min(offset + size, len(self._data))
            yield Member(f"{self.path}{PACK_SEPARATOR}{name}", name, end - start, size, self._slice(start, end))

    def _slice(self, start: int, end: int) -> _Slice:
        return _Slice(self._data, start, end)


class _Slice:
    """Reads a range of the map when called; holds no copy before."""

    def __init__(self, data: memoryview, start: int, end: int) -> None:
        self._data, self._start, self._end = data, start, end

    def __call__(self) -> memoryview:
        return self._data[self._start : self._end]


def _map(path: str, file: Path) -> memoryview:
    try:
        with file.open("rb") as stream:
            if file.stat().st_size == 0:
                raise InputError(f"cannot read {path}: the file is empty")
            return memoryview(mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ))
    except OSError as error:
        raise InputError(f"cannot read {path}: {describe(error)}") from error
