"""GOB packs, written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from jktools.source.container import Container, Member, canonical
from jktools.source.errors import InputError
from jktools.source.gob import COUNT, ENTRY, HEADER, MAGIC, NAME_SIZE, VERSION, Gob

_MOST_BYTES = 2**32 - 1
"""Offsets and sizes have 32 bits."""


def gob_parts(container: Container) -> Iterator[bytes | memoryview]:
    """Yield a GOB of a container's files, piece by piece; one file is in memory at a time.

    The directory follows the header, then the data in the directory's order without gaps, as in every known pack.
    A GOB keeps its order and its name fields to the byte, so one of that layout comes out as it went in; the files of
    folders and zips are sorted by canonical name. Raises InputError naming the file that a GOB cannot hold.
    """
    members = _ordered(container)
    fields = [_name_field(member) for member in members]
    offset = HEADER.size + COUNT.size + len(members) * ENTRY.size
    total = offset + sum(member.declared for member in members)
    if total > _MOST_BYTES:
        raise InputError(
            f"cannot pack {container.path}: it would have {total} bytes, but a GOB has at most {_MOST_BYTES}"
        )
    yield HEADER.pack(MAGIC, VERSION, HEADER.size) + COUNT.pack(len(members))
    for member, field in zip(members, fields, strict=True):
        yield ENTRY.pack(offset, member.declared, field)
        offset += member.declared
    for member in members:
        yield _whole(member)


def _ordered(container: Container) -> Sequence[Member]:
    if isinstance(container, Gob):
        return container.members
    members = sorted(container.members, key=lambda m: (canonical(m.name), m.name))
    for first, second in pairwise(members):
        if canonical(first.name) == canonical(second.name):
            raise InputError(
                f"cannot pack {container.path}: {first.name} and {second.name} are one name to the game; rename one"
            )
    return members


def _name_field(member: Member) -> bytes:
    """A name as the directory stores it: Latin-1, backslashes, padded with NUL."""
    if member.stored is not None:
        return member.stored
    if "\\" in member.name:
        raise InputError(f"cannot pack {member.path}: its name has a backslash, which a GOB takes for a folder")
    try:
        name = member.name.replace("/", "\\").encode("latin-1")
    except UnicodeEncodeError as error:
        odd = member.name[error.start]
        raise InputError(f"cannot pack {member.path}: its name has {odd!r}, but a GOB knows Latin-1 only") from error
    if len(name) >= NAME_SIZE:
        raise InputError(
            f"cannot pack {member.path}: its name would have {len(name)} bytes, but a GOB has room for {NAME_SIZE - 1}"
        )
    return name


def _whole(member: Member) -> memoryview:
    """All that the directory will claim of a file, or an error: a pack must not hold half of one."""
    data = member.read().data
    if len(data) != member.declared:
        raise InputError(
            f"cannot pack {member.path}: it should have {member.declared} bytes, but {len(data)} could be read"
        )
    return data
