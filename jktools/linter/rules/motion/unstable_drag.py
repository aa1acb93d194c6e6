"""JK720: drag that takes away more than all of the speed in a slow frame."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.engine.drag import UNDERWATER_DRAG_FACTOR
from jktools.engine.flags import SectorFlag
from jktools.engine.integration import TRAITS, Scheme, is_stable
from jktools.facts import LevelFacts
from jktools.facts.motion import is_body
from jktools.facts.own_line import own_origin, templates_and_things
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resolved import Resolved

SLOW_FRAME = 0.1
"""Seconds: 10 frames a second."""
SCHEME = Scheme.SEMI_IMPLICIT_EULER
"""The research document's."""


@rule("JK720", "unstable-drag", severity=Severity.WARNING, since="0.1.0")
def unstable_drag(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an actor or player with thrust whose drag is too great for the engine's step at 10 frames a second.

    ## Why it matters
    Each frame takes drag x frame time of the speed: on a floor `surfdrag`, in the air `airdrag`, under water four times
    `airdrag`, which counts where the level has water. Beyond 2 the step of the research document turns the speed round
    and makes it greater, frame by frame; the decompiled engine takes all of it at 1 and more, so that the body only
    creeps. Either way the player's frame rate decides how it moves. A body without thrust, as a turret that is to stay
    where it is, is left out. The engine does not take a negative drag, which is JK412.

    ## Bad
        World templates 4
        guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=2 surfdrag=25

    ## Good
        World templates 4
        guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=2 surfdrag=3
    """
    limit = TRAITS[SCHEME].stability_limit
    water = bool((level.document.sectors.flags & SectorFlag.UNDERWATER).any())
    for held in templates_and_things(level):
        for key in ("surfdrag", "airdrag"):
            factor = UNDERWATER_DRAG_FACTOR if water and key == "airdrag" else 1.0
            place = own_origin(held, key, "maxthrust", "type", "move")
            if place is None or not _is_at_fault(held, key, factor):
                continue
            if own_origin(held, key) is None and held.parent is not None and _is_at_fault(held.parent, key, factor):
                continue
            lost = held.number(key) * factor * SLOW_FRAME
            where = " under water" if factor > 1 else ""
            yield Finding(
                Label(place.span),
                f"{held.owner.title} has {key}={held.values[key].text}, which takes {lost:.6g} times the speed{where} "
                f"in a frame of {SLOW_FRAME:g} s, but by the research document's step more than {limit:g} makes it "
                "grow, and by the decompiled engine's all of it is lost",
                f"{key} up to {limit / SLOW_FRAME / factor:g} is stable{where} at 10 frames a second; "
                f"{'3' if key == 'surfdrag' else '0.5'} is usual",
                held.owner.subject,
            )


def _is_at_fault(held: Resolved, key: str, factor: float) -> bool:
    stable = is_stable(SCHEME, held.number(key) * factor, SLOW_FRAME)
    return is_body(held) and held.number("maxthrust") > 0 and not bool(stable)
