"""JK208: a level without vertices, surfaces or sectors."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK208", "no-geometry", severity=Severity.ERROR, since="0.1.0")
def no_geometry(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level that has a geometry section, but no vertices, no surfaces or no sectors.

    ## Why it matters
    When the file is read, the engine checks that the level has all three, and refuses it otherwise (sithWorld_Verify
    in the decompiled engine). Sections that are missing altogether are left to missing-section.

    ## Bad
        World vertices 0
        - 0: 0 0 0
        - 1: 1 0 0
        - 2: 1 1 0
        - 3: 0 1 0
        - 4: 0 0 1
        - 5: 1 0 1
        - 6: 1 1 1
        - 7: 0 1 1
        - 8: 1 2 0
        - 9: 0 2 0
        - 10: 1 2 1
        - 11: 0 2 1

    ## Good
        World sectors 2
    """
    sections = level.document.sections
    if not level.has_geometry:
        return
    counts = {"vertices": len(level.vertices), "surfaces": len(level.surfaces)}
    if "sectors" in sections:
        counts["sectors"] = len(level.sectors)
    missing = [kind for kind, count in counts.items() if not count]
    if missing:
        yield Finding(
            Label(level.line_span(sections["georesource"])),
            f"the level has no {' and no '.join(missing)}, but the engine needs at least one of each",
            "restore the geometry; the engine refuses the level",
        )
