"""JK407: frames that the engine ignores."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resolved import Ignored, Reason, Resolved
from jktools.syntax.template.values import ValueKind, scan

LEAST_FRAMES = 1


@rule("JK407", "frames-ignored", severity=Severity.WARNING, since="0.1.0")
def frames_ignored(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report frames of a path before or beyond what `numframes` says, a `numframes` below 1, and a second one.

    ## Why it matters
    The engine makes room for as many frames as the first `numframes` says and ignores what is beyond
    (sithTrackThing_LoadPathParams in the decompiled engine): a COG that moves the thing there moves it elsewhere.

    A template hands its frames and their number on: a child or thing adds to them, while there is room. A patrol in a
    template, which has no room at all, is JK425's.

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
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        faults = [i for i in held.ignored if (i.key, i.reason) in _FAULTS]
        patrol = any(i.reason is Reason.BEFORE_BIRTH for i in held.ignored)
        if faults and not patrol and not held.leaves_level:
            yield Finding(
                Label(faults[0].origin.span),
                f"{held.owner.title} {_fault(held, faults)}",
                "write the number of frames once, before them; the engine ignores the rest",
                held.owner.subject,
            )


_FAULTS = {("frame", Reason.FULL), ("numframes", Reason.REJECTED)}


def _fault(held: Resolved, faults: Sequence[Ignored]) -> str:
    """What is wrong with the frames of one line."""
    count = held.values.get("numframes")
    for ignored in faults:
        if ignored.key == "numframes":
            if int(str(scan(ValueKind.INT, ignored.text))) < LEAST_FRAMES or count is None:
                return f"has numframes={ignored.text}, but a path needs at least {LEAST_FRAMES} frame"
            owner = count.origins[0].owner
            where = "already" if owner is held.owner else f"from {owner.title}"
            return f"has numframes={ignored.text}, but has numframes={count.text} {where}, and the first counts"
    if count is None:
        return "has a frame, but no numframes makes room for it"
    first = count.origins[0]
    if first.owner is held.owner and first.place > faults[0].origin.place:
        return f"has a frame before numframes={count.text}, but only that makes room for it"
    frames = held.values["frame"].value
    assert isinstance(frames, tuple)
    return f"has {len(frames) + len(faults)} frames, but numframes={count.text}"
