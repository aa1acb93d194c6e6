"""A 3DO model as it was read: columns for what is numerous."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from jktools.diagnostics import Diagnostic
from jktools.syntax.arrays import Bool, Float32, Int32, UInt32
from jktools.syntax.assets.asset import Asset
from jktools.syntax.lines import LogicalLines

NONE = -1
"""An index that refers to nothing."""


@dataclass(frozen=True, slots=True, eq=False)
class Faces:
    """The faces of a mesh; n faces with c corners in all."""

    lines: Int32
    """(n,) logical line of each face."""
    broken: Bool
    """(n,) faces that could not be read; they have no corner."""
    material: Int32
    """(n,) into `Model.materials`, -1 for none."""
    flags: UInt32
    """(n,) 0x1 double-sided, 0x2 translucent."""
    geometry_mode: Int32
    light_mode: Int32
    texture_mode: Int32
    extra_light: Float32
    corner_start: Int32
    """(n + 1,) cuts the corners: those of face i are `corner_start[i]:corner_start[i + 1]`."""
    corner_vertex: Int32
    """(c,) as written, which may lie outside the mesh's vertices."""
    corner_texture_vertex: Int32
    """(c,) as written; the engine does not read it where the material is no texture."""
    normal: Float32
    """(n, 3) as stored, which the engine takes as it is; NaN where it could not be read."""

    def __len__(self) -> int:
        return len(self.lines)


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """A mesh in its own space; a hierarchy node places it."""

    line: int
    """Logical line of its `mesh` line."""
    name: str
    radius: float
    """JKU, as written."""
    geometry_mode: int
    light_mode: int
    texture_mode: int
    vertices: Float32
    """(n, 3) JKU; NaN for one that could not be read."""
    intensity: Float32
    """(n,) light of each vertex."""
    texture_vertices: Float32
    """(m, 2) texels."""
    vertex_normals: Float32
    """(n, 3)"""
    faces: Faces


@dataclass(frozen=True, slots=True, eq=False)
class Geoset:
    """One level of detail; set 0 is the finest, and the one that things collide with."""

    line: int
    meshes: tuple[Mesh, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Nodes:
    """The hierarchy; n nodes, of which 0 is the root. Indices are as written."""

    lines: Int32
    broken: Bool
    flags: UInt32
    type: UInt32
    """(n,) which halves of the body a node belongs to, for animations."""
    mesh: Int32
    """(n,) into the meshes of whichever geoset is shown, -1 for none."""
    parent: Int32
    child: Int32
    sibling: Int32
    child_count: Int32
    position: Float32
    """(n, 3) JKU."""
    rotation: Float32
    """(n, 3) pitch, yaw, roll, degrees."""
    pivot: Float32
    """(n, 3) JKU."""
    names: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.lines)

    def walk(self) -> Iterator[tuple[int, int]]:
        """Go through the tree as the engine does, parents first: (node, node it was reached from; -1 at the root).

        The engine starts at node 0 and passes as many siblings as a node announces children (rdThing_AccumulateMatrices
        in the decompiled engine). A chain that ends early, leads out or comes back, where the engine crashes or hangs,
        just ends.
        """
        pending, seen = [(0, NONE)] if len(self) else [], {0}
        while pending:
            node, above = pending.pop()
            yield node, above
            children = []
            child = int(self.child[node])
            for _ in range(int(self.child_count[node])):
                if not 0 <= child < len(self) or child in seen:
                    break
                seen.add(child)
                children.append((child, node))
                child = int(self.sibling[child])
            pending += reversed(children)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Model(Asset):
    """A 3DO file."""

    lines: LogicalLines
    materials: tuple[str, ...]
    material_lines: Int32
    radius: float
    """JKU, as written; NaN where it could not be read."""
    insert_offset: Float32
    """(3,) JKU: where the model's origin, which is the thing's position, lies from the place it is inserted at.

    A body hovers by its z; see jktools.engine.hover.
    """
    geosets: tuple[Geoset, ...]
    nodes: Nodes

    def with_diagnostics(self, found: tuple[Diagnostic, ...]) -> Model:
        """The same model, with what was found in it."""
        return replace(self, diagnostics=found)
