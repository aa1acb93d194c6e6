"""JK112: a name in another case than its file's."""

from collections.abc import Iterator
from pathlib import PurePosixPath

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK112", "name-case-differs", severity=Severity.INFO, since="0.1.0", on=False)
def name_case_differs(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a name that differs from its file's in the case of letters alone.

    ## Why it matters
    The game looks files up in lower case, so that it finds them all the same. Tools and ports on systems that tell
    cases apart may not. Real mods mix cases throughout, which is why this rule is off unless selected.
    """
    told = set()
    for reference in facts.file_references:
        found = level.resources.find(reference.kind, reference.name)
        key = (reference.kind, reference.name)
        if found is None or not found.own or key in told:
            continue
        told.add(key)
        spelt = PurePosixPath(found.member.name).name
        if spelt != PurePosixPath(reference.name.replace("\\", "/")).name:
            yield Finding(
                Label(reference.place),
                f'{reference.kind.title} "{reference.name}" is named, but its file is spelt "{spelt}"',
                "spell the two alike",
                reference.subject,
            )
