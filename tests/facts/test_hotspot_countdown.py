"""Hotspots: pulses that count themselves down, against figures worked out by hand (tests/support/hotspots.py)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest

from tests.support.hotspots import LOOK, SWING_LAMP, class_cog, hotspots, looking, placed_cog, things

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
