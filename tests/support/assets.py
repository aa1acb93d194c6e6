"""Asset files for tests: the corpus where it is at hand, and a small model made by hand."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence

from jktools.source import Source
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.reading import read_asset
from tests.support.levels import CORPUS

BLOCK = """
# a block of two quads below a turned arm
SECTION: HEADER
3DO 2.1
SECTION: MODELRESOURCE
MATERIALS 2
0: stone.mat
1: glass.mat
SECTION: GEOMETRYDEF
RADIUS 3.5
INSERT OFFSET 0 0 .12
GEOSETS 1
GEOSET 0
MESHES 2
MESH 0
NAME floor
RADIUS 1.5
GEOMETRYMODE 4
LIGHTINGMODE 3
TEXTUREMODE 1
VERTICES 4
0: -1 -1 0 1
1: 1 -1 0 1
2: 1 1 0 .5
3: -1 1 0 .5
TEXTURE VERTICES 4
0: 0 0
1: 64 0
2: 64 64
3: 0 64
VERTEX NORMALS
0: 0 0 1
1: 0 0 1
2: 0 0 1
3: 0 0 1
FACES 1
0: 0 0x0 4 3 1 0 4 0, 0 1, 1 2, 2 3, 3
FACE NORMALS
0: 0 0 1
MESH 1
NAME arm
RADIUS 1
GEOMETRYMODE 4
LIGHTINGMODE 3
TEXTUREMODE 1
VERTICES 3
0: 0 0 0 1
1: 1 0 0 1
2: 0 2 0 1
TEXTURE VERTICES 1
0: 0 0
VERTEX NORMALS
0: 0 0 1
1: 0 0 1
2: 0 0 1
FACES 1
0: 1 0x2 4 3 1 0.5 3 0, 0 1, 0 2, 0
FACE NORMALS
0: 0 0 1
SECTION: HIERARCHYDEF
HIERARCHY NODES 2
0: 0x0 0x1 0 -1 1 -1 1 0 0 0 0 0 0 0 0 0 floor
1: 0x0 0x1 1 0 -1 -1 0 0 0 2 0 90 0 .5 0 0 arm
"""
"""The second node turns its mesh by a yaw of 90 degrees about a pivot and lifts it."""


def asset_of(lines: Sequence[str]) -> Asset:
    """An asset from its text, of which the first line is a comment with the file's name."""
    name = lines[0].removeprefix("# ")
    return read_asset(Source(name, "\n".join([*lines, ""]).encode("latin-1")), name.rpartition(".")[2])


def corpus_assets(*extensions: str) -> Iterator[tuple[str, bytes]]:
    """Every file of the corpus's packs with one of these extensions, unpacked apart from the code under test."""
    for path in sorted((CORPUS / "gob").glob("*")) if CORPUS.exists() else []:
        data = path.read_bytes()
        for i in range(struct.unpack_from("<I", data, 12)[0]):
            offset, size, raw = struct.unpack_from("<II128s", data, 16 + 136 * i)
            name = raw.split(b"\0")[0].decode("latin-1").replace("\\", "/")
            if name.lower().rpartition(".")[2] in extensions:
                yield f"{path.name}!{name}", data[offset : offset + size]
