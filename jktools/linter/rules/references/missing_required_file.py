"""JK111: a missing file without which the engine refuses the level."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.references.missing_file import fails_the_level
from jktools.model import Level


@rule("JK111", "missing-required-file", severity=Severity.ERROR, since="0.1.0")
def missing_required_file(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a missing file without which the engine refuses the level, when a base is given.

    ## Why it matters
    A colormap or a keyframe that a level lists must be there. So must a material, a sprite or an AI class unless the
    game has the default file that stands in for it. Without a base nothing is reported.
    """
    files = level.resources
    if not files.has_base:
        return
    told = set()
    for reference in facts.file_references:
        key = (reference.kind, reference.name.lower())
        if key in told or not fails_the_level(files, reference) or files.find(*key) is not None:
            continue
        told.add(key)
        default = reference.kind.default
        yield Finding(
            Label(reference.place),
            f'{reference.kind.title} "{reference.name}" is listed, but neither the level\'s own files nor a base has it'
            + ("" if default is None else f", nor {default} to stand in for it"),
            f"put it into {reference.kind.folders[0]}, or take it off the list; the engine refuses the level",
            reference.subject,
        )
