"""GOB and GOO packs, mapped and never loaded whole."""

from __future__ import annotations

import struct
from collections.abc import Iterator

from jktools.source.container import Member
from jktools.source.errors import InputError
from jktools.source.pack import Pack, PackBytes

MAGIC = b"GOB "
VERSION = 20
HEADER = struct.Struct("<4sII")
COUNT = struct.Struct("<I")
NAME_SIZE = 128
ENTRY = struct.Struct(f"<II{NAME_SIZE}s")


class Gob(Pack):
    """A GOB (Jedi Knight) or GOO (Mysteries of the Sith); both have one layout.

    Little-endian: `GOB `, version 20, offset of the directory; there a count and, an entry a file, offset,
    size and a name of 128 bytes padded with NUL. Opening reads the directory alone. A member that the file
    is too short for is yielded with the bytes there are; `Member.declared` tells what was claimed.
    """

    def __init__(self, data: PackBytes) -> None:
        """Read where the directory is. Raises InputError when this is no GOB or the directory does not fit into it."""
        super().__init__(data)
        path, view = self.path, data()
        if len(view) < HEADER.size or bytes(view[:4]) != MAGIC:
            raise InputError(f"cannot read {path}: not a GOB pack (it does not start with 'GOB ')")
        _, version, directory = HEADER.unpack_from(view)
        if version != VERSION:
            raise InputError(f"cannot read {path}: GOB version {version}, but only {VERSION} is known")
        if directory + COUNT.size > len(view):
            raise InputError(
                f"cannot read {path}: the directory should be at byte {directory}, but the file ends at "
                f"{len(view)}; the pack is cut off, copy it again"
            )
        (self._count,) = COUNT.unpack_from(view, directory)
        self._entries = directory + COUNT.size
        room = (len(view) - self._entries) // ENTRY.size
        if self._count > room:
            raise InputError(
                f"cannot read {path}: the directory claims {self._count} files, but the pack has room for "
                f"at most {room}; it is cut off or damaged, copy it again"
            )

    def _scan(self) -> Iterator[Member]:
        view = self.data()
        for index in range(self._count):
            offset, size, field = ENTRY.unpack_from(view, self._entries + index * ENTRY.size)
            name = field.split(b"\0", 1)[0].decode("latin-1").replace("\\", "/")
            start = min(offset, len(view))
            end = min(offset + size, len(view))
            read = _Slice(self.data, start, end)
            yield Member(self._path_of(name), name, end - start, size, read, stored=field, holder=self)


class _Slice:
    """Copies a range of the pack when called; holds nothing before.

    A view would keep the map, and so the pack's file, open for as long as a finding in it is kept.
    """

    __slots__ = ("_data", "_end", "_start")

    def __init__(self, data: PackBytes, start: int, end: int) -> None:
        self._data, self._start, self._end = data, start, end

    def __call__(self) -> bytes:
        return bytes(self._data()[self._start : self._end])
