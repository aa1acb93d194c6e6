"""The files that several paths name, each once."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from jktools.session.levels import LEVELS, discover
from jktools.source import InputError, Member
from jktools.source.container import PACK_SEPARATOR


def members_of(paths: Sequence[str], problems: list[str], extensions: Collection[str] = LEVELS) -> list[Member]:
    """The levels, or what else has one of the extensions, of all paths, each once."""
    members: dict[str, Member] = {}
    for path in paths:
        try:
            for member in discover(path, problems, extensions):
                members.setdefault(identity_of(member), member)
        except InputError as error:
            problems.append(str(error))
    return list(members.values())


def identity_of(member: Member) -> str:
    """One name for a file, however the paths to it were typed."""
    outer, separator, inner = member.path.partition(PACK_SEPARATOR)
    return str(member.place.resolve()) if member.place else f"{Path(outer).resolve()}{separator}{inner}"
