"""Where players come to, and what parts of a level they do not: the two rooms, their one adjoin, and scripts.

The player starts in sector 0; surface 3 leads to sector 1, surface 8 back. Thing 1 is a ghost in sector 1.
"""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from jktools.facts import LevelFacts
from jktools.facts.travel import reached
from tests.support.levels import level_with_files

SYMBOLS = ("message activated", "thing a", "thing b", "sector c", "surface d", "int e", "vector f")
VALUES = "0 1 1 3 1 (.5/1.5/.5)"


def adjoins(there: str, back: str) -> list[str]:
    return ["World adjoins 2", f"0: {there} 1 1", f"1: {back} 0 1"]


SHUT = adjoins("0x5", "0x5")
ALONE = ["World cogs 0", "- 0: door.cog 3 -1 wind.wav"]


def visited(*fragment: str, game: str = "jk") -> list[int] | None:
    with level_with_files(*fragment, *(() if "== cog/x.cog" in fragment else ("== cog/none.cog",)), game=game) as level:
        found = LevelFacts(level).visited
    return None if found is None else sorted(found)


def scripted(
    code: str, *more: str, values: str = VALUES, symbols: Sequence[str] = SYMBOLS, game: str = "jk"
) -> list[int] | None:
    text = ["== cog/x.cog", "symbols", *symbols, "end", "code", f"activated: {code}; return;", "end"]
    return visited(*SHUT, *more, "World cogs 1", "- 0: door.cog 3 -1 wind.wav", f"0: x.cog {values}", *text, game=game)


@pytest.mark.parametrize(("there", "back", "sectors"), [
    ("0x7", "0x7", [0, 1]), ("0x5", "0x5", [0]),
    ("0x7", "0x5", [0, 1]),  # one way in
    ("0x5", "0x7", [0]),  # one way out
    ("0x17", "0x7", [0]),  # holds players
    ("0x7", "0x17", [0, 1]),
])  # fmt: skip
def test_each_side_of_an_adjoin_has_its_own_way(there: str, back: str, sectors: list[int]) -> None:
    assert visited(*adjoins(there, back), *ALONE) == sectors


@pytest.mark.parametrize(("code", "sectors"), [
    ("SetAdjoinFlags(d, 2)", [0, 1]),
    ("SetAdjoinFlags(d, 1)", [0]),
    ("SectorAdjoins(c, 1)", [0, 1]),
    ("SetSectorLight(c, 1, 0)", [0]),  # names sector 1, and takes nobody there
    ("PlaySoundThing(0, b, 1, 1, 1, 0)", [0]),
    ("e = e + 1", [0]),  # an int value of 1 is no sector
    ("TeleportThing(a, b)", [0, 1]),
    ("TeleportThing(b, a)", [0]),
    ("TeleportThing(GetSourceRef(), b)", [0, 1]),
    ("TeleportThing(a, GetLocalPlayerThing())", [0]),
    ("TeleportThing(a, FirstThingInSector(c))", None),
    ("e = FirstThingInSector(c); TeleportThing(b, e)", [0]),
    ("e = FirstThingInSector(c); TeleportThing(a, e)", None),
    ("JumpToFrame(b, 0, c)", [0, 1]),
    ("JumpToFrame(b, 0, 1)", [0, 1]),
    ("JumpToFrame(b, 0, Rand() * 2)", [0, 1]),  # the line holds sector 1
    ("SetThingPos(a, f)", None),
    ("SetThingPos(GetSourceRef(), f)", None),
    ("SetThingPos(b, f)", [0]),  # the ghost
])  # fmt: skip
def test_scripts_open_and_send(code: str, sectors: list[int] | None) -> None:
    assert scripted(code) == sectors


def test_a_script_may_let_players_through() -> None:
    held = adjoins("0x17", "0x7")
    assert scripted("ClearAdjoinFlags(d, 0x10)", *held) == [0, 1]
    assert scripted("ClearAdjoinFlags(d, 0x2)", *held) == [0]
    assert scripted("SetAdjoinFlags(d, 0x2)", *held) == [0]


def test_mysteries_of_the_sith_sets_places_with_a_sector() -> None:
    assert scripted("SetThingPosEx(a, f, c)", game="mots") is None
    assert scripted("SetThingPosEx(b, f, c)", game="mots") == [0]


def test_a_goal_that_moves_may_be_anywhere() -> None:
    guard = ["World templates 4", "guard none type=actor move=physics", "World things 4"]
    assert scripted("TeleportThing(a, b)", *guard, "2: guard guard .5 .5 .5 0 0 0 0", values="0 2") is None


def test_code_that_cannot_run_sends_nobody() -> None:
    assert scripted("if (e == 2) TeleportThing(a, b)") == [0]


@pytest.mark.parametrize(
    ("values", "sectors"), [("3", [0, 1]), ("1", [0, 1]), ("wind.wav", [0]), ("9 wind.wav", [0, 1])]
)
def test_of_an_unread_script_each_number_counts(values: str, sectors: list[int]) -> None:
    """As a sector, a thing, a surface, and a surface that may open: 9 is one of sector 1."""
    assert visited(*SHUT, "World cogs 1", f"0: door.cog {values}") == sectors


def test_a_number_of_an_unread_script_may_mean_a_thing() -> None:
    """Surface 5 is of sector 0, and there is no sector 5; thing 5 stands in sector 1."""
    goal = ["World things 9", "5: ghost ghost .5 1.5 .5 0 0 0 1"]
    assert visited(*SHUT, *goal, "World cogs 1", "0: door.cog 5") == [0, 1]
    assert visited(*SHUT, "World cogs 1", "0: door.cog 5") == [0]


def test_a_class_cog_sends_whoever_touches_its_thing() -> None:
    gate = ["World templates 4", "gate none type=cog cog=x.cog", "World things 4", "2: gate gate .5 .5 .5 0 0 0 0"]
    goal = ["3: gate gate .5 1.5 .5 0 0 0 1"]
    text = ["== cog/x.cog", "symbols", "message touched", "end", "code"]
    sends = ["touched: TeleportThing(GetSourceRef(), GetSenderRef()); return;", "end"]
    assert visited(*SHUT, *ALONE, *gate, *text, *sends) == [0]
    assert visited(*SHUT, *ALONE, *gate, *goal, *text, *sends) == [0, 1]


def test_a_lift_carries_from_place_to_place() -> None:
    lift = ["World templates 4", "lift none type=cog move=path", "World things 4"]
    frames = "numframes=2 frame=(.5/.5/.5:0/0/0) frame=(.5/1.5/.5:0/0/0)"
    assert visited(*SHUT, *ALONE, *lift, f"2: lift lift .5 .5 .5 0 0 0 0 {frames}") == [0, 1]
    near = frames.replace("1.5", ".6")
    assert visited(*SHUT, *ALONE, *lift, f"2: lift lift .5 .5 .5 0 0 0 0 {near}") == [0]


def test_a_level_without_a_start_tells_nothing() -> None:
    assert visited(*SHUT, *ALONE, "World things 3", "0: crate crate .5 .5 .2 0 0 0 0") is None


def test_lifts_are_boarded_where_one_comes_to() -> None:
    # 0 -> 1, lift of 1 and 3, 3 -> 4; nothing leads to 2 or to the lift of 2 and 5.
    ways: list[list[int]] = [[1], [], [0], [4], [], []]
    assert reached(ways, [0], [frozenset({1, 3}), frozenset({2, 5})]) == {0, 1, 3, 4}
    assert reached([[], [], []], [2], [frozenset({0, 2})]) == {0, 2}


# ---- islands

SHIELD = ["World templates 4", "shield none type=item", "World things 4", "2: shield shield .5 1.5 .2 0 0 0 1"]


def parts(*fragment: str) -> list[tuple[tuple[int, ...], list[int]]]:
    with level_with_files(*fragment, *(() if "== cog/x.cog" in fragment else ("== cog/none.cog",))) as level:
        return [(island.sectors, [t.number for t in island.items]) for island in LevelFacts(level).islands]


def test_what_nobody_comes_to_is_an_island() -> None:
    assert parts(*SHUT, *ALONE, *SHIELD) == [((1,), [2])]
    assert parts(*adjoins("0x5", "0x7"), *ALONE, *SHIELD) == [((1,), [2])]
    assert parts(*adjoins("0x7", "0x5"), *ALONE, *SHIELD) == []
    assert parts(*SHUT, *ALONE, *SHIELD, "0: crate crate .5 .5 .2 0 0 0 0") == []


@pytest.mark.parametrize(("symbol", "items"), [("int a", [2]), ("sound a", [2]), ("thing a", [])])
def test_an_item_that_a_script_names_may_be_handed_out(symbol: str, items: list[int]) -> None:
    text = ["== cog/x.cog", "symbols", "message activated", symbol, "end", "code", "activated: return;", "end"]
    cog = ["World cogs 1", "- 0: door.cog 3 -1 wind.wav", "0: x.cog 2"]
    assert parts(*SHUT, *SHIELD, *cog, *text) == [((1,), items)]
