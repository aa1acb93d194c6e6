"""JK212: an adjoin whose mirror belongs to no surface."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK212", "mirror-without-surface", severity=Severity.ERROR, since="0.1.0")
def mirror_without_surface(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface with an adjoin whose mirror no surface carries.

    ## Why it matters
    The engine takes the sector behind an adjoin from its mirror's surface. Where there is none it follows a null
    pointer and crashes while the level loads (sithWorld_Initialize in the decompiled engine).

    ## Bad
        World surfaces 12
        8: 0 0x4 0x4 4 3 1 -1 0 4 3,0 7,1 6,2 2,3 1 1 1 1

    ## Good
        World surfaces 12
        8: 0 0x0 0x4 4 3 1 1 0 4 3,0 7,1 6,2 2,3 1 1 1 1
    """
    if level.document.surfaces.broken.any():
        return  # a surface that could not be read may be the missing one
    for adjoin in level.adjoins:
        surface, mirror = adjoin.surface, adjoin.mirror
        if adjoin.broken or surface is None or not 0 <= mirror < len(level.adjoins):
            continue
        if level.adjoin_surface[mirror] < 0:
            yield Finding(
                Label(surface.field_span("adjoin"), f"adjoin {adjoin.index}"),
                f"{surface.title} has adjoin {adjoin.index}, but no surface carries its mirror {mirror}",
                f"give adjoin {mirror} to the surface on the other side, or write -1 here; the engine crashes",
                adjoin.subject,
                (Label(level.adjoins[mirror].head_span, f"adjoin {mirror}"),),
            )
