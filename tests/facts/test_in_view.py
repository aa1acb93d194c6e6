"""What can be in view, in the two rooms and by hand."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from jktools.facts import LevelFacts
from jktools.facts.in_view import lights_in_view, sectors_in_view, translucent_in_view
from jktools.linter import find_rule, lint
from tests.support.levels import level_of, two_rooms

APART = ("World adjoins 2", "0: 0x6 1 1", "1: 0x6 0 1", "World cogs 0", "- 0: door.cog 3 -1 wind.wav")


def facts(*lines: str) -> LevelFacts:
    return LevelFacts(level_of(two_rooms(*lines)))


def test_rooms_see_each_other_through_the_adjoin_only() -> None:
    both, apart = facts(), facts(*APART)
    assert sectors_in_view(both.level, both.visibility).tolist() == [2, 2]
    assert sectors_in_view(apart.level, apart.visibility).tolist() == [1, 1]


def test_translucent_surfaces_count_where_they_are_drawn() -> None:
    glass = ("World surfaces 12", "9: 0 0x4 0x2 4 3 1 -1 0 4 9,0 8,1 10,2 11,3 1 1 1 1")
    undrawn = ("World surfaces 12", "9: 0 0x4 0x2 0 3 1 -1 0 4 9,0 8,1 10,2 11,3 1 1 1 1")
    for lines, counts in ((glass, [1, 1]), (undrawn, [0, 0]), ((*glass, *APART), [0, 1])):
        known = facts(*lines)
        assert translucent_in_view(known.level, known.visibility).tolist() == counts


def lamps(count: int) -> Sequence[str]:
    things = (f"{i}: lamp lamp .5 1.5 .5 0 0 0 1" for i in range(5, 5 + count))
    return ("World templates 4", "lamp none type=cog light=1", "World things 90", *things)


def test_lights_count_in_the_rooms_that_see_them() -> None:
    known = facts(*lamps(3), *APART)
    assert lights_in_view(known.level, known.visibility).tolist() == [0, 3]


@pytest.mark.parametrize(("count", "told"), [(32, False), (33, True)])
def test_the_33rd_light_is_one_too_many(count: int, told: bool) -> None:
    found = lint(level_of(two_rooms(*lamps(count), *APART)), [find_rule("JK832")])
    assert [d.message for d in found] == [
        "up to 33 lights can be in view from sector 1, the worst of 1, but the engine draws 32"
    ] * told


def test_a_file_without_sectors_has_nothing_in_view() -> None:
    level = level_of("SECTION: TEMPLATES\nWorld templates 1\nghost none type=ghost\nend\n")
    codes = [
        each.code.id
        for code in ("JK830", "JK831", "JK832", "JK226", "JK227")
        for each in lint(level, [find_rule(code)])
    ]
    assert codes == []
