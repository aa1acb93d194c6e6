"""Where segments meet things: spheres and the faces of real models, against brute force."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from jktools.facts.occluders import Along, _sign, body_mesh, faces_mesh, fan_corners, placed_vertices, sphere_meeting
from jktools.facts.scene import Verdict
from jktools.facts.sights import sight
from jktools.geometry.engine_sight import Faces
from jktools.geometry.rest_pose import rest_pose
from jktools.model import Level
from jktools.source import Source
from jktools.syntax.assets.model import Model
from jktools.syntax.assets.reading import read_asset
from tests.support.assets import corpus_assets
from tests.support.levels import CORPUS, level_of, two_rooms

FRONTS = 1000 if os.environ.get("JKTOOLS_FUZZ") else 40
"""Of these also from the front, one at a time."""
SEGMENTS = 1000 if os.environ.get("JKTOOLS_FUZZ") else 100


def test_the_sign_of_roots() -> None:
    rng = np.random.default_rng(1)
    zeros = 0
    for _ in range(3000):
        u, v = (int(n) for n in rng.integers(0, 12, 2))
        x = Fraction(int(rng.integers(-12, 13)))
        p, q = (u * u, v * v) if rng.random() < 0.5 else (u, v)
        true = x + (Fraction(u - v) if (p, q) == (u * u, v * v) else Fraction(math.sqrt(u)) - Fraction(math.sqrt(v)))
        if (p, q) != (u * u, v * v) and abs(true) < Fraction(1, 10**9):
            continue  # roots that cancel are left to the squares
        assert _sign(x, Fraction(p), Fraction(q)) == (true > 0) - (true < 0), (x, p, q)
        zeros += true == 0
    assert zeros > 20


def placed(size: float | str) -> object:
    level = level_of(
        two_rooms(
            "World templates 4",
            f"ball none type=cog size={size} collide=1",
            "World things 2",
            "1: ball b 0 0 0 0 0 0 0",
        )
    )
    return level.things[1]


@pytest.mark.parametrize(
    ("a", "b", "at"),
    [
        ((-2, 0, 0), (2, 0, 0), 0.375),
        ((-2, 0.5, 0), (2, 0.5, 0), None),  # touches
        ((-2, 0.49999, 0), (2, 0.49999, 0), 0.4992),
        ((-2, 0, 0), (-0.5, 0, 0), None),  # ends on it
        ((-2, 0, 0), (-0.49999, 0, 0), 0.99999),
        ((0.5, 0, 0), (2, 0, 0), None),  # leaves from it
        ((0.5, 0, 0), (-2, 0, 0), 0.0),  # from its surface inward
        ((0.1, 0, 0), (2, 0, 0), 0.0),
        ((2, 0, 0), (2, 0, 0), None),
    ],
)
def test_spheres(a: tuple, b: tuple, at: float | None) -> None:
    found = sphere_meeting(placed(0.5), a, b)
    assert (found is None) == (at is None)
    if found is not None:
        assert float(found) == pytest.approx(at, abs=1e-3)


def test_which_of_two_spheres_comes_first() -> None:
    one = sphere_meeting(placed(0.5), (-2.0, 0.0, 0.0), (2.0, 0.0, 0.0))
    other = sphere_meeting(placed(0.75), (-2.0, 0.0, 0.0), (2.0, 0.0, 0.0))
    assert isinstance(one, Along)
    assert isinstance(other, Along)
    assert other.before(one)
    assert not one.before(other)
    assert not one.before(one)


@pytest.mark.parametrize(("size", "met"), [("1e99", True), ("0", False), ("-1", False), ("nan", False)])
def test_sizes_that_make_no_sphere(size: str, met: bool) -> None:
    assert (sphere_meeting(placed(size), (5.0, 5.0, 5.0), (6.0, 5.0, 5.0)) is not None) == met


def brute(triangles: np.ndarray, a: np.ndarray, b: np.ndarray, *, front: bool = False) -> np.ndarray:
    """For each segment, whether it crosses a triangle from one side to strictly the other; exact.

    `front`: from its front only, and an end on it counts.
    """

    def volume(p, q, r, s):
        u, v, w = q - p, r - p, s - p
        terms = np.cross(u, v) * w
        size = (np.abs(u).max(-1) + np.abs(p).max(-1)) * (np.abs(v).max(-1) + np.abs(p).max(-1)) * np.abs(w).max(-1)
        return terms.sum(-1), 1e-13 * size + 1e-300

    def exact(points) -> int:
        p, q, r, s = ([Fraction(float(x)) for x in point] for point in points)
        u, v, w = ([y - x for x, y in zip(p, other, strict=True)] for other in (q, r, s))
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        total = sum(x * y for x, y in zip(n, w, strict=True))
        return (total > 0) - (total < 0)

    def sign(*points: np.ndarray) -> np.ndarray:
        points = np.broadcast_arrays(*points)
        value, error = volume(*points)
        out = np.sign(value).astype(int)
        for i in np.argwhere(np.abs(value) <= error):
            out[tuple(i)] = exact([point[tuple(i)] for point in points])
        return out

    t0, t1, t2 = (triangles[None, :, k] for k in range(3))
    start, end = a[:, None], b[:, None]
    from_, to = sign(t0, t1, t2, start), sign(t0, t1, t2, end)
    sides = np.stack([sign(start, end, p, q) for p, q in ((t0, t1), (t1, t2), (t2, t0))])
    if front:
        return ((from_ >= 0) & (to <= 0) & (from_ > to) & (sides <= 0).all(axis=0)).any(axis=1)
    met = (sides >= 0).all(axis=0) | (sides <= 0).all(axis=0)
    return ((to != 0) & (from_ * to <= 0) & met).any(axis=1)


def corpus_models() -> Iterator[tuple[str, Model]]:
    for name, data in corpus_assets("3do"):
        model = read_asset(Source(name, data), "3do")
        assert isinstance(model, Model), name
        yield name, model


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
def test_the_faces_of_real_models_against_every_triangle() -> None:
    """Each model of the corpus, turned and moved at random: from both sides, and from its front as the engine asks."""
    rng = np.random.default_rng(33)
    tried, crossed, fronts, count, asked = [], 0, 0, 0, 0
    for name, model in corpus_models():
        pose = rest_pose(model)
        vertices = placed_vertices(pose, rng.uniform(-20, 20, 3), rng.uniform(-180, 180, 3))
        corners, _ = fan_corners(vertices, pose)
        area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        triangles = corners[area > 0]
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        a, b = rng.uniform(low - 0.2 * (high - low) - 0.05, high + 0.2 * (high - low) + 0.05, (2, SEGMENTS, 3))
        b[:10] = vertices[rng.integers(len(vertices), size=10)] * 2 - a[:10]  # through vertices
        b[10:15] = vertices[rng.integers(len(vertices), size=5)]  # to vertices
        found = ~faces_mesh(vertices, pose).sight(a, np.zeros(SEGMENTS, np.int32), b).visible
        np.testing.assert_array_equal(found, brute(triangles, a, b), err_msg=name)
        normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        height = ((a[:, None] - triangles[:, 0]) * normal).sum(axis=2) / np.linalg.norm(normal, axis=1)
        apart = np.flatnonzero(~((height > -2e-5) & (height < 0)).any(axis=1))[:FRONTS]  # else: the 1e-5 JKU rule
        ends = a[apart].tolist(), b[apart].tolist()
        faces = Faces(triangles, range(len(triangles)))
        front = [faces.first(tuple(p), tuple(q)) is not None for p, q in zip(*ends, strict=True)]
        np.testing.assert_array_equal(front, brute(triangles, a[apart], b[apart], front=True), err_msg=name)
        tried.append(name)
        crossed, fronts, count = crossed + int(found.sum()), fronts + sum(front), count + SEGMENTS
        asked += len(front)
    assert len(tried) == sum(1 for _ in corpus_assets("3do")) >= 33
    assert 0.1 < crossed / count < 0.9
    assert 0.1 < fronts / asked < 0.9
    assert asked > 0.9 * len(tried) * FRONTS


def among(*things: str, templates: tuple[str, ...] = (), named: int = 99) -> Level:
    """The two rooms with some things; `named` is the number that its one COG names."""
    kinds = ("post none type=cog collide=1 size=.1", "crate none type=cog collide=1 size=.1 move=physics", *templates)
    lines = (f"{i}: {line}" for i, line in enumerate(things))
    return level_of(
        two_rooms(
            "World cogs 1", f"0: door.cog {named} -1 wind.wav", "World templates 9", *kinds,
            f"World things {len(things)}",
            "- 0: walkplayer walkplayer .5 .5 .2 0 0 0 0", "- 1: ghost ghost .5 1.5 .5 0 90 0 1", *lines,
        )
    )  # fmt: skip


ENDS = ("ghost a .5 .2 .5 0 0 0 0", "ghost b .5 1.8 .5 0 0 0 1")


def test_a_scene_with_things_on_the_way() -> None:
    post, crate = "post p .5 .6 .5 0 0 0 0", "crate c .5 1.4 .5 0 0 0 1"
    assert sight(among(*ENDS), 0, 1).verdict is Verdict.VISIBLE
    blocked = sight(among(*ENDS, post), 0, 1)
    assert blocked.verdict is Verdict.NOT_VISIBLE
    assert [one.thing.number for one in blocked.things] == [2]
    assert sight(among(*ENDS, crate), 0, 1).verdict is Verdict.VARIES
    both = sight(among(*ENDS, crate, ENDS[0], post), 0, 1)
    assert [one.thing.number for one in both.things] == [4, 2], "nearest first"
    assert both.verdict is Verdict.NOT_VISIBLE
    assert sight(among(*ENDS, post), 0, 1, things=False).verdict is Verdict.VISIBLE
    assert sight(among(*ENDS, post.replace(".5 .6", ".39 .6")), 0, 1).verdict is Verdict.VISIBLE, "beside the way"
    assert sight(among(*ENDS, post), (0.5, 0.2, 0.5), "0.5,1.8,0.5").verdict is Verdict.NOT_VISIBLE


def test_own_bodies_do_not_block() -> None:
    ends = ("post a .5 .2 .5 0 0 0 0", "post b .5 1.8 .5 0 0 0 1")
    assert sight(among(*ends), 0, 1).verdict is Verdict.VISIBLE


def test_a_body_in_a_wall_is_seen_once_it_is_reached() -> None:
    """The wall is at y = 2, the target behind it; a post between its body and the wall does not count."""
    far = "post b .5 2.05 .5 0 0 0 1"
    walls = sight(among(ENDS[0], far), 0, 1, things=False)
    assert walls.verdict is Verdict.NOT_VISIBLE
    found = sight(among(ENDS[0], far), 0, 1)
    assert found.reached
    assert found.verdict is Verdict.VISIBLE
    assert sight(among(ENDS[0], far.replace("2.05", "2.5")), 0, 1).verdict is Verdict.NOT_VISIBLE
    inside = among(ENDS[0], "post b .5 1.9 .5 0 0 0 1", "post c .5 1.95 .5 0 0 0 1")
    assert sight(inside, 0, 1).verdict is Verdict.VISIBLE, "behind the front of the target"


def test_a_thing_that_a_cog_may_name_varies() -> None:
    found = sight(among(*ENDS, "post p .5 .6 .5 0 0 0 0", named=2), 0, 1)
    assert [one.thing.number for one in found.things] == [2]
    assert found.verdict is Verdict.VARIES


def test_without_its_model_a_thing_has_no_faces() -> None:
    level = level_of(two_rooms())
    assert all(body_mesh(level, thing) is None for thing in level.things)
    assert Path(level.path).suffix == ".jkl"
