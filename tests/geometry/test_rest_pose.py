"""A model at rest: placed by hand, and as far out as editors say that real models reach."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.geometry.rest_pose import RestPose, rest_pose
from jktools.source import Source
from jktools.syntax.assets.threedo import read_model
from tests.support.assets import BLOCK, corpus_assets

MODELS = list(corpus_assets("3do"))


def pose(text: str, geoset: int = 0) -> RestPose:
    return rest_pose(read_model(Source("x.3do", text.encode("latin-1"))), geoset)


def test_the_block() -> None:
    rest = pose(BLOCK)
    assert len(rest) == 2
    assert rest.vertices[:4].tolist() == [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
    # The arm: half a unit of pivot, then a quarter turn to the left, then two units up.
    assert rest.vertices[4:].tolist() == [[0, 0.5, 2], [0, 1.5, 2], [-2, 0.5, 2]]
    assert rest.corner_start.tolist() == [0, 4, 7]
    assert rest.corner_vertex.tolist() == [0, 1, 2, 3, 4, 5, 6]
    assert rest.node.tolist() == [0, 1]
    assert rest.face.tolist() == [0, 0]
    assert rest.flags.tolist() == [0, 2]
    assert rest.material.tolist() == [0, 1]


def test_the_parents_pivot_is_taken_off() -> None:
    rest = pose(BLOCK.replace("0 0 0 0 0 0 0 0 0 floor", "10 0 0 0 0 0 0 0 .25 floor"))
    assert rest.vertices[0].tolist() == [9, -1, 0.25]
    # Below the root the pivot counts as well, and the arm takes it off again.
    assert rest.vertices[4].tolist() == [10, 0.5, 2]


def test_a_turned_node_below_a_turned_node() -> None:
    """The tip of the arm: half a unit of pivot, pitched up, lifted by two, and then the root's quarter turn."""
    text = BLOCK.replace("0 0 0 0 0 0 0 0 0 floor", "0 0 0 0 90 0 0 0 0 floor").replace("0 0 2 0 90 0", "0 0 2 90 0 0")
    assert pose(text).vertices[6].tolist() == [0, 0.5, 4]


def test_normals_turn_with_their_node() -> None:
    rest = pose(BLOCK.replace("0 0 2 0 90 0", "0 0 2 90 0 0"))
    assert rest.normal[1].tolist() == [0, -1, 0]  # pitched up: what looked up looks back


def test_a_node_that_the_tree_does_not_reach_places_nothing() -> None:
    rest = pose(BLOCK.replace("-1 1 -1 1 0 0 0", "-1 1 -1 0 0 0 0"))
    assert rest.node.tolist() == [0]


def test_faces_that_cannot_be_placed_are_left_out() -> None:
    assert pose(BLOCK.replace("1, 1 2, 2 3, 3", "1, 1 9, 2 3, 3")).node.tolist() == [1]
    assert pose(BLOCK.replace("0: -1 -1 0 1", "0: -1 -1 zero 1")).node.tolist() == [1]
    assert pose(BLOCK.replace("0: -1 -1 0 1", "0: -1 -1 1e39 1")).node.tolist() == [1]
    assert len(pose("")) == 0
    assert len(pose(BLOCK, geoset=1)) == 0


@pytest.mark.skipif(not MODELS, reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize(("path", "data"), MODELS, ids=[path for path, _ in MODELS])
def test_real_models_reach_as_far_as_their_radius(path: str, data: bytes) -> None:
    """An oracle apart: JED writes the distance of the farthest placed vertex as the radius, LucasArts adds 0.05."""
    model = read_model(Source(path, data))
    reach = float(np.linalg.norm(rest_pose(model).vertices.astype(np.float64), axis=1).max())
    assert min(abs(model.radius - reach), abs(model.radius - reach - 0.05)) < 2e-6
