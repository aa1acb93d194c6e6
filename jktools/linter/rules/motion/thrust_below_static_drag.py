"""JK721: an actor that its AI cannot get off the spot."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.engine.drag import stops
from jktools.engine.flags import PhysicsFlag
from jktools.engine.profile import Engine
from jktools.engine.thrust import MOST_AI_SPEED
from jktools.facts import LevelFacts
from jktools.facts.motion import FPS, body_of, is_body
from jktools.facts.own_line import own_origin, templates_and_things
from jktools.linter.figures import told_apart
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resources import Kind
from jktools.syntax.assets.small import AIClass

DECIDING = ("staticdrag", "maxthrust", "surfdrag", "aiclass", "physflags", "type", "move")
STICKS = PhysicsFlag.FLOOR_STICK | PhysicsFlag.WALL_STICK


@rule("JK721", "thrust-below-static-drag", severity=Severity.WARNING, since="0.1.0")
def thrust_below_static_drag(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report an actor with an AI that pushes it less in a frame than its static drag takes.

    ## Why it matters
    A body on the floor that does not thrust stops dead as soon as it is slower than its `staticdrag`. A player thrusts
    while a key is held, and is spared; an AI does not: it adds `maxthrust` x frame time x 2 to the speed at most, and
    the decompiled engine takes that away again before the body moves. So at 50 frames a second an actor with
    `staticdrag=0.3` and `maxthrust=2` never moves, but at 10 it does. Pushed by exactly its `staticdrag` it goes by the
    decompiled engine, and stays by the research document, which stops what is "at or below". The game's own actors have
    no `staticdrag`. An AI file at hand that lists no instincts moves nobody, and is left out.

    ## Bad
        World templates 4
        guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=2 surfdrag=3 staticdrag=.3 aiclass=a.ai

    ## Good
        World templates 4
        guard none type=actor move=physics physflags=0x4f mass=1 maxthrust=2 surfdrag=3 aiclass=a.ai
    """
    for held in templates_and_things(level):
        place = own_origin(held, *DECIDING)
        ai = held.name_in("aiclass")
        if place is None or not is_body(held) or held.type == "player" or ai is None or _is_idle(level, ai):
            continue
        body = body_of(held)
        push = _push(body.maxthrust)
        stopping = [engine for engine in Engine if bool(stops([push, 0.0, 0.0], body.staticdrag, engine))]
        if body.physflags & STICKS and body.surfdrag > 0 and push > 0 and stopping:
            pushed, static = told_apart(push, body.staticdrag)
            most = "what is slower than" if len(stopping) == len(Engine) else "by the research document also what has"
            ending = "" if len(stopping) == len(Engine) else ", by the decompiled engine only what is slower"
            yield Finding(
                Label(place.span),
                f"{held.owner.title} is pushed by its AI by up to {pushed} JKU/s in a frame of {1 / FPS:g} s "
                f"(maxthrust x {MOST_AI_SPEED:g} / {FPS:g}), but its staticdrag stops {most} {static} JKU/s before it "
                f"moves{ending}",
                "leave staticdrag out, as the game's own actors do, or raise maxthrust to more than "
                f"{body.staticdrag * FPS / MOST_AI_SPEED:.6g}",
                held.owner.subject,
            )


def _push(maxthrust: float) -> float:
    """JKU/s that an AI adds in a frame at most, rounded as the engine does: an exact draw with staticdrag stays one."""
    return float(np.float32(maxthrust) * np.float32(1 / FPS) * np.float32(MOST_AI_SPEED))


def _is_idle(level: Level, ai: str) -> bool:
    found = level.resources.asset(Kind.AI_CLASS, ai)
    return isinstance(found, AIClass) and not found.instincts
