"""JK823: more colormaps than a level should have."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity, Subject
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST = {"jk": 3, "mots": 1}
"""By game, as the editors JED and SED warn."""


@rule("JK823", "too-many-colormaps", severity=Severity.WARNING, since="0.1.0")
def too_many_colormaps(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level with more colormaps than the editors allow: 3 for Jedi Knight, 1 for Mysteries of the Sith.

    ## Why it matters
    The colours of the screen come from one colormap. Sectors with others than the first show pink texels in software
    mode, and every further one costs memory.

    ## Bad
        World colormaps 4
        1: b.cmp
        2: c.cmp
        3: d.cmp

    ## Good
        World colormaps 1
    """
    table, most = level.document.lists["colormaps"], MOST[level.game]
    if len(table) > most:
        yield Finding(
            Label(level.line_span(int(table.lines[most]))),
            f"the level has {len(table)} colormaps, but {most} is the most that works well",
            "take colormaps off the list, and give their sectors another",
            Subject("colormap", most, table.names[most]),
        )
