"""Hotspots: calls a second of placed scripts, against figures worked out by hand."""

from __future__ import annotations

import math

import pytest

from jktools.facts import LevelFacts
from jktools.facts.hotspots import Hotspot
from jktools.linter import find_rule, lint
from tests.support.hotspots import (
    LOOK,
    SWING_LAMP,
    class_cog,
    hotspots,
    looking,
    placed_cog,
    things,
)
from tests.support.levels import level_with_files


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
