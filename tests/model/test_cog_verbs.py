from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from jktools.model.cog.messages import messages_of
from jktools.model.cog.verbs import KNOWN_TO, all_verbs, verb_from, verbs_of
from tests.support.levels import ROOT

FACTS = ROOT.parent / "shared/facts"
ROWS = FACTS / "cog_verbs.jsonl"


@pytest.mark.skipif(not ROWS.exists(), reason="the facts are not at hand")
def test_every_verb_of_the_facts_is_here_with_its_arguments() -> None:
    rows = [json.loads(line) for line in ROWS.read_text().splitlines()]
    assert len(rows) == len(all_verbs()) == 598
    for row in rows:
        verb = all_verbs()[row["name"]]
        assert [a.kind for a in verb.args] == [a["type"] for a in row["args"]], verb.name
        assert verb.returns == row["returns"], verb.name
        assert row.get(verb.game), verb.name


@pytest.mark.skipif(not FACTS.exists(), reason="the facts are not at hand")
def test_where_sources_disagree_the_engine_wins() -> None:
    """The first table of cog_verb_disagreements.md: `| verb | `(args) -> result` | ...`."""
    text = (FACTS / "cog_verb_disagreements.md").read_text()
    rows = re.findall(r"^\| (\w+) \| `\(([^)]*)\) -> (\w+)` \|", text, re.MULTILINE)
    assert len(rows) > 40
    for name, args, returns in rows:
        verb = all_verbs()[name]
        assert [a.kind for a in verb.args] == [kind.strip() for kind in args.split(",") if kind.strip()], name
        assert verb.returns == returns, name


def test_what_the_table_says_of_single_verbs() -> None:
    verbs = all_verbs()
    assert verbs["sleep"].sleeps and verbs["waitforstop"].sleeps
    assert verbs["haslos"].sight == "ray" and verbs["firstthinginview"].sight == "flood"
    assert {v.sight for v in (verbs["isaitargetinsight"], verbs["thingviewdot"])} == {"cached"}
    assert [(a.least, a.greatest) for a in verbs["getparam"].args] == [(0, 3)]
    assert [a.greatest for a in verbs["newcoloreffect"].args[3:6]] == [2, 2, 2]
    assert verbs["setthingthrust"].pushes == "maybe" and verbs["iscrouching"].pushes == "twice"
    assert verbs["haslos"].signature == "haslos(thing from_thing, thing to_thing) -> int"
    assert "thinglight" in verbs["setthinglight"].same_as


def test_a_verb_that_gives_nothing_is_never_called_pure() -> None:
    assert not [v.name for v in all_verbs().values() if v.pure and not v.gives]


def test_games_share_what_jedi_knight_has() -> None:
    jk, mots = verbs_of("jk"), verbs_of("mots")
    assert set(jk) < set(mots)
    assert "worldflash" in mots and "worldflash" not in jk
    assert not any(v.game in ("openjkdf2", "droidworks") for v in mots.values())
    assert set(KNOWN_TO) == {"jk", "mots"}


def test_messages_of_the_games() -> None:
    jk, mots = messages_of("jk"), messages_of("mots")
    assert jk["activate"].id == jk["activated"].id == 1
    assert (jk["user0"].id, jk["trigger"].id, jk["aievent"].id) == (27, 40, 24)
    assert "escaped" not in jk and mots["exitbubble"].id == 46


def test_a_verb_of_the_user_may_run_handlers() -> None:
    verb = verb_from("JackLogVel", ("thing",), "void")
    assert (verb.name, verb.game, verb.delivers, verb.gives) == ("jacklogvel", "user", True, False)


def test_the_table_is_one_verb_a_line_in_order() -> None:
    lines = Path(ROOT, "jktools/model/cog/verbs.jsonl").read_text("ascii").splitlines()
    names = [json.loads(line)["name"] for line in lines]
    assert names == sorted(names)
