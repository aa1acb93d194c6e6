"""Which files are packs, and of which format."""

from __future__ import annotations

from jktools.source.container import Container, Member
from jktools.source.gob import MAGIC as GOB_MAGIC
from jktools.source.gob import Gob
from jktools.source.pack import PackBytes, inner_bytes
from jktools.source.zip import MAGICS as ZIP_MAGICS
from jktools.source.zip import Zip

PACK_EXTENSIONS = frozenset({"gob", "goo", "zip"})

HEAD = 4
"""Bytes that tell a format."""


def starts_as_pack(head: bytes) -> bool:
    """Whether a file's first four bytes are those of a pack, whatever its name."""
    return head == GOB_MAGIC or head in ZIP_MAGICS


def open_pack(data: PackBytes) -> Gob | Zip:
    """Open a pack by its first bytes, or by its extension where those say nothing. Raises InputError."""
    head = bytes(data()[:HEAD])
    named_zip = data.path.lower().endswith(".zip")  # one that unpacks itself starts as a program
    return Zip(data) if head in ZIP_MAGICS or (named_zip and head != GOB_MAGIC) else Gob(data)


def enter(outer: Container, member: Member) -> Gob | Zip:
    """Open a pack that lies in a folder or in another pack. Raises InputError."""
    return open_pack(inner_bytes(outer, member))
