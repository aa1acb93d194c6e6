"""Things as floors: against brute force, at their frames, and where their models are not at hand."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import jktools
from jktools.engine import orientation
from jktools.facts.floors import PLACED, Ball, Floors, Platform
from jktools.facts.level import LevelFacts
from jktools.geometry import Ending
from jktools.geometry.rest_pose import rest_pose
from jktools.model import Level
from jktools.session import load
from tests.geometry.test_engine_scene import PLATE
from tests.support.levels import CORPUS, two_rooms

LIFT = PLATE.replace("plate", "lift").rstrip().split("\n")
"""A square of 0.8 JKU that faces -y: a pitch of -90 degrees lays it flat."""
KIND = "lift none type=cog collide=3 size=.6 thingflags=0x40 model3d=lift.3do"
MOVES = " move=path numframes=2 frame=(.5/.5/.25:{a}/0/0) frame=(.5/.5/.75:{a}/0/0)"
FLAT = 90 if orientation.matrix([90.0, 0.0, 0.0])[2, 1] * -1 > 0 else -90


def level_of_things(tmp_path: Path, *things: str, templates: tuple[str, ...] = (KIND,), model: bool = True) -> Level:
    text = two_rooms(
        "World templates 9", *templates, f"World things {len(things)}", "- 0: walkplayer walkplayer .5 .5 .2 0 0 0 0",
        "- 1: ghost ghost .5 1.5 .5 0 90 0 1", *things,
    )  # fmt: skip
    for folder in ("jkl", "3do"):
        (tmp_path / folder).mkdir(exist_ok=True)
    (tmp_path / "jkl/test.jkl").write_text(text, "latin-1")
    if model:
        (tmp_path / "3do/lift.3do").write_text("\n".join([*LIFT[1:], ""]), "latin-1")
    return load(str(tmp_path / "jkl/test.jkl"))


def placed(z: float, pitch: int = FLAT, more: str = "") -> str:
    return f"0: lift l .5 .5 {z} {pitch} 0 0 0{more}"


def test_a_thing_carries_where_it_is_nearer(tmp_path: Path) -> None:
    found = jktools.drop(
        level_of_things(tmp_path, placed(0.25)), [[0.5, 0.5, 0.75], [0.05, 0.5, 0.75], [0.5, 0.5, 0.125]]
    )
    assert found.thing.tolist() == [0, -1, -1], "above it, beside it, below it"
    assert found.distance.tolist() == [0.5, 0.75, 0.125]
    assert found.surface.tolist() == [-1, 0, 0]
    assert found.ending.tolist() == [Ending.FLOOR] * 3
    assert found.face.tolist() == [0, -1, -1]
    assert found.other.tolist() == [-1] * 3


def test_what_does_not_carry(tmp_path: Path) -> None:
    point = [[0.5, 0.5, 0.75]]
    for kind in ("thingflags=0x40", "collide=3", "type=cog"):
        without = KIND.replace(kind, {"type=cog": "type=weapon", "collide=3": "collide=1"}.get(kind, ""))
        assert jktools.drop(level_of_things(tmp_path, placed(0.25), templates=(without,)), point).thing[0] == -1, kind
    gone = KIND.replace("0x40", "0x80040")
    assert jktools.drop(level_of_things(tmp_path, placed(0.25), templates=(gone,)), point).thing[0] == -1
    level = level_of_things(tmp_path, placed(0.25))
    assert jktools.drop(level, point, things=False).thing[0] == -1
    assert jktools.drop(level, point, own=0).thing[0] == -1
    assert jktools.drop(level, point, max_distance=0.25).ending[0] == Ending.FAR
    assert jktools.drop(level, point, max_distance=0.5).thing[0] == 0


@pytest.mark.parametrize(("tilt", "carried"), [(0, True), (53, True), (54, False), (180, False)])
def test_only_faces_that_stand_up_carry(tmp_path: Path, tilt: int, carried: bool) -> None:
    """The cosine of 53.13 degrees is 0.6."""
    found = jktools.drop(level_of_things(tmp_path, placed(0.25, FLAT + tilt)), [[0.5, 0.5, 0.75]])
    assert (found.thing[0] == 0) == carried


def test_frames_are_told_apart_from_where_it_is_placed(tmp_path: Path) -> None:
    level = level_of_things(tmp_path, placed(0.25, more=MOVES.format(a=FLAT)))
    found = jktools.drop(level, [[0.5, 0.5, 0.9375], [0.5, 0.5, 0.5], [0.5, 0.5, 0.125]])
    assert found.thing.tolist() == [0, 0, -1]
    assert found.other.tolist() == [0, -1, -1], "nearer only at its second frame"
    assert found.frame.tolist() == [1, -1, -1]
    assert found.other_distance[0] == 0.1875
    assert found.distance.tolist() == [0.6875, 0.25, 0.125]


def test_without_its_model_what_lies_beneath_is_unknown(tmp_path: Path) -> None:
    kind = KIND.replace("size=.6", "size=.25")
    level = level_of_things(tmp_path, placed(0.5), templates=(kind,), model=False)
    found = jktools.drop(level, [[0.5, 0.5, 0.9375], [0.5, 0.875, 0.9375], [0.5, 0.5, 0.125], [0.5, 0.5, 0.25]])
    assert found.ending.tolist() == [Ending.UNKNOWN, Ending.FLOOR, Ending.FLOOR, Ending.FLOOR]
    assert found.thing.tolist() == [0, -1, -1, -1], "above it, beside it, below it, where it ends"
    assert np.isnan(found.distance[0])
    assert found.surface[0] == -1


def test_the_nearest_of_two_and_the_first_of_equals(tmp_path: Path) -> None:
    things = (placed(0.25), placed(0.5).replace("0:", "1:"), placed(0.5).replace("0:", "2:"))
    found = jktools.drop(level_of_things(tmp_path, *things), [[0.5, 0.5, 0.75], [0.5, 0.5, 0.375]])
    assert found.thing.tolist() == [1, 0]


def test_the_ball_of_a_thing_is_met_exactly() -> None:
    tangent = Ball(None, (0.0, 0.0, 0.0), 0.5)  # type: ignore[arg-type]
    assert not tangent.crossed((0.5, 0.0, 9.0), -9.0)
    assert tangent.crossed((np.nextafter(0.5, 0), 0.0, 9.0), -9.0)
    assert not tangent.crossed((0.3, 0.0, -0.4), -9.0) or Fraction(0.3) ** 2 + Fraction(0.4) ** 2 < Fraction(1, 4)
    assert not tangent.crossed((0.0, 0.0, 9.0), 0.5)
    assert tangent.crossed((0.0, 0.0, 9.0), np.nextafter(0.5, 0))
    assert tangent.crossed((0.0, 0.0, 0.0), -np.inf)


def test_points_in_no_sector_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="point 1 lies in no sector"):
        jktools.drop(level_of_things(tmp_path, placed(0.25)), [[0.5, 0.5, 0.75], [9, 9, 9]])


def brute(level: Level, point: np.ndarray, frame: bool) -> tuple[Fraction, int] | None:
    """The nearest face below a point among all placed things or all frames, apart from the code under test."""
    best = None
    for thing in level.things:
        held = thing.resolved
        model = level.resources.model(held.name_in("model3d") or "none")
        wanted = held.type == "cog" and held.flags("thingflags") & 0x80042 == 0x40 and held.number("collide") == 3
        if not wanted or model is None or thing.dropped is not None:
            continue
        poses = [(*thing.position.tolist(), *thing.angles.tolist())]
        if frame:
            setting = held.values.get("frame")
            own = setting is not None and all(origin.owner == thing for origin in setting.origins)
            poses = list(setting.value) if own else []
        for pose in poses:
            turn = orientation.matrix(pose[3:])
            for top, ring in faces(model):
                if (turn @ top)[2] < 0.6:
                    continue
                corners = [[Fraction(x) for x in row] for row in (ring @ turn.T + np.array(pose[:3])).tolist()]
                depth = [depth_of(corners[0], a, b, point) for a, b in pairwise(corners[1:])]
                for d in depth:
                    if d is not None and (best is None or d < best[0]):
                        best = (d, thing.index)
    return best


def faces(model: object) -> list[tuple[np.ndarray, np.ndarray]]:
    pose = rest_pose(model)
    cuts = zip(pose.corner_start, pose.corner_start[1:], pose.normal, strict=False)
    return [(normal.astype(float), pose.vertices[pose.corner_vertex[s:e]].astype(float)) for s, e, normal in cuts]


def depth_of(a: list, b: list, c: list, point: np.ndarray) -> Fraction | None:
    """How far below a point a triangle that faces up is, by barycentric coordinates."""
    x, y, z = (Fraction(v) for v in point.tolist())
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    if area <= 0:
        return None
    v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
    w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
    if v < 0 or w < 0 or v + w > 1:
        return None
    depth = z - (a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]))
    return depth if depth >= 0 else None


def _corners(level: Level, platform: Platform, which: int) -> np.ndarray:
    """The corners of a face of a platform."""
    pose = rest_pose(level.resources.model(platform.thing.resolved.name_in("model3d")))
    values = platform.thing.resolved.values
    place = [*platform.thing.position, *platform.thing.angles]
    place = place if platform.frame == PLACED else values["frame"].value[platform.frame]
    face = platform.faces[which]
    ring = pose.vertices[pose.corner_vertex[pose.corner_start[face] : pose.corner_start[face + 1]]].astype(float)
    return ring @ orientation.matrix(np.array(place[3:], float)).T + np.array(place[:3], float)


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize(
    "path", ["demo_2.gob!jkl/demo_2.jkl", "masspack.gob!jkl/wayrest.jkl", "masspack.gob!jkl/lop_sabers.jkl"]
)
def test_real_levels_against_every_face(path: str) -> None:
    level = load(f"{CORPUS}/gob/{path}")
    facts = LevelFacts.of(level)
    platforms = facts.floors.platforms
    rng = np.random.default_rng(9)
    chosen = [platforms[i] for i in rng.integers(len(platforms), size=6)]
    corners = [_corners(level, p, int(rng.integers(len(p.faces)))) for p in chosen]
    points = np.array([rng.dirichlet(np.ones(len(ring))) @ ring for ring in corners])
    points[:, 2] += rng.uniform(0, 1, len(points))
    points[0] = corners[0][0]
    alone = Floors(platforms)
    bare = facts.mesh.drop(points, np.zeros(len(points), np.int32))
    found = alone.below(facts.mesh, points, np.zeros(len(points), np.int32))
    carried = 0
    for row, point in enumerate(points):
        here, moved = brute(level, point, frame=False), brute(level, point, frame=True)
        end = Fraction(bare.distance[row]) if np.isfinite(bare.distance[row]) else None
        if here is not None and (end is None or here[0] < end):
            assert (found.thing[row], found.distance[row]) == (here[1], float(here[0]))
            end, carried = here[0], carried + 1
        else:
            assert found.thing[row] == -1
        if moved is not None and (end is None or float(moved[0]) < float(end)):
            assert (found.other[row], found.other_distance[row]) == (moved[1], float(moved[0]))
            carried += 1
        else:
            assert found.other[row] == -1
    assert carried > 3
    assert {platform.frame for platform in platforms} >= {PLACED}
