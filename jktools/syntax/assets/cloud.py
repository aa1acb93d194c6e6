"""PAR, the clouds of particles (rdParticle_LoadEntry in the decompiled engine)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from jktools.diagnostics import Subject
from jktools.source import Source
from jktools.syntax.arrays import Float32, Int32
from jktools.syntax.assets import faults
from jktools.syntax.assets import small_lines as records
from jktools.syntax.assets.asset import Asset, Reference
from jktools.syntax.assets.lines import LineReader
from jktools.syntax.rows import floats, ints

EFFECT = "the engine shows no particles"
MOST_VERTICES = 0x100


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Cloud(Asset):
    """A PAR file."""

    size: float = float("nan")
    """Width of a particle, JKU."""
    material: str = ""
    radius: float = float("nan")
    """JKU"""
    vertices: Float32
    """(n, 3) JKU."""
    cel: Int32
    """(n,) which cel of the material each particle shows."""


def read_cloud(source: Source, game: str = "jk") -> Cloud:
    """Read a PAR. Never raises: what is wrong is told in `Cloud.diagnostics`."""
    lines = LineReader(source, game, EFFECT)
    lines.value(records.SECTION)
    if lines.is_at(records.VERSION):
        lines.value(records.VERSION)
    size = lines.value(records.SIZE, (records.SECTION,))
    material = lines.value(records.MATERIAL, (records.SECTION,))
    material_line = lines.at - 1
    lines.value(records.LIGHT_MODE, (records.SECTION,))
    lines.value(records.SECTION)
    radius = lines.value(records.RADIUS)
    lines.value(records.INSERT_OFFSET)
    count = lines.value(records.VERTICES)
    heading = lines.at - 1
    rows = lines.rows(records.CLOUD_VERTEX, "vertex", lines.labelled())
    vertices, cel = rows.float_columns("x", 3), rows.int_column("cel")
    lines.outside(rows, "vertex")
    if count is not None:
        lines.counted(heading, "vertices", ints([str(count[0])])[0][0], len(rows))
    if len(rows) > MOST_VERTICES:
        lines.fault(
            faults.TOO_MANY_CLOUD_VERTICES, heading,
            f"the cloud has {len(rows)} vertices, but the engine takes {MOST_VERTICES}",
            f"remove vertices; {EFFECT}",
        )  # fmt: skip
    for vertex in np.flatnonzero(cel < 0).tolist():
        lines.fault(
            faults.ASSET_INDEX_OUT_OF_RANGE, int(rows.lines[vertex]),
            f"vertex {vertex} shows cel {cel[vertex]}, but cels count from 0", "name a cel of the material",
            Subject("vertex", vertex),
        )  # fmt: skip
    lines.at_end("the cloud")
    references = (Reference("mat", str(material[0]), lines.lines.span(material_line)),) if material else ()
    return Cloud(
        source=source,
        diagnostics=lines.faults.finish(),
        references=references,
        size=_number(size),
        material=str(material[0]) if material else "",
        radius=_number(radius),
        vertices=vertices,
        cel=cel,
    )


def _number(values: object) -> float:
    return float(floats([str(values[0])])[0]) if isinstance(values, (list, tuple)) else float("nan")
