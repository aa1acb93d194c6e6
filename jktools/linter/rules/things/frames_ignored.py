"""JK407: frames that the engine ignores."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level, Template, Thing

LEAST_FRAMES = 1


@rule("JK407", "frames-ignored", severity=Severity.WARNING, since="0.1.0")
def frames_ignored(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report more frames than `numframes` says, a `numframes` below 1, and a second one.

    ## Why it matters
    The engine makes room for as many frames as the first `numframes` says and ignores what is beyond
    (sithTrackThing_LoadPathParams in the decompiled engine): a COG that moves the thing there moves it elsewhere.

    Only frames behind a `numframes` of the same line are judged.

    ## Bad
        World things 3
        1: crate crate .5 1.5 .5 0 0 0 1 move=path numframes=1 frame=(0/0/0:0/0/0) frame=(0/0/1:0/0/0)

    ## Bad
        World things 3
        1: crate crate .5 1.5 .5 0 0 0 1 move=path numframes=0 frame=(0/0/0:0/0/0)

    ## Good
        World things 3
        1: crate crate .5 1.5 .5 0 0 0 1 move=path numframes=2 frame=(0/0/0:0/0/0) frame=(0/0/1:0/0/0)
    """
    owners: list[Template | Thing] = [*level.templates, *level.things]
    for owner in owners:
        fault = _fault(owner.parameters)
        if fault is not None:
            yield Finding(
                Label(owner.span),
                f"{owner.title} {fault}",
                "write the number of frames once, before them; the engine ignores the rest",
                owner.subject,
            )


def _fault(parameters: Sequence[tuple[str, str]]) -> str | None:
    """What is wrong with the frames of one line, or None."""
    keys = [key.lower() for key, _ in parameters]
    if "numframes" not in keys:
        return None
    first = keys.index("numframes")
    announced = _number(parameters[first][1])
    frames = keys[first:].count("frame")
    if announced < LEAST_FRAMES:
        return f"has numframes={parameters[first][1]}, but a path needs at least {LEAST_FRAMES} frame"
    if keys.count("numframes") > 1:
        return f"has numframes {keys.count('numframes')} times, but only the first counts, {announced}"
    if frames > announced:
        return f"has {frames} frames, but numframes={announced}"
    return None


def _number(text: str) -> int:
    """What the engine's atoi makes of a text."""
    found = re.match(r"[-+]?\d+", text)
    return int(found.group()) if found else 0
