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
VERTICES {corners}
{vertices}
TEXTURE VERTICES 1
0: 0 0
VERTEX NORMALS
{normals}
FACES {sides}
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
    return boxes((-x, -y, -z, x, y, z))


def boxes(*corners: tuple[float, float, float, float, float, float]) -> list[str]:
    """Write the model of boxes by their least and greatest corners, JKU from the thing's place; six faces each."""
    points = [point for low in corners for point in product(*zip(low[:3], low[3:], strict=True))]
    faces = [(8 * which, ring) for which in range(len(corners)) for ring in RINGS.values()]
    normals = [normal for _ in corners for normal in RINGS]
    text = HEAD.format(
        corners=len(points), sides=len(faces),
        vertices="\n".join(f"{i}: {a} {b} {c} 1" for i, (a, b, c) in enumerate(points)),
        normals="\n".join(f"{i}: 0 0 1" for i in range(len(points))),
        faces="\n".join(
            f"{i}: -1 0x0 4 3 1 0 4 " + " ".join(f"{first + corner}, 0" for corner in ring)
            for i, (first, ring) in enumerate(faces)
        ),
        face_normals="\n".join(f"{i}: {a} {b} {c}" for i, (a, b, c) in enumerate(normals)),
    )  # fmt: skip
    return text.rstrip().split("\n")
