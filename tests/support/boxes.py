"""A model of a box, for things that bodies stand on."""

from __future__ import annotations

from itertools import product

HEAD = """\
SECTION: HEADER
3DO 2.1
SECTION: MODELRESOURCE
MATERIALS 0
SECTION: GEOMETRYDEF
RADIUS 4
INSERT OFFSET 0 0 0
GEOSETS 1
GEOSET 0
MESHES 1
MESH 0
NAME box
RADIUS 4
GEOMETRYMODE 4
LIGHTINGMODE 3
TEXTUREMODE 1
VERTICES 8
{vertices}
TEXTURE VERTICES 1
0: 0 0
VERTEX NORMALS
{normals}
FACES 6
{faces}
FACE NORMALS
{face_normals}
SECTION: HIERARCHYDEF
HIERARCHY NODES 1
0: 0x0 0x0 0 -1 -1 -1 0 0 0 0 0 0 0 0 0 0 box
"""
RINGS = {
    (0, 0, 1): (1, 5, 7, 3), (0, 0, -1): (0, 2, 6, 4), (1, 0, 0): (4, 6, 7, 5), (-1, 0, 0): (0, 1, 3, 2),
    (0, 1, 0): (2, 3, 7, 6), (0, -1, 0): (0, 4, 5, 1),
}  # fmt: skip
"""Corners of each face, counter-clockwise seen from outside; corner 4 x + 2 y + z."""


def box(x: float, y: float, z: float) -> list[str]:
    """Write the model of a box by its half sizes, JKU, around the thing's place."""
    corners = list(product((-x, x), (-y, y), (-z, z)))
    text = HEAD.format(
        vertices="\n".join(f"{i}: {a} {b} {c} 1" for i, (a, b, c) in enumerate(corners)),
        normals="\n".join(f"{i}: 0 0 1" for i in range(8)),
        faces="\n".join(
            f"{i}: -1 0x0 4 3 1 0 4 " + " ".join(f"{corner}, 0" for corner in ring)
            for i, ring in enumerate(RINGS.values())
        ),
        face_normals="\n".join(f"{i}: {a} {b} {c}" for i, (a, b, c) in enumerate(RINGS)),
    )
    return text.rstrip().split("\n")
