"""Packs for tests, written and read apart from the code under test."""

from __future__ import annotations

import io
import struct
import warnings
import zipfile
from collections.abc import Sequence
from pathlib import Path

from jktools.source import Member, Pack, PackBytes, open_pack
from tests.support.levels import CORPUS

GOBS = sorted((CORPUS / "gob").glob("*")) if CORPUS.exists() else []


def zip_of(files: Sequence[tuple[str, bytes]], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    """A zip archive."""
    stream = io.BytesIO()
    with warnings.catch_warnings(), zipfile.ZipFile(stream, "w", method) as archive:
        warnings.simplefilter("ignore")  # of equal names, which tests want
        for name, data in files:
            archive.writestr(zipfile.ZipInfo(name), data, method)
    return stream.getvalue()


def gob_files(data: bytes) -> list[tuple[str, bytes]]:
    """Names as stored and bytes of a GOB whose directory follows its header."""
    (count,) = struct.unpack_from("<I", data, 12)
    entries = [struct.unpack_from("<II128s", data, 16 + 136 * i) for i in range(count)]
    return [(raw.split(b"\0")[0].decode("latin-1"), data[at : at + size]) for at, size, raw in entries]


def pack_of(data: bytes, path: str = "p.zip") -> Pack:
    """A pack in memory."""
    return open_pack(PackBytes.of(path, data))


def contents(pack: Pack) -> list[tuple[str, bytes]]:
    """Every name with its bytes."""
    return [(m.name, bytes(m.read().data)) for m in pack.members]


def member_of(pack: Pack, name: str) -> Member:
    """The file of a name that is there."""
    found = pack.find(name)
    assert found is not None
    return found


def write(path: Path, data: bytes) -> Path:
    """A file with what is above it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
    return path
