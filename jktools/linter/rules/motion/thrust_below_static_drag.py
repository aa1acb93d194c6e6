"""JK721: a body whose thrust does not bring it above the speed at which it stops."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.engine.integration import steady_speed
from jktools.facts import LevelFacts
from jktools.facts.motion import bodies, body_of
from jktools.linter.rule import Finding, rule
from jktools.model import Level

DECIDING = ("staticdrag", "surfdrag", "maxthrust")


@rule("JK721", "thrust-below-static-drag", severity=Severity.WARNING, since="0.1.0")
def thrust_below_static_drag(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an actor or player whose walking speed is no more than its static drag.

    ## Why it matters
    A body on the floor that does not thrust stops dead as soon as it is no faster than its `staticdrag`. Its walking
    speed is `maxthrust` / `surfdrag`: where that is less, it never moves but while it thrusts, and an AI, which pushes
    its body without thrusting, does not get away at all.

    ## Bad
        World templates 4
        guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=.5 surfdrag=5 staticdrag=.3

    ## Good
        World templates 4
        guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=2 surfdrag=3 staticdrag=.3
    """
    for held in bodies(level):
        body = body_of(held)
        own = [held.values[k].origins[0] for k in DECIDING if k in held.values]
        span = next((origin.span for origin in own if origin.owner == held.owner), None)
        if span is None or body.maxthrust <= 0 or body.surfdrag <= 0:
            continue
        speed = float(steady_speed(body.maxthrust, body.surfdrag))
        if speed <= body.staticdrag:
            yield Finding(
                Label(span),
                f"{held.owner.title} walks at {speed:.6g} JKU/s (maxthrust / surfdrag), but its staticdrag stops it at "
                f"{body.staticdrag:.6g} JKU/s and below",
                "raise maxthrust, or lower surfdrag or staticdrag",
                held.owner.subject,
            )
