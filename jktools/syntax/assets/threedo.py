"""The 3DO front end: from a model's text to columns (rdModel3_Load in the decompiled engine)."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from jktools.diagnostics import Severity, Subject
from jktools.source import Source
from jktools.syntax.arrays import Float32, Int32
from jktools.syntax.assets import faults
from jktools.syntax.assets import threedo_lines as records
from jktools.syntax.assets.asset import Reference
from jktools.syntax.assets.lines import LineReader
from jktools.syntax.assets.model import Faces, Geoset, Mesh, Model, Nodes
from jktools.syntax.assets.threedo_checks import check_limits, check_references
from jktools.syntax.misfit import quote
from jktools.syntax.records import Kind, Record, prefix
from jktools.syntax.rows import Rows, floats, ints

EFFECT = "the engine rejects the model and shows dflt.3do instead"

_IN_GEOSET = (records.SECTION, records.GEOSET)
_IN_MESH = (records.SECTION, records.GEOSET, records.MESH)


def read_model(source: Source, game: str = "jk", *, strict_grammar: bool = False) -> Model:
    """Read a 3DO. Never raises: what cannot be read is told in `Model.diagnostics`, and the rest is read.

    `strict_grammar` reads every record with the Lark grammar: slow, and the same result.
    """
    lines = LineReader(source, game, EFFECT, strict=strict_grammar)
    read = _Reader(lines)
    read.file()
    lines.at_end("the model")
    material_lines = read.materials.lines
    model = Model(
        source=source,
        references=tuple(
            Reference("mat", name, lines.lines.span(line))
            for name, line in zip(read.materials.names, material_lines.tolist(), strict=True)
        ),
        lines=lines.lines,
        materials=read.materials.names,
        material_lines=material_lines,
        radius=read.radius,
        insert_offset=read.insert_offset,
        geosets=tuple(read.geosets),
        nodes=read.nodes if read.nodes is not None else read.hierarchy_of(range(0)),
    )
    check_limits(lines, model)
    check_references(lines, model)
    return model.with_diagnostics(lines.faults.finish())


class _MissingLineError(Exception):
    """A line that must be there is not, and what would follow it cannot be told apart."""


class _Materials(NamedTuple):
    names: tuple[str, ...]
    lines: Int32


class _Reader:
    """Reads the sections in the order that the engine demands."""

    def __init__(self, lines: LineReader) -> None:
        self.lines = lines
        self.materials = _Materials((), np.zeros(0, np.int32))
        self.radius = float("nan")
        self.insert_offset: Float32 = np.full(3, np.nan, np.float32)
        self.geosets: list[Geoset] = []
        self.nodes: Nodes | None = None

    def file(self) -> None:
        """Read the four sections; one that breaks off does not hide the next."""
        for section in (self._header, self._material_list, self._geometry, self._hierarchy):
            try:
                self._value(records.SECTION)
                section()
            except _MissingLineError:
                if not self.lines.seek(records.SECTION):
                    return

    # ---- sections

    def _header(self) -> None:
        lines = self.lines
        if not lines.is_at(records.VERSION):
            lines.fault(
                faults.UNKNOWN_ASSET_VERSION, lines.at,
                f'expected the line "3do 2.1", but found {quote(lines.text()) if not lines.done else "nothing"}',
                "write 3DO 2.1; the engine passes over this line unread",
            )  # fmt: skip
            lines.at += not lines.has(records.SECTION, lines.at)
            return
        line = lines.at
        (version,) = self._value(records.VERSION)
        if version != "2.1":
            lines.fault(
                faults.UNKNOWN_ASSET_VERSION, line, f"the version is {version}, but only 2.1 is known",
                "write 3DO 2.1; the engine reads every version as that",
            )  # fmt: skip

    def _material_list(self) -> None:
        rows = self._counted(records.MATERIALS, records.MATERIAL, "material", "materials")
        self.materials = _Materials(rows.word_column("name"), rows.line_column())

    def _geometry(self) -> None:
        self.radius = self._float(records.RADIUS)
        values = self._value(records.INSERT_OFFSET)
        self.insert_offset = floats(values)
        line, announced = self._count(records.GEOSETS)
        while self.lines.is_at(records.GEOSET):
            self._geoset()
        self.lines.counted(line, "geosets", announced, len(self.geosets))

    def _geoset(self) -> None:
        meshes: list[Mesh] = []
        line = self.lines.at
        self._value(records.GEOSET)
        try:
            heading, announced = self._count(records.MESHES, _IN_GEOSET)
            while self.lines.is_at(records.MESH):
                self._mesh(meshes)
            self.lines.counted(heading, "meshes", announced, len(meshes))
        except _MissingLineError:
            self._skip_to(*_IN_GEOSET)
        self.geosets.append(Geoset(line, tuple(meshes)))

    def _mesh(self, meshes: list[Mesh]) -> None:
        line = self.lines.at
        try:
            meshes.append(self._whole_mesh())
        except _MissingLineError:
            self._skip_to(*_IN_MESH)
            meshes.append(self._empty_mesh(line))  # it keeps its place, so that the hierarchy's indices hold

    def _whole_mesh(self) -> Mesh:
        line = self.lines.at
        self._value(records.MESH)
        (name,) = self._value(records.NAME, _IN_MESH)
        radius = self._float(records.RADIUS, _IN_MESH)
        geometry_mode, light_mode, texture_mode = (
            self._int(record, _IN_MESH) for record in (records.GEOMETRY_MODE, records.LIGHT_MODE, records.TEXTURE_MODE)
        )
        vertices = self._counted(records.VERTICES, records.VERTEX, "vertex", "vertices", _IN_MESH)
        texture_vertices = self._counted(
            records.TEXTURE_VERTICES, records.TEXTURE_VERTEX, "texture vertex", "texture vertices", _IN_MESH
        )
        normals = self._as_many(records.VERTEX_NORMALS, "vertex normals", len(vertices))
        faces = self._counted(records.FACES, records.FACE, "face", "faces", _IN_MESH)
        face_normals = self._as_many(records.FACE_NORMALS, "face normals", len(faces))
        mesh = Mesh(
            line,
            str(name),
            radius,
            geometry_mode,
            light_mode,
            texture_mode,
            vertices=vertices.float_columns("x", 3),
            intensity=vertices.float_columns("intensity", 1),
            texture_vertices=texture_vertices.float_columns("u", 2),
            vertex_normals=_of_length(normals.float_columns("x", 3), len(vertices)),
            faces=self._faces(faces, _of_length(face_normals.float_columns("x", 3), len(faces))),
        )
        for rows, kind in ((vertices, "vertex"), (texture_vertices, "texture vertex"), (normals, "normal")):
            self.lines.outside(rows, kind)
        return mesh

    def _empty_mesh(self, line: int) -> Mesh:
        vertices = self.lines.rows(records.VERTEX, "vertex", ()).float_columns("x", 3)
        faces = self._faces(self.lines.rows(records.FACE, "face", ()), vertices)
        return Mesh(line, "", float("nan"), 0, 0, 0, vertices, vertices[:, 0], vertices[:, :2], vertices, faces)

    def _faces(self, rows: Rows, normal: Float32) -> Faces:
        material, geometry_mode, light_mode, texture_mode, count = map(
            rows.int_column, ("material", "geometry mode", "light mode", "texture mode", "vertex count")
        )
        flags, extra_light = rows.hex_column("face flags"), rows.float_columns("extra light", 1)
        broken = rows.broken()
        start, words = rows.tails()
        numbers = self._corner_numbers(rows, start, words)
        corners: list[int] = []
        corner_start = [0]
        for face, (first, last) in enumerate(pairwise(start.tolist())):
            wanted = 2 * int(count[face])
            broken[face] = broken[face] or not self._corners_fit(rows, face, wanted, last - first)
            corners += [] if broken[face] else numbers[first : first + wanted]
            corner_start.append(len(corners) // 2)
        self.lines.outside(rows, "face")
        pairs = np.array(corners, np.int32).reshape(-1, 2)
        return Faces(
            rows.line_column(), broken, material, flags, geometry_mode, light_mode, texture_mode, extra_light,
            np.array(corner_start, np.int32), np.ascontiguousarray(pairs[:, 0]), np.ascontiguousarray(pairs[:, 1]),
            normal,
        )  # fmt: skip

    def _corner_numbers(self, rows: Rows, start: Int32, words: list[str]) -> list[int]:
        """The indices behind the fields of all faces, as the engine reads them (atoi)."""
        if _NUMBERS.fullmatch("".join(word + " " for word in words)):
            return list(map(int, words))
        numbers = [prefix(Kind.INT, word) for word in words]
        for at, (word, number) in enumerate(zip(words, numbers, strict=True)):
            if word != number:
                face = int(np.searchsorted(start, at, "right")) - 1
                self.lines.fault(
                    faults.LOOSELY_READ_ASSET, int(rows.lines[face]),
                    f"face {face}: expected a whole number, but found {quote(word)}; the engine reads {number}",
                    "write the value that you mean", Subject("face", face),
                )  # fmt: skip
        return ints(numbers)[0]

    def _corners_fit(self, rows: Rows, face: int, wanted: int, found: int) -> bool:
        """Whether a face has a pair of numbers for each corner that it announces; told when not."""
        if found != wanted:
            short = found < wanted
            self.lines.fault(
                faults.ASSET_COUNT_MISMATCH, int(rows.lines[face]),
                f"face {face} announces {wanted // 2} vertices, which take {wanted} numbers, but {found} follow",
                "write the vertex and the texture vertex of each corner; the engine "
                + ("reads beyond the line" if short else "does not read the rest"),
                Subject("face", face), None if short else Severity.WARNING,
            )  # fmt: skip
        return 0 <= wanted <= found

    def _hierarchy(self) -> None:
        line, announced = self._count(records.HIERARCHY_NODES)
        found = self.lines.labelled()
        self.lines.counted(line, "hierarchy nodes", announced, len(found))
        self.nodes = self.hierarchy_of(found)

    def hierarchy_of(self, lines: Sequence[int]) -> Nodes:
        """Read the nodes on these lines."""
        rows = self.lines.rows(records.NODE, "node", lines)
        nodes = Nodes(
            rows.line_column(),
            rows.broken(),
            flags=rows.hex_column("flags"),
            type=rows.hex_column("type"),
            mesh=rows.int_column("mesh"),
            parent=rows.int_column("parent"),
            child=rows.int_column("child"),
            sibling=rows.int_column("sibling"),
            child_count=rows.int_column("number of children"),
            position=rows.float_columns("x", 3),
            rotation=rows.float_columns("pitch", 3),
            pivot=rows.float_columns("pivot x", 3),
            names=rows.word_column("name"),
        )
        self.lines.outside(rows, "node")
        return nodes

    # ---- lines

    def _value(self, record: Record, stops: Collection[Record] = (records.SECTION,)) -> Sequence[str]:
        stops = () if record is records.SECTION else stops
        values = self.lines.value(record, stops)
        if values is None:
            raise _MissingLineError
        return values[: len(record.fields)]

    def _int(self, record: Record, stops: Collection[Record] = (records.SECTION,)) -> int:
        return ints([str(self._value(record, stops)[0])])[0][0]

    def _float(self, record: Record, stops: Collection[Record] = (records.SECTION,)) -> float:
        return float(floats([str(self._value(record, stops)[0])])[0])

    def _count(self, record: Record, stops: Collection[Record] = (records.SECTION,)) -> tuple[int, int]:
        """The logical line of a heading, and the number it announces."""
        count = self._int(record, stops)
        return self.lines.at - 1, count

    def _counted(
        self, heading: Record, record: Record, kind: str, plural: str, stops: Collection[Record] = (records.SECTION,)
    ) -> Rows:
        """The records below a heading that announces their number."""
        line, announced = self._count(heading, stops)
        found = self.lines.labelled()
        self.lines.counted(line, plural, announced, len(found))
        return self.lines.rows(record, kind, found)

    def _as_many(self, heading: Record, plural: str, wanted: int) -> Rows:
        """The normals below a heading without a number: as many as there are vertices, or faces."""
        self._value(heading, _IN_MESH)
        line = self.lines.at - 1
        found = self.lines.labelled()
        self.lines.counted(line, plural, wanted, len(found))
        return self.lines.rows(records.NORMAL, "normal", found)

    def _skip_to(self, *wanted: Record) -> None:
        lines = self.lines
        while not lines.done and not any(lines.has(record, lines.at) for record in wanted):
            lines.at += 1


_NUMBERS = re.compile(r"(?:[-+]?[0-9]{1,9} )*")
"""Whole numbers that surely fit into 32 bits."""


def _of_length(values: Float32, length: int) -> Float32:
    """The first `length` rows; NaN where there are fewer."""
    if len(values) == length:
        return values
    fitted: Float32 = np.full((length, values.shape[1]), np.nan, np.float32)
    fitted[: len(values)] = values[:length]
    return fitted
