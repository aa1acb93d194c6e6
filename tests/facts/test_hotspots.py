"""Hotspots: calls a second and counted work against figures worked out by hand.

The two rooms are cubes of one JKU with 6 surfaces each, sector 0 at y 0 to 1 and sector 1 at y 1 to 2, with one adjoin
between them: a ray within one room tests 6 surfaces, one from room to room 12.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from jktools.facts import LevelFacts
from jktools.facts.hotspots import Hotspot, Verdict
from jktools.linter import find_rule, lint
from jktools.session import discover, load
from tests.support.levels import CORPUS, ROOT, level_with_files, two_rooms
from tests.support.scripts import corpus_scripts

PLAYER = "0: walkplayer walkplayer .5 .5 .2 0 0 0 0"


def hotspots(*fragment: str) -> list[Hotspot]:
    with level_with_files(*fragment) as level:
        return LevelFacts(level).hotspots


def things(count: int, template: str = "lamp", sector: int = 0, first: int = 10) -> Iterator[str]:
    y = ".5" if sector == 0 else "1.5"
    return (f"{i}: {template} {template} .5 {y} .5 0 0 0 {sector}" for i in range(first, first + count))


def class_cog(lines: Sequence[str], *placed: str, template: str = "lamp none type=cog cog=lamp.cog") -> list[str]:
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


def test_sixty_lamps_pulse_once_each_though_they_share_one_script() -> None:
    (found,) = hotspots(*class_cog(SWING_LAMP, *things(60)))
    # 60 lamps x 10 pulses a second x 1 call.
    assert found.calls_per_second == pytest.approx(600)
    assert found.handlers == pytest.approx({"pulse": 600})
    # The player can stand in either room: 6 surfaces in the lamp's, 12 to the other.
    assert (found.cost.mean_surfaces, found.cost.most_surfaces) == (9, 12)
    assert (found.cost.mean_sectors, found.cost.most_sectors) == (1.5, 2)
    assert found.surfaces_per_second == pytest.approx(5400)
    assert found.verdict is Verdict.VARIES
    assert found.runner.title == "class cog lamp.cog on 60 things"
    assert not found.runner.more


def test_lamps_in_both_rooms_cost_their_mean() -> None:
    (found,) = hotspots(*class_cog(SWING_LAMP, *things(1), *things(3, sector=1, first=30)))
    assert found.calls_per_second == pytest.approx(40)
    # Whichever room: half the player's places are in the same one.
    assert found.cost.mean_surfaces == 9


def test_what_another_template_creates_is_told() -> None:
    created = ["World templates 5", "lamp none type=cog cog=lamp.cog", "box none type=actor explode=lamp"]
    lines = [*created, "World things 90", PLAYER, *things(2), "40: box box .5 .5 .5 0 0 0 0", "== cog/lamp.cog"]
    (found,) = hotspots(*lines, *SWING_LAMP)
    assert found.runner.more
    assert found.runner.title == "class cog lamp.cog on 2 things and others"


def view_loop(distance: str = "10") -> list[str]:
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
    guards = things(count, "guard", sector=1, first=40)
    return hotspots(*GUARDS, *guards, "World cogs 1", "0: look.cog 20", "== cog/look.cog", *script)


def test_a_loop_over_what_is_in_view_turns_once_for_each_thing_of_the_type() -> None:
    by_verb = {h.site.verb.name: h for h in guarded(3, *view_loop())}
    # 2 pulses a second; the level has 3 guards and 1 player.
    assert by_verb["firstthinginview"].calls_per_second == pytest.approx(2)
    assert by_verb["haslos"].calls_per_second == pytest.approx(8)
    assert by_verb["haslos"].per_run == {"pulse": 4}


def test_the_engine_keeps_no_more_than_32_things_in_view() -> None:
    by_verb = {h.site.verb.name: h for h in guarded(45, *view_loop())}
    assert by_verb["haslos"].per_run == {"pulse": 32}


def walk(*body: str) -> list[str]:
    script = view_loop()
    at = script.index('if (HasLOS(turret, victim) == 1) Print("seen");')
    return [*script[:at], *body, *script[at + 1 :]]


@pytest.mark.parametrize(("body", "most"), [
    (['if (HasLOS(turret, turret) == 1) Print("seen");'], 32),  # not one of the things in view: a list's length
    (["if (HasLOS(turret, victim) == 1) DamageThing(victim, 1, 1, turret);"], 4),
    (["if (HasLOS(turret, victim) == 1) victim = FirstThingInView(turret, 90, 10, 0x404);"], math.inf),
    (['if (HasLOS(turret, victim) == 1) Print("seen");', "FirstThingInView(turret, 90, 10, 0x404);"], math.inf),
])  # fmt: skip
def test_what_ends_a_loop_over_things_in_view(body: list[str], most: float) -> None:
    by_verb = {h.site.verb.name: h for h in guarded(3, *walk(*body))}
    assert by_verb["haslos"].per_run == {"pulse": most}


def test_a_bound_takes_it_that_other_scripts_may_start_the_list_anew() -> None:
    disturbed, alone = (
        next(h for h in guarded(3, *walk(body)) if h.site.verb.name == "haslos")
        for body in (
            "if (HasLOS(turret, victim) == 1) DamageThing(victim, 1, 1, turret);",
            'if (HasLOS(turret, victim) == 1) Print("seen");',
        )
    )
    bounds = [h.runner.analysis.rates.repeats_of("pulse", h.site).per_run for h in (disturbed, alone)]
    assert bounds == [math.inf, 32]


@pytest.mark.parametrize(("distance", "sectors", "surfaces"), [("10", 2, 2), ("2", 2, 2), ("1", 2, 1), ("0", 2, 1)])
def test_a_flood_goes_on_while_the_adjoins_are_near(distance: str, sectors: int, surfaces: int) -> None:
    # Each adjoin's dist is 1 on either side: the other room is 2 JKU away. It is entered all the same; only its own
    # adjoins are looked at no more.
    (found,) = [h for h in guarded(1, *view_loop(distance)) if h.site.verb.name == "firstthinginview"]
    assert (found.cost.most_sectors, found.cost.most_surfaces) == (sectors, surfaces)


def looking(*body: str, symbols: Sequence[str] = ("thing a", "thing b")) -> list[str]:
    messages = [f"message {name}" for name in ("startup", "pulse", "timer", "activated", "trigger")]
    return ["symbols", *messages, *symbols, "end", "code", *body, "end"]


LOOK = 'if (HasLOS(a, b) == 1) Print("seen");'


@pytest.mark.parametrize(("body", "calls"), [
    (["startup:", "while (1) {", LOOK, "Sleep(0.25);", "}", "return;"], 4),
    (["startup:", "while (1) {", LOOK, LOOK.replace("a, b", "b, a"), "Sleep(0.5);", "}", "return;"], 2),
    (["startup: SetPulse(1.0); return;", "pulse: call look; call look; return;", f"look: {LOOK} return;"], 2),
    (["startup: SetPulse(0.001); return;", f"pulse: {LOOK} return;"], 50),
    (["startup: SetPulse(0.5); return;", "pulse:", "for (i = 0; i < 10; i = i + 1) {", LOOK, "}", "return;"], 20),
    (["startup: SetTimer(0.5); return;", f"timer: {LOOK} return;"], 0),
    (["startup: SetTimer(0.5); return;", f"timer: {LOOK} SetTimer(0.2); return;"], 5),
    (["startup: SetPulse(2.0); return;", "pulse: SetTimer(0.5); return;", f"timer: {LOOK} return;"], 0.5),
    (["startup: SetTimerEx(0.5, 1, 0, 0); return;", f"timer: {LOOK} SetTimerEx(0.25, 1, 0, 0); return;"], 4),
    (["activated: SetPulse(0.5); return;", f"pulse: {LOOK} return;"], 2),
    ([f"activated: {LOOK} return;"], 0),
    # A script wakes in a later frame: one turn a frame at most.
    (["startup:", "while (1) {", LOOK, "Sleep(0.001);", "}", "return;"], 50),
    # A flex of 0.7 is a little less, and the clock cuts it to 699 ms.
    (["startup: SetPulse(0.7); return;", f"pulse: {LOOK} return;"], 1 / 0.699),
    # The label that is called sleeps 0.2 s, whichever way.
    (["startup:", "while (1) {", LOOK, "call nap;", "}", "return;",
      "nap: if (Rand() < 0.5) Sleep(1); else { Sleep(0.1); Sleep(0.1); } return;"], 5),
    # That of a handler which can come twice may find no place for the call, and turn without.
    (["activated:", "while (1) {", LOOK, "call nap;", "}", "return;", "nap: Sleep(0.2); return;"], math.inf),
    (["activated:", "while (1) {", LOOK, "call nap; Sleep(0.5);", "}", "return;", "nap: Sleep(0.5); return;"], 2),
    # What sleeps on one way only may turn for ever without.
    (["startup:", "while (1) {", LOOK, "call nap;", "}", "return;",
      "nap: if (Rand() < 0.5) Sleep(1); return;"], math.inf),
    (["startup:", "while (1) {", LOOK, "}", "return;"], math.inf),
    # Each pulse turns itself off: one for each time that it is set.
    (["startup: SetPulse(0.01); return;", f"pulse: {LOOK} SetPulse(0); return;"], 0),
    (["startup: SetPulse(0.01); return;",
      f"pulse: if (Rand() < 0.5) SetPulse(0); else SetPulse(-1); {LOOK} return;"], 0),
    (["startup: SetTimer(0.5); return;", "timer: SetPulse(0.01); SetTimer(0.5); return;",
      f"pulse: {LOOK} SetPulse(0); return;"], 2),
    # Not on every way, not before the script waits, or only until it is set again.
    (["startup: SetPulse(0.1); return;", f"pulse: {LOOK} if (Rand() < 0.5) SetPulse(0); return;"], 10),
    (["startup: SetPulse(0.1); return;", f"pulse: {LOOK} Sleep(1); SetPulse(0); return;"], 10),
    (["startup: SetPulse(0.1); return;", f"pulse: {LOOK} SetPulse(0); SetPulse(0.1); return;"], 10),
    (["startup: SetPulse(0.1); return;", f"pulse: {LOOK} call off; return;", "off: SetPulse(0); return;"], 10),
    # Messages to itself, in and out of loops.
    (["startup: SetPulse(0.5); return;", "pulse: SendMessage(GetSelfCog(), activated); return;",
      f"activated: {LOOK} return;"], 2),
    (["startup: SetPulse(0.5); return;", "pulse: SendMessage(GetSelfCog(), activated); return;",
      f"activated: {LOOK} SetPulse(0.5); return;"], 2),
    (["startup: SetPulse(0.5); return;",
      "pulse: for (i = 0; i < 3; i = i + 1) SendMessageEx(GetSelfCog(), activated, 0, 0, 0, 0); return;",
      f"activated: {LOOK} return;"], 6),
    ([f"activated: {LOOK} SendMessage(GetSelfCog(), activated); return;"], math.inf),
    (["startup: SetPulse(1); return;", "pulse: SendTrigger(-1, 0, 0, 0, 0, 0); return;",
      f"trigger: {LOOK} return;"], 1),
    # Two timers that wait at a time go on beside each other.
    (["startup: SetTimerEx(0.5, 1, 0, 0); SetTimerEx(0.5, 2, 0, 0); return;",
      f"timer: {LOOK} SetTimerEx(0.25, 1, 0, 0); return;"], 8),
    (["startup: SetTimerEx(0.5, 1, 0, 0); return;",
      f"timer: {LOOK} if (Rand() < 0.5) SetTimerEx(0.25, 1, 0, 0); else SetTimerEx(1, 1, 0, 0); return;"], 4),
    # Each brings two more: as many as the engine has room for.
    (["startup: SetTimerEx(0.5, 1, 0, 0); return;",
      f"timer: {LOOK} SetTimerEx(0.25, 1, 0, 0); SetTimerEx(0.5, 1, 0, 0); return;"], 256 * 4),
    (["startup: SetPulse(0.5); return;", "pulse: SetPulse(0); return;", f"activated: {LOOK} return;"], 0),
    ([f"pulse: {LOOK} SetPulse(0.5); return;", "startup: return;"], 0),
])  # fmt: skip
def test_calls_a_second_of_a_placed_script(body: list[str], calls: float) -> None:
    script = looking(*body, symbols=("thing a", "thing b", "int i local"))
    found = hotspots(*placed_cog("20 21", *script))
    assert [h.calls_per_second for h in found] == pytest.approx([calls] * len(found))
    assert found
    # From room to room, whichever way round.
    assert {h.cost.most_surfaces for h in found} == {12}


COUNTED = "SetPulse(0.1); i = 5; return;"
DOWN = "i = i - 1; if (!i) SetPulse(0);"


@pytest.mark.parametrize(("body", "calls"), [
    # Five pulses, each time that it is set, and once: nothing lasts. Set each second they are five a second.
    ([f"startup: {COUNTED}", f"pulse: {LOOK} {DOWN} return;"], 0),
    ([f"startup: {COUNTED}", f"pulse: {DOWN} {LOOK} return;"], 0),
    ([f"startup: {COUNTED}", f"pulse: {DOWN} Sleep(1); {LOOK} return;"], 0),
    ([f"activated: {COUNTED}", f"pulse: {LOOK} {DOWN} return;"], 0),
    (["startup: SetTimer(1); return;", f"timer: SetTimer(1); {COUNTED}", f"pulse: {LOOK} {DOWN} return;"], 5),
    (["startup: SetTimer(1); return;", "timer: SetTimer(1); i = 5; SetPulse(0.1); return;",
      f"pulse: {LOOK} i = i - 1; if (i > 0) return; SetPulse(0); return;"], 5),
    (["startup: SetTimer(1); return;", "timer: SetTimer(1); i = 0; SetPulse(0.1); return;",
      f"pulse: {LOOK} i = i + 2; if (i >= 7) SetPulse(0); return;"], 4),
    # Never more often than once an interval.
    (["startup: SetTimer(0.1); return;", f"timer: SetTimer(0.1); {COUNTED}", f"pulse: {LOOK} {DOWN} return;"], 10),
    # One step or two: one at the least.
    (["startup: SetTimer(1); return;", f"timer: SetTimer(1); {COUNTED}",
      f"pulse: {LOOK} if (Rand() < 0.5) i = i - 1; else i = i - 2; if (i <= 0) SetPulse(0); return;"], 5),
    # Each setting begins where the last one ended: 3 once, then a pulse each; or 5 again.
    (["startup: SetTimer(1); return;", "timer: SetTimer(1); SetPulse(0.1); return;",
      f"pulse: {LOOK} k = k - 1; if (!k) {{ SetPulse(0); k = 5; }} return;"], 5),
    # The value of the level, set once; what is set again goes on below 0.
    (["startup: SetPulse(0.1); return;", f"pulse: {LOOK} k = k - 1; if (!k) SetPulse(0); return;"], 0),
    (["activated: SetPulse(0.1); return;", f"pulse: {LOOK} k = k - 1; if (!k) SetPulse(0); return;"], 10),
    (["activated: SetPulse(0.1); return;", f"pulse: {LOOK} if (k > 0) k = k - 1; if (k <= 0) SetPulse(0); return;"], 0),
    # What proves nothing: it steps over 0, stands still, is set back, waits, is stepped or set by others.
    (["startup: SetPulse(0.1); i = 5; return;", f"pulse: {LOOK} i = i - 2; if (!i) SetPulse(0); return;"], 10),
    (["startup: SetPulse(0.1); i = 0; return;", f"pulse: {LOOK} {DOWN} return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} if (Rand() < 0.5) i = i - 1; if (!i) SetPulse(0); return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} i = i - Rand(); if (i <= 0) SetPulse(0); return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} Sleep(1); {DOWN} return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} i = i - 1; Sleep(1); if (!i) SetPulse(0); return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} call down; return;", f"down: {DOWN} return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} {DOWN} return;", "activated: i = 9; return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} {DOWN} return;", "activated: i = i - 1; return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} {DOWN} return;", "activated: a[Rand()] = 9; return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} i = i - 1; if (!i) SetPulse(0); else SetPulse(0.1); return;"], 10),
    (["startup: i = 5; Sleep(1); SetPulse(0.1); return;", f"pulse: {LOOK} {DOWN} return;"], 10),
    (["startup: i = Rand(); SetPulse(0.1); return;", f"pulse: {LOOK} {DOWN} return;"], 10),
    (["startup: SetPulse(0.1); i = 4; return;", f"pulse: {LOOK} i = i - 1; goto down;", "activated: goto down;",
      f"down: {DOWN} return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} {DOWN} Sleep(1); i = 5; return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} {DOWN} call back; return;", "back: if (Rand() < 0.5) i = 5; return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} {DOWN} i = Rand(); return;"], 10),
    ([f"startup: {COUNTED}", f"pulse: {LOOK} i = i - 1; if (!i) {{ Sleep(1); SetPulse(0); }} return;"], 10),
    # Three messages take the value of the level to 0 before the pulse is set; set twice, it begins at 0 again.
    (["startup: for (i = 0; i < 3; i = i + 1) SendMessage(GetSelfCog(), pulse); SetPulse(0.1); return;",
      f"pulse: {LOOK} k = k - 1; if (!k) SetPulse(0); return;"], 10),
    (["startup: call on; Sleep(5); call on; return;", "on: SetPulse(0.1); return;",
      f"pulse: {LOOK} k = k - 1; if (!k) SetPulse(0); return;"], 10),
])  # fmt: skip
def test_a_pulse_that_counts_itself_down_ends(body: list[str], calls: float) -> None:
    script = looking(*body, symbols=("thing a", "thing b", "int i local", "int k=3 local"))
    found = hotspots(*placed_cog("20 21", *script))
    assert [h.calls_per_second for h in found] == pytest.approx([calls])
    assert [h.pulse < math.inf for h in found] == [calls > 0]


def test_a_pulse_that_flags_arm_counts_from_the_start() -> None:
    def calls(count: Sequence[str]) -> list[float]:
        script = looking(f"pulse: {LOOK} {DOWN} return;", *count, symbols=("thing a", "thing b", "int i=3 local"))
        return [h.calls_per_second for h in hotspots(*placed_cog("20 21", "flags=0x44", *script))]

    assert calls([]) == [0]
    # It may have come to 0 before it is set.
    assert calls(["activated: SetPulse(1); i = 5; return;"]) == [50]


def test_lamps_that_share_a_counter_do_not_count_their_own_pulses_down() -> None:
    counting = [
        line.replace("message pulse", "message pulse\nint i=4 local").replace(
            "    if", "    i = i - 1; if (i <= 0) { SetThingPulse(GetSenderRef(), 0); i = 0; } if"
        )
        for line in SWING_LAMP
    ]
    script = "\n".join(counting).split("\n")
    (one,) = hotspots(*class_cog(script, *things(1)))
    assert one.calls_per_second == 0
    (two,) = hotspots(*class_cog(script, *things(2)))
    assert two.calls_per_second == pytest.approx(20)


def test_two_calls_of_one_helper_are_one_site_and_two_calls() -> None:
    script = looking("startup: SetPulse(1.0); return;", "pulse: call look; call look; return;", f"look: {LOOK} return;")
    (found,) = hotspots(*placed_cog("20 21", *script))
    assert found.per_run == {"pulse": 2}


def test_a_handler_beside_a_sleeping_loop_does_not_wake_it() -> None:
    def calls(pulse: str) -> float:
        start = "startup: SetPulse(0.1); while (1) { call look; Sleep(10); } return;"
        lines = looking(start, f"pulse: {pulse} return;", f"look: {LOOK} return;")
        (found,) = hotspots(*placed_cog("20 21", *lines))
        return found.calls_per_second

    assert calls("") == pytest.approx(0.1)
    # Each pulse looks itself, and may be what the loop's sleep goes on behind.
    assert calls("call look;") == pytest.approx(10 + 10 + 0.1)


def test_an_endless_loop_is_told_as_one() -> None:
    (found,) = hotspots(*placed_cog("20 21", *looking("startup:", "while (1) {", LOOK, "}", "return;")))
    assert math.isinf(found.per_run["startup"])


@pytest.mark.parametrize(("body", "endless"), [
    (["startup: while (1) {", LOOK, "}", "pulse: return;"], True),  # its way out is where another handler begins
    (["startup: if (rand() > 0.5) { while (1) {", LOOK, "} } return;"], True),
    (["startup: while (1) {", LOOK, "if (rand() > 0.5) return; }", "pulse: return;"], False),
    (["startup: do {", LOOK, "} while (0);", "pulse: return;"], False),
])  # fmt: skip
def test_a_way_out_that_its_condition_shuts_ends_no_loop(body: list[str], endless: bool) -> None:
    assert [h.endless for h in hotspots(*placed_cog("20 21", *looking(*body)))] == [endless]


def test_an_endless_loop_is_over_any_budget_though_its_ends_are_not_known() -> None:
    script = looking("startup: SetPulse(1); while (1) HasLOS(a, b); return;", "pulse: HasLOS(a, a); return;")
    lines = placed_cog("20 99", *script)
    assert [h.surfaces_per_second for h in hotspots(*lines)] == [math.inf, 6]
    with level_with_files(*lines) as level:
        (told,) = lint(level, [find_rule("JK650")])
    assert told.message.startswith("cog 0 (look.cog) asks for sight any number of times a second")


def test_a_loop_that_may_end_after_any_number_of_turns_is_over_no_budget() -> None:
    script = looking("startup: SetPulse(1); return;", "pulse: while (Rand() < 0.5)", LOOK, "return;")
    lines = placed_cog("20 21", *script)
    assert [(h.calls_per_second, h.endless) for h in hotspots(*lines)] == [(math.inf, False)]
    with level_with_files(*lines) as level:
        assert lint(level, [find_rule("JK650")]) == []


@pytest.mark.parametrize(("mask", "calls"), [("mask=0x405", 15), ("mask=0x404", 0), ("nolink", 0), ("", 15)])
def test_pulses_of_things_reach_a_placed_script_by_its_links(mask: str, calls: float) -> None:
    lamps = [f"thing lamp{i} {mask}" for i in range(3)]
    body = ["startup:", "for (i = 0; i < 3; i = i + 1) SetThingPulse(lamp0[i], 0.2);", "return;",
            "pulse: if (HasLOS(GetSenderRef(), b) == 1) Print(\"seen\"); return;"]  # fmt: skip
    script = looking(*body, symbols=(*lamps, "int i local", "thing b"))
    more = ["30: mark mark .2 .5 .5 0 0 0 0", "31: mark mark .4 .5 .5 0 0 0 0", "32: mark mark .6 .5 .5 0 0 0 0"]
    (found,) = hotspots(*placed_cog("30 31 32 21", *script, more=more))
    assert found.calls_per_second == pytest.approx(calls)


@pytest.mark.parametrize(("capture", "calls"), [("", 0), ("CaptureThing(lamp);", 5)])
def test_a_captured_thing_sends_its_pulses(capture: str, calls: float) -> None:
    body = [f"startup: {capture} SetThingPulse(lamp, 0.2); return;", f"pulse: {LOOK} return;"]
    script = looking(*body, symbols=("thing lamp nolink", "thing a nolink", "thing b nolink"))
    more = ["30: mark mark .2 .5 .5 0 0 0 0"]
    (found,) = hotspots(*placed_cog("30 20 21", *script, more=more))
    assert found.calls_per_second == pytest.approx(calls)


def test_flags_can_arm_a_pulse() -> None:
    script = looking(f"pulse: {LOOK} return;")
    assert [h.calls_per_second for h in hotspots(*placed_cog("20 21", "flags=0x40", *script))] == [0]
    assert [h.calls_per_second for h in hotspots(*placed_cog("20 21", "flags=0x44", *script))] == [50]


@pytest.mark.parametrize(("flags", "more"), [("0x4", [True]), ("0x40", [False])])
def test_a_pulse_that_a_script_arms_by_flags_is_told(flags: str, more: list[bool]) -> None:
    script = looking(f"startup: SetCogFlags(GetSelfCog(), {flags}); return;", f"pulse: {LOOK} return;")
    with level_with_files(*placed_cog("20 21", *script), game="mots") as level:
        assert [h.more for h in LevelFacts(level).hotspots] == more


def test_a_lamp_that_turns_its_pulse_off_looks_once() -> None:
    def lamps(off: str) -> Hotspot:
        lines = [f"{off} {line}" if "HasLOS" in line else line for line in SWING_LAMP]
        symbols = [line if line != "message pulse" else "message pulse\nthing me local" for line in lines]
        (found,) = hotspots(*class_cog("\n".join(symbols).split("\n"), *things(60)))
        return found

    assert lamps("").calls_per_second == pytest.approx(600)
    assert lamps("SetThingPulse(GetSenderRef(), 0);").calls_per_second == 0
    assert lamps("me = GetSenderRef(); SetThingPulse(me, 0);").calls_per_second == 0
    # Only that of lamp 10; and below 0 it comes every frame.
    assert lamps("SetThingPulse(10, 0);").calls_per_second == pytest.approx(590)
    assert lamps("SetThingPulse(GetSenderRef(), -1);").calls_per_second == pytest.approx(60 * 50)


def two_scripts(
    first: Sequence[str], second: Sequence[str], values: str = "1", symbol: str = "cog other"
) -> list[Hotspot]:
    head = ["symbols", *(f"message {m}" for m in ("startup", "pulse", "timer", "activated", "user0", "user1"))]
    return hotspots(
        "World templates 4", "mark none type=ghost", "World things 90", "20: mark mark .5 .5 .5 0 0 0 0",
        "21: mark mark .5 1.5 .5 0 0 0 1", "World cogs 2", f"0: first.cog {values}", "1: second.cog 20 21",
        "== cog/first.cog", *head, symbol, "int i local", "end", "code", *first, "end",
        "== cog/second.cog", *head, "thing a", "thing b", "cog back=0 local", "end", "code", *second, "end",
    )  # fmt: skip


ASKED = [f"user0: {LOOK} return;", "user1: return;"]


def test_messages_are_followed_to_the_cog_that_a_value_names() -> None:
    tick = ["startup: SetPulse(0.1); return;", "pulse: SendMessage(other, user0); return;"]
    (found,) = two_scripts(tick, ASKED)
    assert (found.calls_per_second, found.more) == (pytest.approx(10), False)
    # To itself, which does not answer; to nobody; another message.
    assert [h.calls_per_second for h in two_scripts(tick, ASKED, "0")] == [0]
    assert [h.calls_per_second for h in two_scripts(tick, ASKED, "-1")] == [0]
    wrong = [line.replace("user0", "user1") for line in tick]
    assert [(h.calls_per_second, h.more) for h in two_scripts(wrong, ASKED)] == [(0, False)]


@pytest.mark.parametrize(("others", "more"), [
    ([], False), (["activated: return;"], False), (["activated: i = 0; return;"], True),
    (["activated: k[Rand()] = 0; return;"], True), (["timer: i = 0; return;"], False),
])  # fmt: skip
def test_a_counter_that_a_handler_in_between_can_set_back_is_told(others: list[str], more: bool) -> None:
    tick = ["startup: SetPulse(1); SetTimer(1); return;",
            "pulse: for (i = 0; i < 3; i = i + 1) SendMessage(other, user0); return;"]  # fmt: skip
    (found,) = two_scripts([*tick, *others], ASKED)
    assert (found.calls_per_second, found.more) == (3, more)


def test_messages_of_one_script_wake_loops_of_another() -> None:
    tick = ["startup: SetPulse(0.5); return;", "pulse: SendMessage(other, user1); return;"]
    loop = ["startup: call watch; return;", "user1: call watch; return;"]
    watch = ["watch: while (1) {", LOOK, "Sleep(0.25);", "} return;"]
    # 4 turns a second in either run, one more for each run, and one for each message that finds the other asleep.
    assert [h.calls_per_second for h in two_scripts(tick, [*loop, *watch])] == pytest.approx([4 + (4 + 2) + 2 * 2])
    # A handler from which the loop cannot be reached leaves its sleep as it is.
    beside = ["startup: call watch; return;", "user1: Sleep(1); return;", *watch]
    assert [h.calls_per_second for h in two_scripts(tick, beside)] == pytest.approx([4])


@pytest.mark.parametrize(("asks", "answers", "calls"), [
    ("startup: return;", "user0: Sleep(1); return;", 5),
    # The first script sends it in its own startup, and the second may be asleep when startup comes to it.
    ("startup: SendMessage(other, user0); return;", "user0: Sleep(1); return;", math.inf),
    ("startup: SendMessage(other, user0); return;", "user0: return;", 5),
    ("startup: SendMessage(other, user0); return;", "user0: call nap; return;", math.inf),
    ("startup: DamageThing(20, 1, 1, 20); return;", "activated: Sleep(1); return;", math.inf),
    ("startup: SendMessage(other, startup); return;", "user0: return;", math.inf),
    ("startup: SendMessage(GetSenderRef(), user0); return;", "user0: Sleep(1); return;", math.inf),
    ("startup: SendMessage(GetSenderRef(), user0); return;", "user0: return;", 5),
    # Later: on top of the loop.
    ("activated: SendMessage(other, user0); return;", "user0: Sleep(1); return;", 5),
    ("startup: SetPulse(1); return; pulse: SendMessage(other, user0); return;", "user0: Sleep(1); return;", 5),
    ("startup: SetPulse(1); return; pulse: SendMessage(other, startup); return;", "user0: return;", math.inf),
])  # fmt: skip
def test_a_label_that_the_loop_of_startup_calls(asks: str, answers: str, calls: float) -> None:
    loop = ["startup: while (1) {", LOOK, "call nap; } return;", answers, "nap: Sleep(0.2); return;"]
    assert [h.calls_per_second for h in two_scripts([asks], loop)] == pytest.approx([calls])


@pytest.mark.parametrize("target", ["GetSenderRef()", "GetMasterCog()", "GetThingClassCog(20)"])
def test_messages_to_a_cog_that_is_not_known_are_told(target: str) -> None:
    tick = ["startup: SetPulse(0.1); return;", f"pulse: SendMessage({target}, user0); return;"]
    (found,) = two_scripts(tick, ASKED)
    assert found.more
    assert [h.more for h in two_scripts([line.replace("user0", "user1") for line in tick], ASKED)] == [False]


@pytest.mark.parametrize("verb", ["SetThingClassCog(20, other)", "SetThingCaptureCog(20, other)"])
def test_a_script_that_a_thing_is_given_to_gets_messages_that_are_not_known(verb: str) -> None:
    for given, told in ((verb, True), (verb.replace("other", "-1"), False)):
        (found,) = two_scripts([f"activated: {given}; return;"], [f"pulse: {LOOK} return;"])
        assert found.more is told


@pytest.mark.parametrize(("answer", "more"), [("", False), ("call watch;", True)])
def test_a_message_that_is_not_known_wakes_what_its_handler_comes_to(answer: str, more: bool) -> None:
    start = ["startup: SendMessage(GetMasterCog(), user1); return;"]
    loop = ["startup: call watch; return;", f"user1: {answer} return;", "watch: while (1) {"]
    sleep = ["Sleep(0.25);", "} return;"]
    assert [h.more for h in two_scripts(start, [*loop, LOOK, *sleep])] == [more]
    # And what the loop sends on.
    asked = ["user0: if (HasLOS(i, i) == 1) return; return;"]
    assert [h.more for h in two_scripts([*start, *asked], [*loop, "SendMessage(back, user0);", *sleep])] == [more]


def test_what_is_not_known_is_passed_on() -> None:
    """The first script is woken by a message to nobody knows whom, and what it asks of the second is open too."""
    open_ = ["startup: SetPulse(1); return;", "pulse: SendMessage(GetMasterCog(), user1); return;"]
    ask = ["user1: SendMessage(other, user0); return;"]
    (found,) = two_scripts([*open_, *ask], ASKED)
    assert found.more
    # A pulse that it sets comes once an interval all the same.
    paced = ["user1: SetPulse(0.5); return;", "pulse: SendMessage(other, user0); SendMessage(GetMasterCog(), user1);",
             "return;"]  # fmt: skip
    (bounded,) = two_scripts(paced, ASKED)
    assert (bounded.more, bounded.calls_per_second) == (False, 2)


def test_a_list_of_things_in_view_that_others_can_begin_anew_is_told() -> None:
    def more(*others: str) -> bool:
        walking = walk("if (HasLOS(turret, victim) == 1) DamageThing(victim, 1, 1, turret);")
        at = walking.index("end") + 2
        script = [*walking[:1], "message damaged", *walking[1:at], *others, *walking[at:]]
        return next(h.more for h in guarded(3, *script) if h.site.verb.name == "haslos")

    assert not more()
    assert not more('damaged: Print("ow"); return;')
    assert more("damaged: FirstThingInView(turret, 90, 10, 0x404); return;")


def test_what_a_class_cog_captures_sends_it_pulses() -> None:
    lines = ["symbols", "message created", "message pulse", "end", "code",
             "created: CaptureThing(40); SetThingPulse(40, 0.5); return;",
             'pulse: if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) Print("x"); return;', "end"]  # fmt: skip
    (found,) = hotspots(*class_cog(lines, *things(1), "40: walkplayer walkplayer .2 .5 .5 0 0 0 0"))
    assert (found.calls_per_second, found.more) == (2, False)
    anything = [line.replace("CaptureThing(40)", "CaptureThing(GetSourceRef())") for line in lines]
    (found,) = hotspots(*class_cog(anything, *things(1), "40: walkplayer walkplayer .2 .5 .5 0 0 0 0"))
    assert found.more


def test_what_the_player_causes_is_named() -> None:
    ask = ["activated: SendMessage(other, user0); return;"]
    (found,) = two_scripts(ask, ASKED)
    assert (found.calls_per_second, found.causes) == (0, ("activated of cog 0 (first.cog)", "user0"))
    (alone,) = hotspots(*placed_cog("20 21", *looking(f"activated: {LOOK} return;")))
    assert alone.causes == ("activated",)
    # A pulse that it starts lasts: more of the same starts no more of it.
    (pulse,) = hotspots(*placed_cog("20 21", *looking("activated: SetPulse(1); return;", f"pulse: {LOOK} return;")))
    assert (pulse.causes, pulse.calls_per_second) == ((), 1)


@pytest.mark.parametrize("how", [
    "box none type=actor explode=lamp", "box none type=weapon creatething=lamp", "box none type=actor weapon=lamp",
])  # fmt: skip
def test_a_class_cog_of_things_to_come_is_listed(how: str) -> None:
    templates = ["World templates 5", "lamp none type=cog cog=lamp.cog", how]
    (found,) = hotspots(
        *templates, "World things 90", PLAYER, "40: box box .5 .5 .5 0 0 0 0", "== cog/lamp.cog", *SWING_LAMP
    )
    assert (found.runner.title, found.more) == ("class cog lamp.cog on 0 things and others", True)
    assert found.calls_per_second == 0


def test_a_class_cog_that_a_script_creates_is_listed_and_one_that_nothing_creates_is_not() -> None:
    def level(code: str) -> list[Hotspot]:
        return hotspots(
            "World templates 5", "lamp none type=cog cog=lamp.cog", "mark none type=ghost", "World things 90", PLAYER,
            "20: mark mark .5 .5 .5 0 0 0 0", "World cogs 1", "0: make.cog 20",
            "== cog/make.cog", "symbols", "message activated", "thing a", "template t=lamp local", "end", "code",
            f"activated: {code} return;", "end", "== cog/lamp.cog", *SWING_LAMP,
        )  # fmt: skip

    for code in ("CreateThing(t, a);", 'CreateThing(LoadTemplate("lamp"), a);'):
        assert [h.runner.title for h in level(code)] == ["class cog lamp.cog on 0 things and others"]
    (plain,) = hotspots(*class_cog(SWING_LAMP, *things(2)))
    assert not plain.more
    unmade = ["World templates 4", "lamp none type=cog cog=lamp.cog", "World things 90", PLAYER]
    assert hotspots(*unmade, "== cog/lamp.cog", *SWING_LAMP) == []


def test_a_thing_that_two_symbols_name_sends_its_pulses_twice() -> None:
    body = ["startup: SetThingPulse(lamp, 0.2); return;", f"pulse: {LOOK} return;"]
    script = looking(
        *body, symbols=("thing lamp mask=0x405", "thing twin mask=0x405", "thing a nolink", "thing b nolink")
    )
    more = ["30: mark mark .2 .5 .5 0 0 0 0"]
    (found,) = hotspots(*placed_cog("30 30 20 21", *script, more=more))
    assert found.calls_per_second == pytest.approx(10)


def test_the_games_own_scripts_are_listed_where_they_are_at_hand(tmp_path: Path) -> None:
    level, game = tmp_path / "mod/jkl/test.jkl", tmp_path / "game"
    for folder in (level.parent, game / "jkl", game / "cog", game / "misc"):
        folder.mkdir(parents=True)
    fragment = ["World templates 4", "lamp none type=cog cog=lamp.cog", "World things 90", PLAYER, *things(1)]
    level.write_text(two_rooms(*fragment))
    static = [
        "SECTION: JK", "SECTION: COGSCRIPTS", "World scripts 1", "0: watch.cog", "end", "SECTION: COGS", "World cogs 1",
        "0: watch.cog 0.5", "end", "SECTION: TEMPLATES", "World templates 1", "torch none type=cog cog=torch.cog",
        "end",
    ]  # fmt: skip
    (game / "jkl/static.jkl").write_text("\n".join(static))
    (game / "misc/items.dat").write_text("binoculars 40 0 1 0x12 cog=look.cog\nend\n")
    look = "if (HasLOS(GetLocalPlayerThing(), 10) == 1) Print(1);"
    texts = {
        "watch": f"symbols\nmessage startup\nmessage pulse\nflex rate\nend\ncode\n"
                 f"startup: SetPulse(rate); return;\npulse: {look} return;\nend\n",
        "look": f"symbols\nmessage activated\nend\ncode\nactivated: {look} return;\nend\n",
    }  # fmt: skip
    for name, text in texts.items():
        (game / f"cog/{name}.cog").write_text(text)
    assert LevelFacts(load(str(level))).hotspots == []
    found = {h.runner.title: h for h in LevelFacts(load(str(level), [str(game)])).hotspots}
    assert found["watch.cog of static.jkl"].calls_per_second == pytest.approx(2)
    assert found["look.cog of items.dat"].causes == ("activated",)
    assert len(found) == 2


STARE = looking("startup: SetPulse(1.0); return;", f"pulse: {LOOK} return;")


def test_a_level_without_tests_of_sight_has_none() -> None:
    assert hotspots(*placed_cog("20 21", *looking('startup: Print("x"); return;'))) == []


def asks(text: bytes) -> bool:
    """Whether a script's text calls a verb of sight outside comments, by a search apart from the code under test."""
    code = re.sub(r"(#|//).*", "", text.decode("latin-1"))
    return re.search(r"\b(haslos|firstthinginview|firstthingincone)\s*\(", code, re.IGNORECASE) is not None


def test_the_scripts_of_the_test_level_that_ask_for_sight_are_listed_and_no_others() -> None:
    pack = str(ROOT / "fixtures/smithdev/smithdev.gob")
    scripts = {m.name.rpartition("/")[2].lower(): bytes(m.read().data) for m in discover(pack, [], ("cog",))}
    facts = LevelFacts(load(f"{pack}!jkl/smithdev.jkl"))
    running = {runner.name for runner in facts.runners}
    asking = {name for name, text in scripts.items() if asks(text) and name in running}
    assert len(asking) >= 2
    assert {spot.runner.name for spot in facts.hotspots} == asking
    # 16 lamps, each with a pulse of 0.05 s.
    (lamps,) = [spot for spot in facts.hotspots if spot.runner.name == "sd_swinglamp.cog"]
    assert lamps.calls_per_second == pytest.approx(16 * 20)


def test_scripts_of_the_corpus_that_ask_for_sight_are_listed_and_no_others() -> None:
    """Against a search of the text for the verbs, apart from the code under test."""
    if not CORPUS.exists():
        pytest.skip("no corpus")
    asking = {name.rpartition("/")[2].lower() for name, data in corpus_scripts() if asks(data)}
    listed = set()
    for pack in sorted((CORPUS / "gob").glob("*")):
        for member in discover(str(pack), [], ("jkl",)):
            facts = LevelFacts(load(member.path))
            placed = {runner.name for runner in facts.runners}
            listed |= {spot.runner.name for spot in facts.hotspots}
            assert {n for n in placed if n in asking} == {spot.runner.name for spot in facts.hotspots}
    assert listed <= asking
