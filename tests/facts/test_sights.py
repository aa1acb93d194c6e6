"""Many sight queries at once: the verdicts of one at a time."""

from __future__ import annotations

import numpy as np
import pytest

import jktools
from jktools.facts.level import LevelFacts
from jktools.facts.scene import Verdict
from jktools.facts.sightline import EndpointError
from jktools.facts.sights import sight
from jktools.session import load
from tests.geometry.test_engine_scene import START, rooms
from tests.support.levels import CORPUS, level_of


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize(("name", "count"), [("azulcity", 150), ("wayrest", 150), ("lop_sabers", 150)])
def test_real_levels(name: str, count: int) -> None:
    level = load(f"{CORPUS}/gob/masspack.gob!jkl/{name}.jkl")
    rng = np.random.default_rng(12)
    things = [t for t in level.things if t.dropped is None and level.sound_sectors[t.sector_index]]
    near = {
        t.number: sorted(things, key=lambda o: float(np.linalg.norm(o.position - t.position)))[1:12] for t in things
    }
    pairs = []
    for i in rng.integers(len(things), size=count):
        a = things[i]
        b = near[a.number][int(rng.integers(11))]
        pairs.append((a.number, b.number if rng.random() < 0.7 else b.position.astype(float).tolist()))
    pairs = [(a, b) for a, b in pairs if isinstance(b, int) or LevelFacts.of(level).mesh.locate([b])[0] >= 0]
    one_by_one = [sight(level, a, b).verdict for a, b in pairs]
    assert jktools.sights(level, pairs) == one_by_one
    assert jktools.sights(level, pairs, things=False) == [sight(level, a, b, things=False).verdict for a, b in pairs]
    assert len(set(one_by_one)) == 3, "visible, not visible and varies"
    some = pairs[:15]
    by_engine = [sight(level, a, b, engine="openjkdf2").verdict for a, b in some]
    assert jktools.sights(level, some, engine="openjkdf2") == by_engine


def test_a_body_that_reaches_out_of_a_wall_and_null_things() -> None:
    level = level_of(
        rooms(
            templates=("big none type=actor collide=1 size=.2",),
            things=(START, "1: big b .5 2.1 .5 0 0 0 1", "2: big c .5 2.5 .5 0 0 0 1", "3: post p .5 .6 .5 0 0 0 0"),
        )
    )
    pairs = [(0, 1), (0, 2), (0, 3), ((0.5, 0.9, 0.5), 1), (3, 1)]
    assert jktools.sights(level, pairs) == [sight(level, a, b).verdict for a, b in pairs]
    assert jktools.sights(level, pairs)[3:] == [Verdict.VISIBLE, Verdict.VISIBLE]
    assert jktools.sights(level, [(0, 9), (0, 3)], engine="openjkdf2") == [Verdict.NULL_THING, Verdict.VISIBLE]
    with pytest.raises(EndpointError, match="pair 1: the level has no thing with number 9"):
        jktools.sights(level, [(0, 1), (0, 9)])
    assert jktools.sights(level, []) == []
