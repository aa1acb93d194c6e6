"""What HasLOS of the decompiled engine answers over a level, beside the research document: one test a rule."""

from __future__ import annotations

import numpy as np
import pytest

from fixtures.rooms import Level as Builder
from jktools.engine.profile import Engine
from jktools.facts.level import LevelFacts
from jktools.facts.scene import Scene, Verdict, tell
from jktools.facts.sightline import EndpointError
from jktools.facts.sights import sight
from jktools.geometry.engine_sight import Cut, SightFaces, engine_way
from jktools.model import Level
from jktools.session import load
from tests.support.levels import CORPUS, level_of, level_with_files, two_rooms

SEEN, HIDDEN, VARIES = Verdict.VISIBLE, Verdict.NOT_VISIBLE, Verdict.VARIES
NO_COGS = ("World cogs 1", "0: door.cog 99 -1 wind.wav")
START = "0: ghost a .5 .2 .5 0 0 0 0"
FAR_WALL = "9: 0 0x4 0x4 4 3 1 -1 0 4 9,0 8,1 10,2 11,3 1 1 1 1"
"""The wall of the two rooms at y = 2."""
PLATE = """\
== 3do/plate.3do
SECTION: HEADER
3DO 2.1
SECTION: MODELRESOURCE
MATERIALS 0
SECTION: GEOMETRYDEF
RADIUS 1
INSERT OFFSET 0 0 0
GEOSETS 1
GEOSET 0
MESHES 1
MESH 0
NAME plate
RADIUS 1
GEOMETRYMODE 4
LIGHTINGMODE 3
TEXTUREMODE 1
VERTICES 4
0: -.4 0 -.4 1
1: .4 0 -.4 1
2: .4 0 .4 1
3: -.4 0 .4 1
TEXTURE VERTICES 4
0: 0 0
1: 64 0
2: 64 64
3: 0 64
VERTEX NORMALS
0: 0 -1 0
1: 0 -1 0
2: 0 -1 0
3: 0 -1 0
FACES 1
0: -1 0x0 4 3 1 0 4 0, 0 1, 1 2, 2 3, 3
FACE NORMALS
0: 0 -1 0
SECTION: HIERARCHYDEF
HIERARCHY NODES 1
0: 0x0 0x0 0 -1 -1 -1 0 0 0 0 0 0 0 0 0 0 plate
"""
"""A square that faces -y."""


def rooms(*fragment: str, templates: tuple[str, ...] = (), things: tuple[str, ...] = ()) -> str:
    kinds = ("World templates 9", "post none type=cog collide=1 size=.1", *templates)
    placed = (f"World things {len(things)}", "- 0: walkplayer walkplayer .5 .5 .2 0 0 0 0",
              "- 1: ghost ghost .5 1.5 .5 0 90 0 1", *things)  # fmt: skip
    return two_rooms(*NO_COGS, *fragment, *kinds, *placed)


def both(level: Level, a: object = 0, b: object = 1) -> tuple[Verdict, Verdict]:
    return sight(level, a, b).verdict, engine(level, a, b).verdict


def engine(level: Level, a: object = 0, b: object = 1) -> Scene:
    return sight(level, a, b, engine="openjkdf2")


@pytest.mark.parametrize(("flags", "verdict"), [("0x0", SEEN), ("0x4", HIDDEN)])
def test_a_surface_without_adjoin_blocks_by_its_flag(flags: str, verdict: Verdict) -> None:
    wall = FAR_WALL.replace("0x4", flags, 1)
    level = level_of(rooms("World surfaces 12", wall, things=(START, "1: ghost b .5 3 .5 0 0 0 1")))
    assert both(level) == (HIDDEN, verdict)


@pytest.mark.parametrize(
    ("y", "verdict", "touching"),
    [("2", HIDDEN, (9,)), ("1.999995", SEEN, (9,)), ("1.99998", SEEN, ()), ("2.00001", HIDDEN, ())],
)
def test_an_end_on_a_face_is_blocked(y: str, verdict: Verdict, touching: tuple[int, ...]) -> None:
    level = level_of(rooms(things=(START, f"1: ghost b .5 {y} .5 0 0 0 1")))
    assert engine(level).verdict is verdict
    assert sight(level, 0, 1).verdict is (HIDDEN if float(y) > 2 else SEEN)
    assert engine(level).touching == sight(level, 0, 1).touching == touching


def test_an_end_by_an_edge_touches_both_faces_and_a_passage_none() -> None:
    level = level_of(rooms(things=(START, "1: ghost b .999995 1.999995 .5 0 0 0 1", "2: ghost c .5 1 .5 0 0 0 1")))
    assert engine(level).touching == (9, 11)
    assert engine(level, 0, 2).touching == ()
    outside = "1: ghost b 1.000003 2.000003 .5 0 0 0 1", "2: ghost c 1.000009 2.000009 .5 0 0 0 1"
    level = level_of(rooms(things=(START, *outside)))
    assert [engine(level, 0, end).touching for end in (1, 2)] == [(9, 11), ()], "4e-6 and 1.3e-5 JKU from the edge"
    level = level_of(rooms(things=(START, "1: ghost b .5 1.8 .5 0 0 0 1", "2: ghost c .5 1 .5 0 0 0 1")))
    assert engine(level, 0, 2).verdict is SEEN


@pytest.mark.parametrize(("kind", "verdict"), [("weapon", SEEN), ("actor", SEEN), ("cog", HIDDEN)])
def test_only_things_of_type_cog_block(kind: str, verdict: Verdict) -> None:
    thing = f"thing none type={kind} collide=1 size=.1"
    placed = (START, "1: ghost b .5 1.8 .5 0 0 0 1", "2: thing t .5 .6 .5 0 0 0 0")
    assert both(level_of(rooms(templates=(thing,), things=placed))) == (HIDDEN, verdict)


@pytest.mark.parametrize(
    ("x", "size", "yaw", "expected"),
    [
        (0.5, 0.3, 0, (HIDDEN, HIDDEN)),
        (0.5, 0.3, 180, (HIDDEN, SEEN)),  # from behind
        (0.85, 0.3, 0, (HIDDEN, SEEN)),  # past the sphere, through the face
        (0.85, 0.4, 0, (HIDDEN, HIDDEN)),
        (0.95, 0.6, 0, (SEEN, SEEN)),  # through the sphere, past the face
    ],
)
def test_faces_block_from_their_fronts_within_the_sphere(
    x: float, size: float, yaw: int, expected: tuple[Verdict, Verdict]
) -> None:
    template = f"plate none type=cog collide=3 size={size} model3d=plate.3do"
    ends = (f"0: ghost a {x} .1 .5 0 0 0 0", f"1: ghost b {x} 1.9 .5 0 0 0 1")
    text = rooms(templates=(template,), things=(*ends, f"2: plate p .5 .75 .5 0 {yaw} 0 0")).split("\n")
    with level_with_files(*PLATE.rstrip().split("\n")) as at_hand:
        level = Level(level_of("\n".join(text)).document, at_hand.resources)
        assert both(level) == expected
        on_face = sight(level, 0, (x, 0.75, 0.5), engine="openjkdf2").verdict
        assert (on_face is HIDDEN) == (expected[1] is HIDDEN), "an end on a front face is blocked by it"
    assert both(level_of("\n".join(text)))[1] is (SEEN if x - 0.5 > size else VARIES), "without its model"


@pytest.mark.parametrize(
    ("box", "verdict", "cut"),
    [
        ("-9 -9 -9 9 9 9", SEEN, Cut.COLLIDE_BOX),
        ("-9 -9 -9 9 1.5 9", HIDDEN, None),
        (".1 .1 .1 .9 .9 .9", HIDDEN, None),
    ],
)
def test_a_sector_whose_collide_box_holds_the_end_is_skipped(box: str, verdict: Verdict, cut: Cut | None) -> None:
    shut = ("World adjoins 2", "0: 0x6 1 1", "Sector 0", f"CollideBox {box}")
    level = level_of(rooms(*shut, things=(START, "1: ghost b .5 1.5 .5 0 0 0 1")))
    assert both(level) == (HIDDEN, verdict)
    assert engine(level).cut is cut
    assert ("counts as clear" in "\n".join(tell(level, engine(level)))) == (cut is not None)


@pytest.mark.parametrize(
    ("y", "verdict"), [("1.9", HIDDEN), ("2.000005", HIDDEN), ("2.000015", SEEN), ("2.0001", SEEN)]
)
def test_a_face_that_the_start_lies_behind_is_not_seen(y: str, verdict: Verdict) -> None:
    level = level_of(rooms(things=(f"0: ghost a .5 {y} .5 0 0 0 1", "1: ghost b .5 3 .5 0 0 0 1")))
    assert both(level) == (HIDDEN if y == "1.9" else SEEN, verdict)
    away = level_of(rooms(things=(f"0: ghost a .5 {y} .5 0 0 0 1", "1: ghost b .5 1.5 .5 0 0 0 1")))
    assert engine(away).verdict is SEEN, "going inward"


def test_going_inward_behind_a_face_and_sliding_along_it_do_not_meet_it() -> None:
    level = level_of(rooms(things=("0: ghost a .5 2.000005 .5 0 0 0 1", "1: ghost b .5 2.000002 .5 0 0 0 1")))
    assert both(level) == (SEEN, SEEN)
    along = level_of(rooms(things=("0: ghost a .2 2 .5 0 0 0 1", "1: ghost b .8 2 .5 0 0 0 1")))
    assert both(along) == (SEEN, SEEN)


@pytest.mark.parametrize(("count", "verdict"), [(64, HIDDEN), (65, SEEN)])
def test_the_search_stops_after_64_sectors(count: int, verdict: Verdict) -> None:
    builder = Builder("row")
    for i in range(count):
        builder.room((0, i, 0), (1, i + 1, 1))
    for i in range(1, count):
        builder.window(i - 1, i, (0, i, 0), (1, i, 1))
    level = level_of(builder.text())
    faces = SightFaces(level, Engine.OPENJKDF2)
    way = engine_way(faces, 0, (0.5, 0.5, 0.5), (0.5, count + 1.0, 0.5))
    assert way.explanation.visible == (verdict is SEEN)
    assert way.cut == (Cut.SECTORS if verdict is SEEN else None)
    assert way.entered == frozenset(range(64))
    assert len(way.explanation.steps) == 64


@pytest.mark.parametrize("end", [-1, 99, 2])
def test_a_null_thing_answers_minus_one(end: int) -> None:
    level = level_of(rooms(things=(START, "1: ghost b .5 1.8 .5 0 0 0 1", "2: ghost c .5 1.8 .5 0 0 0 77")))
    for a, b in ((0, end), (end, 1), (end, end)):
        found = engine(level, a, b)
        assert found.verdict is Verdict.NULL_THING
        assert list(tell(level, found))[-1] == "null thing: HasLOS answers -1, which scripts take for true"
        with pytest.raises(EndpointError):
            sight(level, a, b)
    with pytest.raises(EndpointError):
        engine(level, 0, "door")


def test_only_things_in_sectors_on_the_way_block() -> None:
    placed = (START, "1: ghost b .5 .9 .5 0 0 0 0", "2: post p .5 .6 .5 0 0 0 {}")
    here, elsewhere = (level_of(rooms(things=(*placed[:2], placed[2].format(s)))) for s in (0, 1))
    assert both(here) == (HIDDEN, HIDDEN)
    assert both(elsewhere) == (HIDDEN, SEEN)


@pytest.mark.parametrize(
    ("named", "fragment", "expected"),
    [
        (3, (), (VARIES, VARIES)),  # an open passage
        (8, (), (VARIES, VARIES)),  # its other side
        (3, ("World adjoins 2", "0: 0x6 1 1"), (VARIES, VARIES)),  # a closed one
        (99, ("World adjoins 2", "0: 0x6 1 1"), (HIDDEN, HIDDEN)),
        (4, (), (SEEN, SEEN)),  # not on the way
    ],
)
def test_what_a_cog_may_open_or_close_varies(
    named: int, fragment: tuple[str, ...], expected: tuple[Verdict, Verdict]
) -> None:
    cogs = ("World cogs 1", f"0: door.cog {named} -1 wind.wav")
    level = level_of(rooms(*fragment, *cogs, things=(START, "1: ghost b .5 1.8 .5 0 0 0 1")))
    assert both(level) == expected
    behind = level_of(rooms(*fragment, *cogs, things=(START, "1: ghost b .5 3 .5 0 0 0 1")))
    assert both(behind) == (HIDDEN, HIDDEN) or fragment, "a wall behind the passage is there for ever"


@pytest.mark.parametrize(("flags", "expected"), [("0x0", (HIDDEN, VARIES)), ("0x4", (HIDDEN, VARIES))])
def test_a_wall_whose_flags_a_cog_may_change(flags: str, expected: tuple[Verdict, Verdict]) -> None:
    """Without an adjoin it blocks for ever by the research document; the decompiled engine asks for its flag."""
    cogs = ("World cogs 1", "0: door.cog 9 -1 wind.wav", "World surfaces 12", FAR_WALL.replace("0x4", flags, 1))
    level = level_of(rooms(*cogs, things=(START, "1: ghost b .5 3 .5 0 0 0 1")))
    assert both(level) == expected
    before = level_of(rooms(*cogs, things=(START, "1: ghost b .5 3 .5 0 0 0 1", "2: post p .5 .6 .5 0 0 0 0")))
    assert both(before) == (HIDDEN, HIDDEN), "a thing blocks before"


def test_the_mesh_is_kept_with_the_level() -> None:
    level = level_of(rooms(things=(START, "1: ghost b .5 1.8 .5 0 0 0 1")))
    sight(level, 0, 1)
    mesh = LevelFacts.of(level).mesh
    sight(level, 1, 0)
    assert LevelFacts.of(level).mesh is mesh
    assert LevelFacts.of(level_of(rooms())).mesh is not mesh


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize("name", ["azulcity", "lagoon"])
def test_with_the_rules_of_research_the_way_is_that_of_sight(name: str) -> None:
    """Random segments neither end on a face nor start near one, so that these rules cannot tell the two apart."""
    level = load(f"{CORPUS}/gob/masspack.gob!jkl/{name}.jkl")
    facts = LevelFacts.of(level)
    rng = np.random.default_rng(4)
    sectors = np.flatnonzero(level.sound_sectors)
    centre = _centres(level, sectors)
    apart = (facts.mesh.location(centre).touching == 0) & (facts.mesh.locate(centre) == sectors)
    sectors, centre = np.tile(sectors[apart], 3), np.tile(centre[apart], (3, 1))
    targets = np.roll(centre, 1, axis=0)
    targets[50:] = centre[50:] + rng.normal(0, 0.5, (len(centre) - 50, 3))
    mesh = facts.mesh.sight(centre, sectors, targets)
    faces = facts.sight_faces(Engine.RESEARCH)
    ways = [engine_way(faces, int(s), tuple(a), tuple(b)) for s, a, b in zip(sectors, centre, targets, strict=True)]
    assert [way.explanation.visible for way in ways] == mesh.visible.tolist()
    assert [way.explanation.blocker for way in ways] == mesh.blocker.tolist()
    assert 100 < mesh.visible.sum() < 0.8 * len(sectors)


def _centres(level: Level, sectors: np.ndarray) -> np.ndarray:
    boxes = level.document.sectors.bound_box[sectors].astype(np.float64)
    return (boxes[:, :3] + boxes[:, 3:]) / 2
