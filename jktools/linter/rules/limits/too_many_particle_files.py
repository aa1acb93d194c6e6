"""JK804: more particle files than the engine loads."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level, Template, Thing

MOST_FILES = 64
"""Particle files (.par) of one level (sithParticle.h in the decompiled engine)."""


@rule("JK804", "too-many-particle-files", severity=Severity.WARNING, since="0.1.0")
def too_many_particle_files(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level that names more than 64 particle files.

    ## Why it matters
    The engine loads 64 and drops the rest: things that have one of them stay invisible.
    """
    files: dict[str, Template | Thing] = {}
    owners: list[Template | Thing] = [*level.templates, *level.things]
    for owner in owners:
        for key, value in owner.parameters:
            if key.lower() == "particle":
                files.setdefault(value.lower(), owner)
    if len(files) <= MOST_FILES:
        return
    name, first = list(files.items())[MOST_FILES]
    yield Finding(
        Label(first.span),
        f"the level names {len(files)} particle files, but the engine loads {MOST_FILES}; {name} is the first without",
        "use fewer different files",
        first.subject,
    )
