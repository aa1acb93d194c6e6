"""JK223: a surface that one sees through, over an adjoin that is not visible."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.topology.translucent_solid_surface import TRANSLUCENT
from jktools.model import Adjoin, Level

VISIBLE = 0x1
"""Adjoin flag: what lies behind is drawn (sithAdjoin.h in the decompiled engine)."""

NOT_DRAWN = 0


@rule("JK223", "hidden-adjoin-behind-clear-surface", severity=Severity.WARNING, since="0.1.0")
def hidden_adjoin_behind_clear_surface(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a surface that is translucent or not drawn, with an adjoin that lacks the visible flag 0x1.

    ## Why it matters
    One looks through the surface, but the sector behind is not drawn: what the screen held before shows, a hall of
    mirrors. JED and SED warn of it too. Where both sides of an adjoin are so, that is one fault and one finding.

    ## Bad
        World adjoins 2
        0: 0x6 1 1
        World surfaces 12
        3: 0 0x0 0x4 0 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1

    ## Bad
        World adjoins 2
        0: 0x6 1 1
        World surfaces 12
        3: 0 0x0 0x6 4 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1

    ## Good
        World adjoins 2
        0: 0x6 1 1
        World surfaces 12
        3: 0 0x0 0x4 4 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1
    """
    table, adjoins = level.document.surfaces, level.document.adjoins
    translucent = table.face_flags & TRANSLUCENT != 0
    clear = (translucent | (table.geometry_mode == NOT_DRAWN)) & ~table.broken
    clear &= (table.adjoin >= 0) & (table.adjoin < len(adjoins))
    hidden = [i for i in np.flatnonzero(clear).tolist() if _is_hidden(level.adjoins[int(table.adjoin[i])])]
    behind = {i: int(level.mirror_surface[table.adjoin[i]]) for i in hidden}
    for index in hidden:
        other = behind[index]
        both = behind.get(other) == index != other
        if both and other < index:
            continue  # told with the other side
        sides = [level.surfaces[i] for i in ((index, other) if both else (index,))]
        passages = [level.adjoins[side.adjoin_index] for side in sides]
        looks = ["translucent" if translucent[side.index] else "not drawn" for side in sides]
        labels = [Label(each.field_span("flags"), f"adjoin {each.index}") for each in passages]
        labels += [Label(side.field_span("adjoin"), f"surface {side.index}") for side in sides[1:]]
        yield Finding(
            Label(sides[0].field_span("adjoin")),
            f"{_seen([side.title for side in sides], looks)}, but {_unseen(passages)}",
            f"set {_wanted(passages)}, or draw {'both surfaces' if both else 'the surface'} opaque",
            sides[0].subject,
            tuple(labels),
        )


def _is_hidden(adjoin: Adjoin) -> bool:
    return not adjoin.broken and not adjoin.flags & VISIBLE


def _seen(titles: Sequence[str], looks: Sequence[str]) -> str:
    if len(titles) > 1 and len(set(looks)) == 1:
        return f"{' and '.join(titles)} are {looks[0]}"
    return " and ".join(f"{title} is {look}" for title, look in zip(titles, looks, strict=True))


def _unseen(adjoins: Sequence[Adjoin]) -> str:
    if len(adjoins) == 1:
        return f"its adjoin {adjoins[0].index} is not visible (flags 0x{adjoins[0].flags:x})"
    named = " and ".join(f"{adjoin.index} (flags 0x{adjoin.flags:x})" for adjoin in adjoins)
    return f"their adjoins {named} are not visible"


def _wanted(adjoins: Sequence[Adjoin]) -> str:
    if len(adjoins) == 1:
        return f"flags 0x{adjoins[0].flags | VISIBLE:x} on the adjoin"
    return " and ".join(f"flags 0x{adjoin.flags | VISIBLE:x} on adjoin {adjoin.index}" for adjoin in adjoins)
