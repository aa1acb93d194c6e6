"""Runs over many files: one that fails never loses the others' results."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fnmatch import fnmatch
from pathlib import Path, PurePosixPath

from jktools.compiler import CompileError, compile_level
from jktools.diagnostics import UNUSED_SUPPRESSION, Diagnostic, Label
from jktools.linter import Selection, lint, select
from jktools.session.levels import discover, read_level
from jktools.session.settings import Ignore, Settings
from jktools.source import InputError, Member
from jktools.source.container import PACK_SEPARATOR

Progress = Callable[[int, int, str], None]
"""Told before each file: how many are done, how many there are, and its path."""


def silent(done: int, total: int, path: str) -> None:
    """Show no progress."""


@dataclass
class Batch:
    """What a lint run found."""

    diagnostics: list[Diagnostic] = field(default_factory=list)
    """In the one order of every output."""
    files: int = 0
    """Levels read."""
    problems: list[str] = field(default_factory=list)
    """Paths that could not be read, one sentence each."""

    def joined(self, other: Batch) -> Batch:
        """This batch and another as one, in order."""
        found = sorted([*self.diagnostics, *other.diagnostics], key=lambda d: d.sort_key)
        return Batch(found, self.files + other.files, [*self.problems, *other.problems])

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self.diagnostics)

    def __len__(self) -> int:
        return len(self.diagnostics)


def check(paths: Sequence[str], settings: Settings | None = None, progress: Progress = silent) -> Batch:
    """Lint every level that the paths name.

    A path that cannot be read is told in `Batch.problems`, and the rest is linted all the same. Raises
    UnknownRuleError when the settings name a rule that does not exist.
    """
    settings = settings or Settings()
    rules = select(Selection(settings.select, settings.ignore))
    batch = Batch()
    members = _members(paths, batch.problems)
    used: set[int] = set()
    seen: list[str] = []
    for done, member in enumerate(members):
        progress(done, len(members), member.path)
        try:
            level = read_level(member, settings)
        except InputError as error:
            batch.problems.append(str(error))
            continue
        batch.files += 1
        found = lint(level, rules, options=settings.options)
        batch.diagnostics += _with_settings(found, settings, used)
        seen.append(member.path)
    batch.diagnostics += _unused(settings, used, seen, [r.code.id for r in rules])
    batch.diagnostics.sort(key=lambda d: d.sort_key)
    return batch


def _with_settings(found: Sequence[Diagnostic], settings: Settings, used: set[int]) -> list[Diagnostic]:
    """Findings without those that an `[[ignore]]` hides, with the severities that the settings give them."""
    kept = []
    for diagnostic in found:
        hiding = [i for i, entry in enumerate(settings.ignores) if _hides(entry, diagnostic)]
        used.update(hiding)
        if not hiding:
            severity = settings.severity.get(diagnostic.code.id, diagnostic.severity)
            kept.append(diagnostic if severity is diagnostic.severity else replace(diagnostic, severity=severity))
    return kept


def _hides(entry: Ignore, diagnostic: Diagnostic) -> bool:
    if entry.code != diagnostic.code.id or not _matches(entry.path, diagnostic.path):
        return False
    subject = diagnostic.subject
    if not entry.object:
        return True
    return subject is not None and entry.object.lower() in (
        f"{subject.kind} {subject.index}",
        f"{subject.kind} {subject.name}".lower(),
    )


def _matches(pattern: str, path: str) -> bool:
    """Whether a shell pattern names a path or, from a slash or `!` on, its end; case does not count."""
    path, pattern = path.lower(), pattern.lower()
    return any(fnmatch(path, lead + pattern) for lead in ("", "*/", f"*{PACK_SEPARATOR}"))


def _unused(settings: Settings, used: set[int], seen: Sequence[str], ran: Sequence[str]) -> list[Diagnostic]:
    """A finding for each `[[ignore]]` that hid nothing though its rule ran over a file that it names."""
    if UNUSED_SUPPRESSION.id not in ran:
        return []
    return [
        Diagnostic(
            UNUSED_SUPPRESSION, settings.severity.get(UNUSED_SUPPRESSION.id, UNUSED_SUPPRESSION.severity),
            Label(entry.span), f"the entry hides {entry.code}, but there is no such finding", "remove the entry",
        )
        for i, entry in enumerate(settings.ignores)
        if i not in used and entry.span and entry.code in ran and any(_matches(entry.path, path) for path in seen)
    ]  # fmt: skip


def _members(paths: Sequence[str], problems: list[str]) -> list[Member]:
    """The levels of all paths, each once."""
    members: dict[str, Member] = {}
    for path in paths:
        try:
            for member in discover(path):
                members.setdefault(member.path, member)
        except InputError as error:
            problems.append(str(error))
    return list(members.values())


@dataclass
class Built:
    """What a build run wrote."""

    written: list[tuple[str, Path, int]] = field(default_factory=list)
    """Level, file and its size in bytes."""
    skipped: list[str] = field(default_factory=list)
    """Files that are no levels, one sentence each."""
    refused: list[str] = field(default_factory=list)
    """Levels that cannot be compiled, one sentence each."""
    problems: list[str] = field(default_factory=list)
    """Paths that could not be read, one sentence each."""


def build_all(paths: Sequence[str], out: Path, settings: Settings | None = None, progress: Progress = silent) -> Built:
    """Compile every level that the paths name into files below `out`, or into `out` itself when it names a .jklb.

    Raises InputError when a file cannot be written.
    """
    settings = settings or Settings()
    built = Built()
    members = _members(paths, built.problems)
    targets = _targets(members, out)
    for done, (member, target) in enumerate(zip(members, targets, strict=True)):
        progress(done, len(members), member.path)
        try:
            level = read_level(member, settings)
        except InputError as error:
            built.problems.append(str(error))
            continue
        if level.document.sections and not level.has_geometry:
            built.skipped.append(f"{member.path}: skipped, it has no GEORESOURCE (resources and templates only)")
            continue
        try:
            data = compile_level(level)
        except CompileError as error:
            built.refused.append(str(error))
            continue
        write_atomically(target, data)
        built.written.append((member.path, target, len(data)))
    return built


COMPILED_SUFFIX = ".jklb"


def _targets(members: Sequence[Member], out: Path) -> list[Path]:
    """OUT itself for one level when it names a file; else OUT/<stem>, or OUT/<pack>/<stem> when stems clash."""
    if out.suffix.lower() == COMPILED_SUFFIX:
        if len(members) > 1:
            raise InputError(f"cannot write {len(members)} levels into {out}: name a folder")
        return [out for _ in members]
    stems = [PurePosixPath(m.name).stem.lower() for m in members]
    if len(set(stems)) == len(stems):
        return [out / f"{stem}{COMPILED_SUFFIX}" for stem in stems]
    places = [out / _pack(m) / f"{stem}{COMPILED_SUFFIX}" for m, stem in zip(members, stems, strict=True)]
    clash = next((p for i, p in enumerate(places) if p in places[:i]), None)
    if clash is not None:
        raise InputError(f"two levels would be written to {clash}: build them into two folders")
    return places


def _pack(member: Member) -> str:
    """Name of the pack or folder that holds a level."""
    container = member.path[: len(member.path) - len(member.name)].rstrip("!/")
    return PurePosixPath(container).name or "level"


def write_atomically(target: Path, data: bytes) -> None:
    """Write beside the target, flush, then rename: a crash never leaves half a file. Raises InputError."""
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}-")
        fresh = Path(name)
        try:
            with os.fdopen(handle, "wb") as stream:
                stream.write(data)
                stream.flush()
                os.fsync(stream.fileno())
            fresh.chmod(0o666 & ~_umask())
            fresh.replace(target)
        except BaseException:
            fresh.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise InputError(f"cannot write {target}: {(error.strerror or str(error)).lower()}") from error


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
