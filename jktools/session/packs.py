"""Packs listed, unpacked and made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path, PurePosixPath

from jktools.session.progress import Progress, silent
from jktools.session.write import write_atomically, write_parts
from jktools.source import Container, Folder, InputError, Member, resolve
from jktools.source.container import canonical
from jktools.source.filenames import fault_of
from jktools.source.gob_writer import gob_parts


def open_container(typed: str) -> Container:
    """Open a pack or a folder. Raises InputError when the path names neither."""
    target = resolve(typed)
    if isinstance(target, Member):
        raise InputError(f"cannot read {target.path}: expected a GOB, GOO, zip or folder, but it is none")
    return target


@dataclass
class Extracted:
    """What was unpacked."""

    written: list[tuple[str, Path, int]] = field(default_factory=list)
    """File in the pack, file on disk and its size in bytes."""
    problems: list[str] = field(default_factory=list)
    """Files that were refused or could not be read, one sentence each."""


def extract(typed: str, folder: Path, patterns: Sequence[str] = (), progress: Progress = silent) -> Extracted:
    """Write the files of a pack below a folder, those that a pattern matches (`jkl/*`, any case) or all.

    A file already there is replaced. A name that would lead out of the folder, that some system cannot hold, or that
    on some system would overwrite another file of the pack is told in `problems` and not written; so is a file whose
    bytes are not all there. Raises InputError when the pack cannot be opened, a pattern matches nothing, or the
    folder cannot be written.
    """
    members = _matching(open_container(typed), patterns)
    done = Extracted()
    taken = _Taken()
    for index, member in enumerate(members):
        progress(index, len(members), member.path)
        target = folder / member.name
        fault = fault_of(member.name) or taken.fault_of(member.name) or _link_fault(folder, target)
        if fault:
            done.problems.append(f"cannot extract {member.path}: {fault}")
            continue
        _write(member, target, done)
    return done


def _matching(container: Container, patterns: Sequence[str]) -> Sequence[Member]:
    wanted: set[int] = set()
    for pattern in patterns:
        name = canonical(pattern)
        exact = {i for i, m in enumerate(container.members) if canonical(m.name) == name}
        matched = exact or {i for i, m in enumerate(container.members) if fnmatchcase(canonical(m.name), name)}
        if not matched:
            raise InputError(f"cannot extract from {container.path}: no file in it matches {pattern}")
        wanted |= matched
    return [container.members[i] for i in sorted(wanted)] if patterns else container.members


class _Taken:
    """The names written so far, as a system that ignores case sees them."""

    def __init__(self) -> None:
        self._files: dict[str, str] = {}
        self._folders: dict[str, str] = {}

    def fault_of(self, name: str) -> str | None:
        """Why a name cannot be written beside those before it, or None; it then counts as written."""
        key = canonical(name)
        folders = [parent.as_posix() for parent in PurePosixPath(key).parents][:-1]
        other = self._files.get(key) or self._folders.get(key)
        other = other or next((self._files[f] for f in folders if f in self._files), None)
        if other is not None:
            return f"where names ignore case it takes the place of {other}"
        self._files[key] = name
        self._folders.update(dict.fromkeys(folders, name))
        return None


def _link_fault(folder: Path, target: Path) -> str | None:
    """Refuse to write through a link that leads out of the folder."""
    if target.parent.resolve().is_relative_to(folder.resolve()):
        return None
    return f"{target.parent} is a link that leads out of {folder}"


def _write(member: Member, target: Path, done: Extracted) -> None:
    try:
        data = member.read().data
    except InputError as error:
        done.problems.append(str(error))
        return
    if len(data) != member.declared:
        done.problems.append(
            f"cannot extract {member.path}: the pack is cut off, {len(data)} of {member.declared} bytes are there"
        )
        return
    write_atomically(target, data, durable=False)  # what is lost can be extracted again
    done.written.append((member.path, target, len(data)))


def create(out: Path, typed: str) -> tuple[int, int]:
    """Write a GOB with the files of a folder or a pack, and give their number and its size in bytes.

    The same files give the same bytes; what is in the folder under the GOB's own path is left out. Raises InputError.
    """
    if out.suffix.lower() == ".zip":
        raise InputError(f"cannot write {out}: it would be a GOB, but is named as a zip")
    container = open_container(typed)
    if isinstance(container, Folder):
        container = _Without(container, out)
    return len(container.members), write_parts(out, gob_parts(container))


class _Without(Container):
    """A folder without one file: the pack that is about to be made in it."""

    def __init__(self, folder: Folder, left_out: Path) -> None:
        self.path = folder.path
        there = left_out.exists()
        self.members = tuple(m for m in folder.members if not (there and m.place and m.place.samefile(left_out)))
