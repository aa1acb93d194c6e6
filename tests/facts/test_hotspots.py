"""Hotspots: what runs where, and its counted work, against figures worked out by hand (tests/support/hotspots.py)."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from jktools.facts import LevelFacts
from jktools.facts.hotspots import Hotspot, Verdict
from jktools.session import discover, load
from tests.support.hotspots import (
    LOOK,
    PLAYER,
    SWING_LAMP,
    class_cog,
    hotspots,
    looking,
    placed_cog,
    things,
)
from tests.support.levels import CORPUS, ROOT, two_rooms
from tests.support.scripts import corpus_scripts


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


def test_what_a_class_cog_captures_sends_it_pulses() -> None:
    lines = ["symbols", "message created", "message pulse", "end", "code",
             "created: CaptureThing(40); SetThingPulse(40, 0.5); return;",
             'pulse: if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) Print("x"); return;', "end"]  # fmt: skip
    (found,) = hotspots(*class_cog(lines, *things(1), "40: walkplayer walkplayer .2 .5 .5 0 0 0 0"))
    assert (found.calls_per_second, found.more) == (2, False)
    anything = [line.replace("CaptureThing(40)", "CaptureThing(GetSourceRef())") for line in lines]
    (found,) = hotspots(*class_cog(anything, *things(1), "40: walkplayer walkplayer .2 .5 .5 0 0 0 0"))
    assert found.more


def test_a_class_cog_that_captures_the_player_hears_the_pulse_that_another_script_gives_the_player() -> None:
    box = ["symbols", "message created", "message pulse", "end", "code", "created: CaptureThing(0); return;",
           'pulse: if (HasLOS(0, 10) == 1) Print("x"); return;', "end"]  # fmt: skip
    tick = ["World cogs 1", "0: tick.cog", "== cog/tick.cog", "symbols", "message startup", "end", "code",
            "startup: SetThingPulse(GetLocalPlayerThing(), 0.1); return;", "end"]  # fmt: skip
    lines = class_cog(box, *things(1))
    at = lines.index("== cog/lamp.cog")
    (found,) = hotspots(*lines[:at], *tick, *lines[at:])
    assert found.calls_per_second == pytest.approx(10)


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
