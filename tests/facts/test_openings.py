"""Which surfaces the placed COGs can make see-through: those that the verbs of their scripts can be called on."""

from __future__ import annotations

import pytest

from jktools.facts import LevelFacts
from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.openings import VISIBLE, opened_by_cogs
from jktools.session import load
from tests.support.levels import CORPUS, corpus_files, level_with_files

DOOR = [3, 8]
"""The two surfaces of the one adjoin."""
FIRST, SECOND = [0, 1, 2, 3, 4, 5, 8], [3, 6, 7, 8, 9, 10, 11]
"""All surfaces of each sector, and the other side of the adjoin."""
SYMBOLS = ["message startup", "message timer", "surface a", "surface b", "sector c", "int d"]


def opened(code: str, values: str, *symbols: str) -> list[int]:
    text = ["== cog/x.cog", "symbols", *(symbols or SYMBOLS), "end", "code", *code.split("\n"), "end"]
    with level_with_files("World cogs 1", f"0: x.cog {values}", *text) as level:
        return LevelFacts(level).openable_surfaces.tolist()


@pytest.mark.parametrize(("call", "surfaces"), [
    ("SetAdjoinFlags(a, 1)", DOOR),
    ("SetAdjoinFlags(b, 7)", [1]),
    ("SetAdjoinFlags(a, 6)", []),  # not the visible flag
    ("SetAdjoinFlags(a, d)", []),  # 0 by the line
    ("ClearAdjoinFlags(a, 1)", []),
    ("SetSurfaceFlags(a, 1)", []),
    ("SectorAdjoins(c, 1)", SECOND),
    ("SetSectorAdjoins(c, 1)", SECOND),
    ("SectorAdjoins(c, 0)", []),
    ("SectorAdjoins(0, 1)", FIRST),
    ("SetAdjoinFlags(5, 1)", [5]),
    ("SetAdjoinFlags(500, 1)", []),
    ("SetAdjoinFlags(-1, 1)", []),
    ("SetAdjoinFlags(a, Rand() * 8)", DOOR),  # flags that nobody knows
])  # fmt: skip
def test_verbs_that_open(call: str, surfaces: list[int]) -> None:
    assert opened(f"startup: {call}; return;", "3 1 1 0") == surfaces


@pytest.mark.parametrize(("flags", "sight", "things"), [(1, True, False), (2, False, True), (3, True, True)])
def test_sight_and_things_have_flags_of_their_own(flags: int, sight: bool, things: bool) -> None:
    code = ["startup:", f"SetAdjoinFlags(a, {flags});", "return;"]
    text = ["== cog/x.cog", "symbols", *SYMBOLS, "end", "code", *code, "end"]
    with level_with_files("World cogs 1", "0: x.cog 3", *text) as level:
        facts = LevelFacts(level)
        assert facts.openable_surfaces.tolist() == (DOOR if sight else [])
        assert facts.enterable_surfaces.tolist() == (DOOR if things else [])


def test_one_of_several_values() -> None:
    """What is not one number is one of the line's, within its bounds: 1, 3 and 1 are, 40 is not."""
    code = "startup: d = a; return;\ntimer: SetAdjoinFlags(a[Rand() * 2], 1); return;"
    assert opened(code, "3 1 1 40") == [1, 3, 8]


def test_code_that_never_runs_opens_nothing() -> None:
    assert opened("startup: if (d) SetAdjoinFlags(a, 1); return;", "3 1 1 0") == []
    assert opened("startup: return;\nSetAdjoinFlags(a, 1);", "3 1 1 0") == []
    assert opened("startup: if (d) SetAdjoinFlags(a, 1); return;", "3 1 1 1") == DOOR


def test_an_assignment_brings_the_value_of_another_symbol() -> None:
    """The symbol is 2 at first and 3 later; 1 is on the line, but never its value."""
    assert opened("startup: d = a; return;\ntimer: SetAdjoinFlags(d, 1); return;", "3 1 1 2") == [2, 3, 8]


def test_a_script_that_the_engine_refuses_opens_nothing() -> None:
    assert opened("startup: SetAdjoinFlags(a, 1); ) ;", "3 1 1 0") == []


def test_a_script_that_is_not_at_hand_opens_all_that_its_values_name() -> None:
    with level_with_files("World cogs 1", "0: other.cog 1 door", "== cog/x.cog", "symbols", "end") as level:
        assert LevelFacts(level).openable_surfaces.tolist() == sorted({1, *SECOND})


@pytest.mark.skipif(not list(corpus_files()), reason="the corpus of real mods is not at hand")
def test_a_script_that_cannot_be_read_only_adds() -> None:
    """Against the same level with none of its scripts at hand, where all that a value can name counts."""
    path = next(CORPUS.glob("gob/masspack*"))
    for name in ("azulcity", "lop_sabers"):
        level = load(f"{path}!jkl/{name}.jkl")
        unread = opened_by_cogs(level, [InstanceFacts(cog, None, -1) for cog in level.cogs], VISIBLE)
        read = LevelFacts(level).openable_surfaces
        assert set(read.tolist()) <= set(unread.tolist())
        assert 0 < len(read) < len(unread)
