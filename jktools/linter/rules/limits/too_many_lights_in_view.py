"""JK832: a frame with too many lights."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.in_view import Counted
from jktools.linter.rule import Finding, rule
from jktools.model import Level

MOST = 32
"""Lights of one frame (sithRender_Clip in the decompiled engine)."""


@rule("JK832", "too-many-lights-in-view", severity=Severity.WARNING, since="0.1.0")
def too_many_lights_in_view(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a level with a place from which a look takes in more than 32 lights; the worst that is found is named.

    ## Why it matters
    The engine takes 32 lights of things into a frame; further ones do not shine, and which ones changes with the view.
    Those that count are things with `light`, and actors and players whose field light is on (typeflag 0x4), in the
    sectors of the frame and beside them. Frames are counted as for JK830, in levels that have more than 32 in all.
    What a light does to the vertices around it, alone, is in the compiled level, whatever else shines.
    """
    full = facts.fullest_frame(Counted.LIGHTS, MOST)
    if full is not None:
        sector = level.sectors[full.sector]
        yield Finding(
            Label(sector.head_span),
            f"a look {full.place} takes in {full.held} lights, but the engine takes {MOST}",
            "let fewer things shine, or part them with walls",
            sector.subject,
        )
