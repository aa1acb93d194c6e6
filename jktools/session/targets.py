"""Where what is made of levels is written."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path, PurePosixPath

from jktools.compiler.mapping import SUFFIX
from jktools.source import InputError, Member
from jktools.source.container import PACK_SEPARATOR


def targets(members: Sequence[Member], out: Path, suffix: str = SUFFIX) -> list[Path]:
    """OUT itself for one level when it names a file; else OUT/<stem>, or OUT/<pack>/<stem> when stems clash.

    Raises InputError when OUT cannot hold them all.
    """
    if out.suffix.lower() == suffix:
        if len(members) > 1:
            raise InputError(f"cannot write {len(members)} levels into {out}: name a folder")
        return [out for _ in members]
    stems = [PurePosixPath(m.name).stem.lower() for m in members]
    if len(set(stems)) == len(stems):
        return [out / f"{stem}{suffix}" for stem in stems]
    places = [out / _folder(m) / f"{stem}{suffix}" for m, stem in zip(members, stems, strict=True)]
    if len(set(places)) < len(places):  # equal names in packs of equal names: the whole path tells them apart
        places = [out / _steps(m.path).with_suffix(suffix) for m in members]
    clash = next((p for i, p in enumerate(places) if p in places[:i]), None)
    if clash is not None:
        raise InputError(f"two levels would be written to {clash}: write them into two folders")
    return places


def _folder(member: Member) -> PurePosixPath:
    """Name of the pack that holds a level, or of the folder with the path below it."""
    container = _steps(member.path[: len(member.path) - len(member.name)])
    name = PurePosixPath(container.name)
    return name if member.place is None else name / PurePosixPath(member.name).parent


def _steps(path: str) -> PurePosixPath:
    """A path as it can lie below OUT: nothing leads up or to the root, and packs are folders."""
    parts = path.replace(PACK_SEPARATOR, "/").split("/")
    return PurePosixPath(*(part for part in parts if part not in ("", ".", "..")))
