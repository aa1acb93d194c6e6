"""What a model says that its format allows and the engine does not, or that points nowhere."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Severity, Subject
from jktools.diagnostics.wording import counted, numbered
from jktools.syntax.arrays import Int32
from jktools.syntax.assets import faults
from jktools.syntax.assets.lines import LineReader
from jktools.syntax.assets.model import NONE, Faces, Mesh, Model, Nodes

MOST_VERTICES, MOST_TEXTURE_VERTICES, MOST_FACES, MOST_CORNERS = 0x200, 0x300, 0x200, 24
"""Of one mesh, and of one face; beyond them the engine rejects the model (rdModel3_Load)."""

MOST_GEOSETS = 4
"""Levels of detail that the engine has room for; it does not check."""


def check_limits(lines: LineReader, model: Model) -> None:
    """Tell of meshes and faces that are too large."""
    if len(model.geosets) > MOST_GEOSETS:
        lines.fault(
            faults.MODEL_TOO_LARGE, model.geosets[MOST_GEOSETS].line,
            f"the model has {len(model.geosets)} geosets, but the engine has room for {MOST_GEOSETS}",
            "leave out the coarsest; the engine writes beyond its memory",
        )  # fmt: skip
    for mesh, title in _meshes(model):
        for count, most, kind in (
            (len(mesh.vertices), MOST_VERTICES, "vertices"),
            (len(mesh.texture_vertices), MOST_TEXTURE_VERTICES, "texture vertices"),
            (len(mesh.faces), MOST_FACES, "faces"),
        ):
            if count > most:
                lines.fault(
                    faults.MODEL_TOO_LARGE, mesh.line, f"{title} has {count} {kind}, but the engine takes {most}",
                    f"split the mesh; {lines.effect}",
                )  # fmt: skip
        corners = np.diff(mesh.faces.corner_start)
        for face in np.flatnonzero(~mesh.faces.broken & ((corners > MOST_CORNERS) | (corners == 0))).tolist():
            lines.fault(
                faults.MODEL_TOO_LARGE if corners[face] else faults.MALFORMED_ASSET, int(mesh.faces.lines[face]),
                f"face {face} of {title} has {corners[face]} vertices, but the engine takes 1 to {MOST_CORNERS}",
                ("split the face" if corners[face] else "remove the face") + f"; {lines.effect}", Subject("face", face),
            )  # fmt: skip


def check_references(lines: LineReader, model: Model) -> None:
    """Tell of indices that point nowhere, which the engine follows all the same, and of a hierarchy that breaks."""
    for mesh, title in _meshes(model):
        faces = mesh.faces
        _check_material(lines, faces, title, len(model.materials))
        _check_corners(lines, faces, faces.corner_vertex, len(mesh.vertices), title, "vertex")
        textured = np.repeat(faces.material != NONE, np.diff(faces.corner_start))
        uvs = np.where(textured, faces.corner_texture_vertex, 0)
        # Editors write texture vertex 0 on faces of colour materials, which have none; the engine does not read it.
        _check_corners(lines, faces, uvs, max(1, len(mesh.texture_vertices)), title, "texture vertex")
    _check_nodes(lines, model)


def _meshes(model: Model) -> Iterator[tuple[Mesh, str]]:
    for number, geoset in enumerate(model.geosets):
        where = f" of geoset {number}" if len(model.geosets) > 1 else ""
        for index, mesh in enumerate(geoset.meshes):
            yield mesh, f"mesh {index} ({mesh.name}){where}"


def _check_material(lines: LineReader, faces: Faces, title: str, materials: int) -> None:
    bad = ~faces.broken & ((faces.material < NONE) | (faces.material >= materials))
    for face in np.flatnonzero(bad).tolist():
        lines.fault(
            faults.ASSET_INDEX_OUT_OF_RANGE, int(faces.lines[face]),
            f"face {face} of {title} has material {faces.material[face]}, but the model has "
            f"{numbered(materials, 'material')}",
            "name a material of the list, or -1; the engine reads beyond it", Subject("face", face),
        )  # fmt: skip


def _check_corners(lines: LineReader, faces: Faces, index: Int32, count: int, title: str, kind: str) -> None:
    """Tell once a face."""
    corners = np.flatnonzero((index < 0) | (index >= count))
    owners = np.searchsorted(faces.corner_start, corners, "right") - 1
    for face, first in zip(*np.unique(owners, return_index=True), strict=True):
        lines.fault(
            faults.ASSET_INDEX_OUT_OF_RANGE, int(faces.lines[face]),
            f"face {face} of {title} names {kind} {index[corners[first]]}, but the last is {count - 1}",
            f"name a {kind} of the mesh; the engine reads beyond them", Subject("face", int(face)),
        )  # fmt: skip


def _check_nodes(lines: LineReader, model: Model) -> None:
    nodes = model.nodes
    if not len(nodes):
        return
    meshes = min((len(geoset.meshes) for geoset in model.geosets), default=0)
    lost = not model.geosets and lines.faults.found  # told already: the meshes are there, and could not be read
    node_names = ("node", "nodes")
    for column, kind, count, names in (
        *(() if lost else ((nodes.mesh, "mesh", meshes, ("mesh", "meshes")),)),
        (nodes.parent, "parent", len(nodes), node_names),
        (nodes.child, "child", len(nodes), node_names),
        (nodes.sibling, "sibling", len(nodes), node_names),
    ):
        for node in np.flatnonzero(~nodes.broken & ((column < NONE) | (column >= count))).tolist():
            lines.fault(
                faults.ASSET_INDEX_OUT_OF_RANGE, int(nodes.lines[node]),
                f"node {node} ({nodes.names[node]}) has {kind} {column[node]}, but the model has "
                f"{numbered(count, *names)}",
                "name one that exists, or -1; the engine reads beyond them", Subject("node", node),
            )  # fmt: skip
    _check_tree(lines, nodes)


def _check_tree(lines: LineReader, nodes: Nodes) -> None:
    children: dict[int, int] = dict.fromkeys(range(len(nodes)), 0)
    reached = set()
    for node, above in nodes.walk():
        reached.add(node)
        children[above] = children.get(above, 0) + 1
    for node in sorted(reached):
        announced, found = int(nodes.child_count[node]), children[node]
        if announced > found and not nodes.broken[node]:
            lines.fault(
                faults.BROKEN_HIERARCHY, int(nodes.lines[node]),
                f"node {node} ({nodes.names[node]}) announces {counted(announced, 'child', 'children')}, but their "
                f"chain has {found}",
                "mend child, sibling and number of children; the engine follows the chain into nowhere",
                Subject("node", node),
            )  # fmt: skip
    for node in sorted(set(range(len(nodes))) - reached):
        if nodes.mesh[node] != NONE and not nodes.broken[node]:
            lines.fault(
                faults.BROKEN_HIERARCHY, int(nodes.lines[node]),
                f"node {node} ({nodes.names[node]}) has a mesh, but the tree below node 0 does not reach it",
                "hang it below another node; the engine never shows its mesh", Subject("node", node), Severity.WARNING,
            )  # fmt: skip
