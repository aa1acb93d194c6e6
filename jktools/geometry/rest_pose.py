"""A model at rest: the meshes of one geoset where the hierarchy puts them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from jktools.engine import orientation
from jktools.engine.arrays import Float64
from jktools.syntax.arrays import Bool, Float32, Int32, UInt32
from jktools.syntax.assets.model import NONE, Faces, Mesh, Model


@dataclass(frozen=True, slots=True, eq=False)
class RestPose:
    """The faces of a model in the model's own space: x right, y forward, z up, JKU, the insert offset not applied.

    n vertices, f faces, c corners. A face that could not be read, or that names a vertex which does not exist or is not
    finite, is left out.
    """

    vertices: Float32
    """(n, 3)"""
    corner_start: Int32
    """(f + 1,) cuts the corners."""
    corner_vertex: Int32
    """(c,) into `vertices`."""
    normal: Float32
    """(f, 3) the stored normals, turned; NaN where one could not be read."""
    flags: UInt32
    """(f,) face flags."""
    material: Int32
    """(f,) into `Model.materials`, -1 for none."""
    node: Int32
    """(f,) hierarchy node that places the face."""
    face: Int32
    """(f,) its index in its mesh."""

    def __len__(self) -> int:
        return len(self.corner_start) - 1


def rest_pose(model: Model, geoset: int = 0) -> RestPose:
    """Place the meshes of a geoset (0 is what things collide with) as the hierarchy has them when nothing moves.

    A vertex goes through, in this order: its node's pivot, added; the node's pitch, yaw and roll; its position, added;
    the parent's pivot, subtracted; the same of the node above, and so on (rdThing_AccumulateMatrices in the decompiled
    engine). Computed in double precision and rounded once; the engine multiplies in float32, so that its own vertices
    may differ in the last bits where a node turns or moves. A node that the tree below node 0 does not reach places
    nothing. A model without geosets has no faces.
    """
    parts = _Parts()
    if geoset < len(model.geosets):
        meshes = model.geosets[geoset].meshes
        for node, (turn, move) in _placements(model).items():
            mesh = int(model.nodes.mesh[node])
            if 0 <= mesh < len(meshes):
                parts.add(node, meshes[mesh], turn, move)
    return parts.joined()


def _placements(model: Model) -> dict[int, tuple[Float64, Float64]]:
    """Rotation (3, 3) and translation (3,) of each node that the tree reaches, in the tree's order."""
    nodes = model.nodes
    own_turn = orientation.matrix(np.where(np.isfinite(nodes.rotation), nodes.rotation, 0.0))
    placed: dict[int, tuple[Float64, Float64]] = {NONE: (np.eye(3), np.zeros(3))}
    for node, above in nodes.walk():
        turn, move = placed[above]
        local = own_turn[node] @ nodes.pivot[node].astype(np.float64) + nodes.position[node]
        parent = int(nodes.parent[node])
        if 0 <= parent < len(nodes):
            local = local - nodes.pivot[parent]
        placed[node] = (turn @ own_turn[node], turn @ local + move)
    del placed[NONE]
    return placed


class _Parts:
    """What has been placed so far."""

    def __init__(self) -> None:
        self._vertices: list[Float32] = [np.zeros((0, 3), np.float32)]
        self._corners: list[Int32] = [np.zeros(0, np.int32)]
        self._counts: list[Int32] = [np.zeros(0, np.int32)]
        self._normal: list[Float32] = [np.zeros((0, 3), np.float32)]
        self._flags: list[UInt32] = [np.zeros(0, np.uint32)]
        self._material: list[Int32] = [np.zeros(0, np.int32)]
        self._node: list[Int32] = [np.zeros(0, np.int32)]
        self._face: list[Int32] = [np.zeros(0, np.int32)]
        self._first = 0

    def add(self, node: int, mesh: Mesh, turn: Float64, move: Float64) -> None:
        """Place one mesh."""
        with np.errstate(over="ignore", invalid="ignore"):  # what is too large becomes infinite, and its faces go
            vertices = (mesh.vertices.astype(np.float64) @ turn.T + move).astype(np.float32)
            normal = (mesh.faces.normal.astype(np.float64) @ turn.T).astype(np.float32)
        sound = _sound_faces(mesh.faces, vertices)
        counts = np.diff(mesh.faces.corner_start)
        self._corners.append((mesh.faces.corner_vertex[np.repeat(sound, counts)] + self._first).astype(np.int32))
        self._vertices.append(vertices)
        self._counts.append(counts[sound])
        self._normal.append(normal[sound])
        self._flags.append(mesh.faces.flags[sound])
        self._material.append(mesh.faces.material[sound])
        self._face.append(np.flatnonzero(sound).astype(np.int32))
        self._node.append(np.full(int(sound.sum()), node, np.int32))
        self._first += len(vertices)

    def joined(self) -> RestPose:
        """All of it."""
        counts = np.concatenate(self._counts)
        return RestPose(
            np.concatenate(self._vertices),
            np.concatenate([[0], np.cumsum(counts)]).astype(np.int32),
            np.concatenate(self._corners),
            np.concatenate(self._normal),
            np.concatenate(self._flags),
            np.concatenate(self._material),
            np.concatenate(self._node),
            np.concatenate(self._face),
        )


def _sound_faces(faces: Faces, vertices: Float32) -> Bool:
    finite: Bool = np.asarray(np.isfinite(vertices).all(axis=1))
    inside = (faces.corner_vertex >= 0) & (faces.corner_vertex < len(vertices))
    good = np.zeros(len(inside), np.bool_)
    good[inside] = finite[faces.corner_vertex[inside]]
    counts = np.diff(faces.corner_start)
    bad = np.bincount(np.repeat(np.arange(len(faces)), counts)[~good], minlength=len(faces))
    return np.asarray(~faces.broken & (bad == 0) & (counts > 0))
