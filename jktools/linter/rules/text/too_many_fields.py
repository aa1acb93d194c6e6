"""JK011: a line with more fields than the engine's array takes."""

from collections.abc import Iterator
from types import MappingProxyType

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST_FIELDS = MappingProxyType({"jk": 128, "mots": 256})
"""Fields of one line, by game (stdConffile_ReadArgs in the decompiled engine)."""


@rule("JK011", "too-many-fields", severity=Severity.ERROR, since="0.1.0")
def too_many_fields(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a record with more fields than the engine's array of 128 takes (256 in Mysteries of the Sith).

    ## Why it matters
    The engine does not count them: what is beyond the array overwrites memory. It mostly happens to things that move
    along many frames. Records that the engine reads with scanf (vertices, normals, sectors) have no such array.

    ## Bad
        World templates 4
        long none frame=(0) frame=(0) frame=(0) frame=(0) frame=(0) frame=(0) frame=(0) frame=(0) frame=(0) 0,0,0,0,0 \
0,0,0,0,0,0,0,0,0,0 0,0,0,0,0,0,0,0,0,0 0,0,0,0,0,0,0,0,0,0 0,0,0,0,0,0,0,0,0,0 0,0,0,0,0,0,0,0,0,0 \
0,0,0,0,0,0,0,0,0,0 0,0,0,0,0,0,0,0,0,0 0,0,0,0,0,0,0,0,0,0 0,0,0,0,0,0,0,0,0,0 0,0,0,0,0,0,0,0,0,0 \
0,0,0,0,0,0,0,0,0,0 0,0,0

    ## Good
        World templates 4
        short none type=cog frame=(0/0/0:0/0/0) frame=(0/0/1:0/0/0)
    """
    most = MOST_FIELDS[level.game]
    document = level.document
    fields_apart = 2 * most  # a field and what separates it from the next
    for table in (document.adjoins, document.surfaces, document.cogs, document.templates, document.things,
                  *document.lists.values()):  # fmt: skip
        for line in table.lines.tolist():
            text = document.lines.text(line)
            if len(text) < fields_apart or (count := len(text.replace(",", " ").split())) <= most:
                continue
            yield Finding(
                Label(level.line_span(line)),
                f"the line has {count} fields, but the engine takes at most {most}",
                "shorten the line; the engine overwrites memory",
            )
