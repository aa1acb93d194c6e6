"""Levels of two rooms whose scripts test sight, for figures that can be worked out by hand.

The two rooms are cubes of one JKU with 6 surfaces each, sector 0 at y 0 to 1 and sector 1 at y 1 to 2, with one adjoin
between them: a ray within one room tests 6 surfaces, one from room to room 12.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from jktools.facts import LevelFacts
from jktools.facts.hotspots import Hotspot
from tests.support.levels import level_with_files

PLAYER = "0: walkplayer walkplayer .5 .5 .2 0 0 0 0"


def hotspots(*fragment: str) -> list[Hotspot]:
    """The tests of sight that the two rooms with a fragment have."""
    with level_with_files(*fragment) as level:
        return LevelFacts(level).hotspots


def things(count: int, template: str = "lamp", sector: int = 0, first: int = 10) -> Iterator[str]:
    """Lines that place things of a template in one of the rooms."""
    y = ".5" if sector == 0 else "1.5"
    return (f"{i}: {template} {template} .5 {y} .5 0 0 0 {sector}" for i in range(first, first + count))


def class_cog(lines: Sequence[str], *placed: str, template: str = "lamp none type=cog cog=lamp.cog") -> list[str]:
    """A level with a script as the class COG of a template, beside the player."""
    return ["World templates 4", template, "World things 90", PLAYER, *placed, "== cog/lamp.cog", *lines]


def placed_cog(values: str, *lines: str, more: Sequence[str] = ()) -> list[str]:
    """A placed script with two ghosts to look at: thing 20 in sector 0, thing 21 in sector 1, and no player."""
    return [
        "World templates 4", "mark none type=ghost", "World things 90", *more, "20: mark mark .5 .5 .5 0 0 0 0",
        "21: mark mark .5 1.5 .5 0 0 0 1", "World cogs 1", f"0: look.cog {values}", "== cog/look.cog", *lines,
    ]  # fmt: skip


SWING_LAMP = """
symbols
message created
message pulse
end
code
created:
    SetThingPulse(GetSenderRef(), 0.1);
    return;
pulse:
    if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) SetThingLight(GetSenderRef(), 1.0, 0.1);
    return;
end
""".strip().split("\n")


def view_loop(distance: str = "10") -> list[str]:
    """A script that walks through what is in view of a turret."""
    return [
        "symbols", "message startup", "message pulse", "thing turret", "thing victim local", "end", "code",
        "startup: SetPulse(0.5); return;",
        "pulse:",
        f"victim = FirstThingInView(turret, 90, {distance}, 0x404);",
        "while (victim != -1) {",
        'if (HasLOS(turret, victim) == 1) Print("seen");',
        "victim = NextThingInView();",
        "}",
        "return;", "end",
    ]  # fmt: skip


GUARDS = [
    "World templates 5",
    "mark none type=ghost",
    "guard none type=actor move=physics",
    "World things 90",
    PLAYER,
    "20: mark mark .5 .5 .5 0 0 0 0",
]


def guarded(count: int, *script: str) -> list[Hotspot]:
    """The tests of sight among guards in the other room."""
    guards = things(count, "guard", sector=1, first=40)
    return hotspots(*GUARDS, *guards, "World cogs 1", "0: look.cog 20", "== cog/look.cog", *script)


def walk(*body: str) -> list[str]:
    """The script of `view_loop` with other lines in its loop."""
    script = view_loop()
    at = script.index('if (HasLOS(turret, victim) == 1) Print("seen");')
    return [*script[:at], *body, *script[at + 1 :]]


def looking(*body: str, symbols: Sequence[str] = ("thing a", "thing b")) -> list[str]:
    """A script with two things to test sight between."""
    messages = [f"message {name}" for name in ("startup", "pulse", "timer", "activated", "trigger")]
    return ["symbols", *messages, *symbols, "end", "code", *body, "end"]


LOOK = 'if (HasLOS(a, b) == 1) Print("seen");'


def two_scripts(
    first: Sequence[str], second: Sequence[str], values: str = "1", symbol: str = "cog other"
) -> list[Hotspot]:
    """A level with two placed scripts, of which the first knows the second."""
    head = ["symbols", *(f"message {m}" for m in ("startup", "pulse", "timer", "activated", "user0", "user1"))]
    return hotspots(
        "World templates 4", "mark none type=ghost", "World things 90", "20: mark mark .5 .5 .5 0 0 0 0",
        "21: mark mark .5 1.5 .5 0 0 0 1", "World cogs 2", f"0: first.cog {values}", "1: second.cog 20 21",
        "== cog/first.cog", *head, symbol, "int i local", "end", "code", *first, "end",
        "== cog/second.cog", *head, "thing a", "thing b", "cog back=0 local", "end", "code", *second, "end",
    )  # fmt: skip


ASKED = [f"user0: {LOOK} return;", "user1: return;"]
