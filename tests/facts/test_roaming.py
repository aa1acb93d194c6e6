"""Where bodies come to, as the cost of sight counts it: two rooms of 6 surfaces whose adjoin lets nothing pass.

The lamp is in room 0 with the player (thing 0), an actor (2) and a mark (3); another actor (4) and mark (5) are in room
1. A look within room 0 tests 6 surfaces, one into room 1 tests 12: 9 on the mean where what it looks for comes to both.
"""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from jktools.facts import LevelFacts
from tests.support.levels import level_with_files

SHUT = ["World adjoins 2", "0: 0x5 1 1", "1: 0x5 0 1"]
THINGS = [
    "World templates 6", "mark none type=ghost", "guard none type=actor move=physics",
    "lamp none type=cog cog=lamp.cog", "World things 90", "0: walkplayer walkplayer .5 .5 .2 0 0 0 0",
    "2: guard guard .5 .5 .5 0 0 0 0", "3: mark mark .5 .5 .5 0 0 0 0", "4: guard guard .5 1.5 .5 0 0 0 1",
    "5: mark mark .5 1.5 .5 0 0 0 1", "6: lamp lamp .5 .5 .5 0 0 0 0",
]  # fmt: skip
LAMP = ["== cog/lamp.cog", "symbols", "message created", "message pulse", "thing seen=SEEN", "end", "code",
        "created: SetThingPulse(GetSenderRef(), 0.5); return;",
        'pulse: if (HasLOS(GetSenderRef(), seen) == 1) Print("x"); return;', "end"]  # fmt: skip
SENDER = ["== cog/x.cog", "symbols", "message activated", *(f"thing t{i} nolink" for i in range(6)), "sector s nolink",
          "vector v", "end", "code", "activated: CODE; return;", "end"]  # fmt: skip
VALUES = "0 1 2 3 4 5 1 (.5/1.5/.5)"


def surfaces(
    code: str, seen: str = "GetLocalPlayerThing()", *more: str, line: str = VALUES, files: Sequence[str] = ()
) -> float:
    lamp = [text.replace("thing seen=SEEN", "int none local").replace("seen)", f"{seen})") for text in LAMP]
    sender = [text.replace("CODE", code) for text in SENDER] if code else []
    cogs = ["World cogs 1", "- 0: door.cog 3 -1 wind.wav", f"0: x.cog {line}"]
    with level_with_files(*SHUT, *THINGS, *more, *cogs, *lamp, *sender, *files) as level:
        (found,) = [spot for spot in LevelFacts(level).hotspots if spot.runner.name == "lamp.cog"]
    return found.cost.mean_surfaces


@pytest.mark.parametrize(("code", "player", "guard"), [
    ("s = s", 6, 6),
    ("TeleportThing(t0, t5)", 9, 6),
    ("TeleportThing(t2, t5)", 6, 9),
    ("TeleportThing(t3, t5)", 6, 6),  # a mark
    ("TeleportThing(t0, t3)", 6, 6),  # within the room
    ("TeleportThing(GetLocalPlayerThing(), t5)", 9, 6),
    ("TeleportThing(GetSourceRef(), t5)", 9, 9),  # whoever
    ("TeleportThing(t0, t4)", 9, 6),  # to where the other guard is by then
    ("TeleportThing(t0, t2); TeleportThing(t2, t5)", 9, 9),  # and the guard may be in room 1
    ("TeleportThing(t2, t0); TeleportThing(t0, t5)", 9, 9),
    ("TeleportThing(t0, GetSourceRef())", 9, 6),  # anywhere
    ("TeleportThing(FirstThingInView(t0, 90, 9, 0x4), t5)", 6, 9),  # an actor
    ("TeleportThing(FirstThingInView(t0, 90, 9, 0x400), t5)", 9, 6),
    ("SetThingPos(t0, v)", 9, 6),
    ("JumpToFrame(t3, 0, s)", 9, 9),  # with whoever rides on it
])  # fmt: skip
def test_scripts_put_bodies_elsewhere(code: str, player: float, guard: float) -> None:
    assert (surfaces(code), surfaces(code, "2")) == (player, guard)


def test_a_script_that_is_not_at_hand_may_put_bodies_in_what_it_names() -> None:
    assert surfaces("", line="99") == 6
    assert surfaces("", line="99 6") == 9  # a surface of room 1


def test_a_class_cog_puts_what_carries_it_elsewhere() -> None:
    sent = ["== cog/g.cog", "symbols", "message touched", "end", "code", "touched:",
            "TeleportThing(GetSenderRef(), 5); return;", "end"]  # fmt: skip
    carried = ["World templates 7", "chief guard cog=g.cog", "World things 90", "2: chief chief .5 .5 .5 0 0 0 0"]
    assert surfaces("s = s", "2", *carried, files=sent) == 9
    assert surfaces("s = s", "GetLocalPlayerThing()", *carried, files=sent) == 6


def test_bodies_ride_on_lifts() -> None:
    assert surfaces("s = s", "GetLocalPlayerThing()", *lift(".2")) == 6
    assert surfaces("s = s", "GetLocalPlayerThing()", *lift("1.2")) == 9


def lift(y: str) -> list[str]:
    frames = f"numframes=2 frame=(.5/.2/.5:0/0/0) frame=(.5/{y}/.5:0/0/0)"
    return ["World things 90", f"7: walkplayer crate .5 .2 .5 0 0 0 0 type=cog move=path collide=3 {frames}"]
