"""Zip archives, as sites hand mods out."""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections.abc import Iterator

from jktools.source.container import Member
from jktools.source.errors import InputError
from jktools.source.pack import Pack, PackBytes

MAGICS = (b"PK\3\4", b"PK\5\6")
"""How a zip starts: with its first file, or at once with the end of its directory when it holds none."""

_METHODS = {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}
# The two that every mod uses, and the only ones that the standard library inflates in bounded steps: four
# kilobytes of bzip2 may be a hundred megabytes, and an LZMA header may ask for four gigabytes of dictionary.

_OTHER_METHODS = {1: "shrink", 6: "implode", 9: "deflate64", 12: "bzip2", 14: "LZMA", 93: "zstandard", 98: "PPMd"}

_STEP = 2**20
_ENCRYPTED = 0x1
_DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    struct.error,
    EOFError,
    ValueError,
    OSError,
    OverflowError,
    NotImplementedError,
)
"""What the standard library raises on a damaged archive, which is not `BadZipFile` alone."""


class Zip(Pack):
    """A zip archive. Opening reads the directory alone; a member is inflated when it is read.

    Names with a drive, a leading slash or `..` are listed as they are; only writing them out is refused.
    """

    def __init__(self, data: PackBytes) -> None:
        """Read the directory. Raises InputError when it is damaged."""
        super().__init__(data)
        length = len(data())
        try:
            self._archive = zipfile.ZipFile(_Stream(data))
        except _DAMAGE as error:
            raise InputError(
                f"cannot read {self.path}: not a zip archive, or it is cut off or damaged "
                f"({_reason(error)}); copy it again"
            ) from error
        claimed = sum(info.compress_size for info in self._archive.infolist())
        # Entries that share their data are how a small file claims to hold petabytes.
        if claimed > length:
            raise InputError(
                f"cannot read {self.path}: its files claim {claimed} bytes of it, but it has {length}; "
                "it is damaged, copy it again"
            )

    def _scan(self) -> Iterator[Member]:
        for info in self._archive.infolist():
            name = info.filename.replace("\\", "/")
            if info.file_size or not name.endswith("/"):  # else a folder; ZipInfo.is_dir raises on an empty name
                path = self._path_of(name)
                read = _Inflate(self, path, info)
                yield Member(path, name, info.file_size, info.file_size, read, holder=self)

    def _inflate(self, path: str, info: zipfile.ZipInfo) -> memoryview:
        self._refuse_unreadable(path, info)
        data = bytearray()
        try:
            with self._archive.open(info) as stream:
                while part := stream.read(_STEP):
                    data += part
        except _DAMAGE as error:
            raise InputError(f"cannot read {path}: it is damaged ({_reason(error)}); copy the zip again") from error
        except MemoryError as error:
            raise InputError(f"cannot read {path}: not enough memory for its {info.file_size} bytes") from error
        if len(data) != info.file_size:
            raise InputError(
                f"cannot read {path}: it should have {info.file_size} bytes, but the zip holds {len(data)}; "
                "copy the zip again"
            )
        return memoryview(data).toreadonly()

    def _refuse_unreadable(self, path: str, info: zipfile.ZipInfo) -> None:
        if info.flag_bits & _ENCRYPTED:
            raise InputError(f"cannot read {path}: it is encrypted; unpack it with its password first")
        if info.compress_type not in _METHODS:
            method = _OTHER_METHODS.get(info.compress_type, f"method {info.compress_type}")
            raise InputError(
                f"cannot read {path}: it is compressed with {method}, but only stored and deflated files are read; "
                "unpack it first"
            )
        if info.file_size > self.data.room:
            raise InputError(
                f"cannot read {path}: it claims {info.file_size} bytes, but at most {self.data.room} more are "
                "inflated from one archive at once"
            )


class _Inflate:
    """Reads one member when called; holds no copy before."""

    __slots__ = ("_info", "_path", "_zip")

    def __init__(self, archive: Zip, path: str, info: zipfile.ZipInfo) -> None:
        self._zip, self._path, self._info = archive, path, info

    def __call__(self) -> memoryview:
        return self._zip._inflate(self._path, self._info)


class _Stream(io.RawIOBase):
    """A pack's bytes as the file that zipfile wants; asks for them at each read, so that they can be let go."""

    def __init__(self, data: PackBytes) -> None:
        self._bytes = data
        self._at = 0

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def tell(self) -> int:
        return self._at

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        start = {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: len(self._bytes())}[whence]
        if start + offset < 0:
            raise OSError("an offset lies before the start")  # zipfile takes it for "no such record here"
        self._at = start + offset
        return self._at

    def read(self, size: int | None = -1) -> bytes:
        data = self._bytes()
        end = len(data) if size is None or size < 0 else min(self._at + size, len(data))
        part = bytes(data[self._at : end])
        self._at += len(part)
        return part


def _reason(error: BaseException) -> str:
    """Zipfile's word for it, on one line."""
    return " ".join(str(error).split()).rstrip(".").lower() or type(error).__name__
