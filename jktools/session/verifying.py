"""Verifies a compiled level: against its source where that is at hand, else by what follows from the file itself."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from jktools.compiler import CompiledLevel, CompileError, compile_level
from jktools.compiler.verification import by_itself, first_difference
from jktools.model.resources import Library
from jktools.session.comparing import game_of, settings_of
from jktools.session.levels import LEVEL_EXTENSION, discover, read_level
from jktools.session.settings import Settings
from jktools.source import InputError, Member

FOLDER = "jkl"
"""Of levels, in a pack."""


@dataclass
class Verdict:
    """What was verified."""

    told: list[str] = field(default_factory=list)
    """A sentence for each check that was passed or could not be made."""
    fault: str | None = None
    """What is wrong, in one sentence; None for a file that passed."""


def verify(level: CompiledLevel, source: str | None = None, base: Sequence[str] = ()) -> Verdict:
    """Compile a level again with the settings that its file records, and compare the two section by section.

    The source is what `source` names, else the input's name beside the file or in a base. Without it, check what the
    file itself tells. The checksum is compared when the file is opened. Raises InputError when `source` cannot be read
    or has another level, or the file's settings are not known here.
    """
    verdict = Verdict()
    settings = settings_of(level)
    library = Library(base)
    name, digest = level.inputs[0] if level.inputs else ("", "")
    found = _source(level, source, library, name, digest)
    if found is None:
        told = f"its source {name} is not at hand (--source PATH): nothing is derived again from it"
        verdict.told.append(told)
        for what, fault in by_itself(level, settings.accuracy):
            if fault:
                verdict.fault = fault
                return verdict
            verdict.told.append(f"{what}: the file says nothing else")
        return verdict
    try:
        again = CompiledLevel(
            compile_level(read_level(found, Settings(game_of(level), base=tuple(base)), library), settings)
        )
    except CompileError as error:
        verdict.fault = f"its source is the one that it names, but {error}"
        return verdict
    verdict.fault = first_difference(level, again)
    if verdict.fault is None:
        verdict.told.append(f"compiled again from {found.path}: every section is as in the file")
    elif again.tool_version != level.tool_version or again.format != level.format:
        verdict.fault += f" (the file was written by jktools {level.tool_version}, format {level.format})"
    return verdict


def _source(level: CompiledLevel, source: str | None, library: Library, name: str, digest: str) -> Member | None:
    """The file that the level was compiled from."""
    if source is not None:
        members = discover(source, extensions=(LEVEL_EXTENSION,))
        found = next((member for member in members if _digest(member) == digest), None)
        if found is None:
            raise InputError(f"cannot verify {level.path} by {source}: it holds no file of SHA-256 {digest}")
        return found
    return next((member for member in _beside(level, library, name) if _digest(member) == digest), None)


def _beside(level: CompiledLevel, library: Library, name: str) -> Iterator[Member]:
    """Files that have the input's name: beside the compiled file, then in the bases."""
    base_name = PurePosixPath(name).name
    folder = Path(level.path).parent
    for place in dict.fromkeys((folder / name, folder / base_name)):
        if base_name and place.is_file():
            yield from discover(str(place), extensions=(LEVEL_EXTENSION,))
    for root in library.base:
        for inside in dict.fromkeys((name, f"{FOLDER}/{base_name}", base_name)):
            member = root.find(inside) if base_name else None
            if member is not None:
                yield member


def _digest(member: Member) -> str:
    return hashlib.sha256(member.read().data).hexdigest()
