"""JK110: a name that leads to no file."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.references import FileReference
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resources import Kind, Resources

FAILS = frozenset({Kind.KEYFRAME, Kind.COLORMAP})
"""Kinds without which the engine refuses a level that lists them; JK111 tells of those."""


@rule("JK110", "missing-file", severity=Severity.WARNING, since="0.1.0")
def missing_file(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a name that leads to no file, when a base is given.

    ## Why it matters
    The engine takes a default material, model, sprite or AI class in its place; a sound, puppet, sound class, script
    or cloud of particles is left out without a word. Without a base (`--base`) nothing is reported, since the file may
    be the game's; `jktools lint --stats` counts what is not found.
    """
    files = level.resources
    if not files.has_base:
        return
    told = {(r.kind, r.name.lower()) for r in facts.file_references if fails_the_level(files, r)}
    for reference in facts.file_references:
        key = (reference.kind, reference.name.lower())
        if key in told or files.find(*key) is not None:
            continue
        told.add(key)
        yield Finding(
            Label(reference.place),
            f'{reference.kind.title} "{reference.name}" is named, but neither the level\'s own files nor a base has it',
            _help(files, reference.kind),
            reference.subject,
        )


def fails_the_level(files: Resources, reference: FileReference) -> bool:
    """Whether the engine refuses a level because it lacks this file (sithMaterial, sithSprite, sithAIClass, ...)."""
    if reference.where != "list":
        return False
    if reference.kind in FAILS:
        return True
    default = reference.kind.default
    return default is not None and reference.kind is not Kind.MODEL and files.default(reference.kind) is None


def _help(files: Resources, kind: Kind) -> str:
    where = " or ".join(folder for folder in kind.folders if folder)
    effect = "leaves it out"
    if kind.default is not None and files.default(kind) is not None:
        effect = f"takes {kind.default} in its place"
    return f"put it into {where}, or mend the name; the engine {effect}"
