"""Verifies a compiled level: against its inputs where they are at hand, else by what follows from the file itself."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from jktools.compiler import CompiledLevel, CompileError, compile_level
from jktools.compiler.verification import by_itself, changed_inputs, first_difference
from jktools.geometry import Accuracy
from jktools.model.resources import Library
from jktools.session.comparing import game_of, settings_of
from jktools.session.levels import LEVEL_EXTENSION, discover, read_level
from jktools.session.settings import Settings
from jktools.source import InputError, Member
from jktools.source.container import canonical

FOLDER = "jkl"
"""Of levels, in a pack."""


@dataclass
class Verdict:
    """What was verified."""

    told: list[str] = field(default_factory=list)
    """A sentence for each check that was passed or could not be made."""
    fault: str | None = None
    """What is wrong, in one sentence; None for a file that passed."""
    is_stale: bool = False
    """Whether an input is another one now than the file was compiled from: that is then the fault."""
    has_source: bool = True
    """Whether the source was at hand."""


def verify(level: CompiledLevel, source: str | None = None, base: Sequence[str] = ()) -> Verdict:
    """Compile a level again with the settings that its file records, and compare: first inputs, then every section.

    The source is what `source` names, else the input's name beside the file or in a base. Without it, check what the
    file itself tells. The checksum is compared when the file is opened. Raises InputError when `source` cannot be read
    or has another level, or the file's settings are not known here.
    """
    settings = settings_of(level)
    library = Library(base)
    found = _source(level, source, library)
    if found is None:
        return _by_itself(level, settings.accuracy)
    then = level.source[1]
    now = _digest(found)
    if now != then:
        return Verdict(fault=f"its source {found.path} is SHA-256 {now}, but was {then}", is_stale=True)
    verdict = Verdict()
    try:
        again = CompiledLevel(
            compile_level(read_level(found, Settings(game_of(level), base=tuple(base)), library), settings)
        )
    except CompileError as error:
        verdict.fault = f"its source is the one that it names, but {error}"
        return verdict
    changes = changed_inputs(level, again)
    if changes:
        more = f" (and {len(changes) - 1} more)" if len(changes) > 1 else ""
        return Verdict(fault=f"its input {changes[0]}{more}", is_stale=True)
    if level.files is not None:
        count, missing = len(level.inputs), len(level.missing_inputs)
        verdict.told.append(f"its inputs are what they were: {count} files, and {missing} names that none has")
    verdict.fault = first_difference(level, again)
    if verdict.fault is None:
        verdict.told.append(f"compiled again from {found.path}: every section is as in the file")
    elif again.tool_version != level.tool_version or again.format != level.format:
        verdict.fault += f" (the file was written by jktools {level.tool_version}, format {level.format})"
    return verdict


def _by_itself(level: CompiledLevel, accuracy: Accuracy) -> Verdict:
    verdict = Verdict(has_source=False)
    verdict.told.append(f"its source {level.source[0]} is not at hand: nothing is derived again from it")
    for what, fault in by_itself(level, accuracy):
        if fault:
            verdict.fault = fault
            return verdict
        verdict.told.append(f"{what}: the file says nothing else")
    return verdict


def _source(level: CompiledLevel, source: str | None, library: Library) -> Member | None:
    """The file that the level was compiled from, else one of its name: what became of it."""
    name, digest = level.source
    members = _beside(level, library, name) if source is None else discover(source, extensions=(LEVEL_EXTENSION,))
    named = [member for member in members if _base_name(member.name) == _base_name(name)]
    found = next((member for member in members if _digest(member) == digest), next(iter(named), None))
    if found is None and source is not None:
        raise InputError(f"cannot verify {level.path} by {source}: it holds no file of SHA-256 {digest}")
    return found


def _base_name(name: str) -> str:
    return PurePosixPath(canonical(name)).name


def _beside(level: CompiledLevel, library: Library, name: str) -> list[Member]:
    """Files that have the input's name: beside the compiled file, then in the bases."""
    base_name = PurePosixPath(name).name
    if not base_name:
        return []
    found: list[Member] = []
    folder = Path(level.path).parent
    for place in dict.fromkeys((folder / name, folder / base_name)):
        if place.is_file():
            found += discover(str(place), extensions=(LEVEL_EXTENSION,))
    for root in library.base:
        members = (root.find(inside) for inside in dict.fromkeys((name, f"{FOLDER}/{base_name}", base_name)))
        found += [member for member in members if member is not None]
    return found


def _digest(member: Member) -> str:
    return hashlib.sha256(member.read().data).hexdigest()
