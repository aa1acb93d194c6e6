"""JK720: drag that takes away more than all of the speed in a slow frame."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.engine.integration import TRAITS, Scheme, is_stable
from jktools.facts import LevelFacts
from jktools.facts.motion import bodies
from jktools.linter.rule import Finding, rule
from jktools.model import Level

SLOW_FRAME = 0.1
"""Seconds: 10 frames a second."""
SCHEME = Scheme.SEMI_IMPLICIT_EULER
"""The research document's."""


@rule("JK720", "unstable-drag", severity=Severity.WARNING, since="0.1.0")
def unstable_drag(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an actor or player with thrust whose drag is too great for the engine's step at 10 frames a second.

    ## Why it matters
    Each frame takes drag x frame time of the speed. Beyond 2 the step of the research document turns the speed round
    and makes it greater, frame by frame; the decompiled engine takes all of it at 1 and more, so that the body only
    creeps. Either way the player's frame rate decides how it moves. A body without thrust, as a turret that is to stay
    where it is, is left out.

    ## Bad
        World templates 4
        guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=2 surfdrag=25

    ## Good
        World templates 4
        guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=2 surfdrag=3
    """
    limit = TRAITS[SCHEME].stability_limit
    for held in bodies(level):
        for key in ("surfdrag", "airdrag"):
            setting = held.values.get(key)
            if setting is None or setting.origins[0].owner != held.owner or held.number("maxthrust") <= 0:
                continue
            drag = held.number(key)
            if not is_stable(SCHEME, drag, SLOW_FRAME):
                yield Finding(
                    Label(setting.origins[0].span),
                    f"{held.owner.title} has {key}={setting.text}, which takes {drag * SLOW_FRAME:.6g} times the speed "
                    f"in a frame of {SLOW_FRAME:g} s, but by the research document's step more than {limit:g} makes it "
                    "grow, and by the decompiled engine's all of it is lost",
                    f"a {key} of at most {limit / SLOW_FRAME:g} is stable at 10 frames a second; 3 is usual",
                    held.owner.subject,
                )
