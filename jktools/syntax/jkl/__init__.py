"""The JKL front end: from a level's text to a frozen document of columns with spans."""

from jktools.syntax.jkl.document import (
    Adjoins,
    ArchLights,
    Cogs,
    Document,
    Header,
    Heading,
    NameList,
    Normals,
    Parameters,
    Sectors,
    Surfaces,
    Table,
    Templates,
    TextureVertices,
    Things,
    Vertices,
)
from jktools.syntax.jkl.reader import read, read_library

__all__ = [
    "Adjoins",
    "ArchLights",
    "Cogs",
    "Document",
    "Header",
    "Heading",
    "NameList",
    "Normals",
    "Parameters",
    "Sectors",
    "Surfaces",
    "Table",
    "Templates",
    "TextureVertices",
    "Things",
    "Vertices",
    "read",
    "read_library",
]
