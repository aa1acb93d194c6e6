"""Hotspots of loops over what is in view: turns and counted work, against figures worked out by hand."""

from __future__ import annotations

import math

import pytest

from tests.support.hotspots import (
    guarded,
    view_loop,
    walk,
)

LOOK_AT_IT = 'if (HasLOS(turret, victim) == 1) Print("seen");'


def test_a_loop_over_what_is_in_view_turns_once_for_each_thing_of_the_type() -> None:
    by_verb = {h.site.verb.name: h for h in guarded(3, *view_loop())}
    # 2 pulses a second; the level has 3 guards and 1 player.
    assert by_verb["firstthinginview"].calls_per_second == pytest.approx(2)
    assert by_verb["haslos"].calls_per_second == pytest.approx(8)
    assert by_verb["haslos"].per_run == {"pulse": 4}


def test_the_engine_keeps_no_more_than_32_things_in_view() -> None:
    by_verb = {h.site.verb.name: h for h in guarded(45, *view_loop())}
    assert by_verb["haslos"].per_run == {"pulse": 32}


@pytest.mark.parametrize(("body", "most"), [
    (['if (HasLOS(turret, turret) == 1) Print("seen");'], 4),  # once a turn, whatever it looks at
    (["if (HasLOS(turret, victim) == 1) DamageThing(victim, 1, 1, turret);"], 4),
    (["if (HasLOS(turret, victim) == 1) victim = FirstThingInView(turret, 90, 10, 0x404);"], math.inf),
    (['if (HasLOS(turret, victim) == 1) Print("seen");', "FirstThingInView(turret, 90, 10, 0x404);"], math.inf),
])  # fmt: skip
def test_what_ends_a_loop_over_things_in_view(body: list[str], most: float) -> None:
    by_verb = {h.site.verb.name: h for h in guarded(3, *walk(*body))}
    assert by_verb["haslos"].per_run == {"pulse": most}


@pytest.mark.parametrize(("body", "most"), [
    (["for (i=0; i<5; i=i+1) {", LOOK_AT_IT, "}"], 20),  # 4 things in view, 5 looks at each
    (["call look;", "call look;", "call look;"], 12),  # 4 things in view, 3 looks at each
    (["i = i;", "}", "for (i=0; i<100; i=i+1) {", LOOK_AT_IT], 100),  # beside the walk
])  # fmt: skip
def test_what_a_turn_of_a_walk_does_more_than_once_counts_as_often(body: list[str], most: int) -> None:
    script = walk(*body)
    script[-1:] = [f"look: {LOOK_AT_IT}", "return;", "end"]
    script.insert(1, "int i local")
    by_verb = {h.site.verb.name: h for h in guarded(3, *script)}
    assert by_verb["haslos"].per_run == {"pulse": most}
    assert by_verb["haslos"].calls_per_second == pytest.approx(2 * most)


def test_a_walk_through_a_list_that_another_handler_began_may_take_all_of_it() -> None:
    script = ["symbols", "message activated", "message pulse", "message startup", "thing turret", "thing victim local",
              "end", "code", "startup: SetPulse(0.5); return;",
              "activated: FirstThingInView(turret, 90, 10, 0x4); return;",
              f"pulse: victim = turret; while (victim != -1) {{ {LOOK_AT_IT} victim = NextThingInView(); }} return;",
              "end"]  # fmt: skip
    by_verb = {h.site.verb.name: h for h in guarded(3, *script)}
    assert by_verb["haslos"].per_run == {"pulse": 32}


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


def test_a_list_of_things_in_view_that_others_can_begin_anew_is_told() -> None:
    def more(*others: str) -> bool:
        walking = walk("if (HasLOS(turret, victim) == 1) DamageThing(victim, 1, 1, turret);")
        at = walking.index("end") + 2
        script = [*walking[:1], "message damaged", *walking[1:at], *others, *walking[at:]]
        return next(h.more for h in guarded(3, *script) if h.site.verb.name == "haslos")

    assert not more()
    assert not more('damaged: Print("ow"); return;')
    assert more("damaged: FirstThingInView(turret, 90, 10, 0x404); return;")
