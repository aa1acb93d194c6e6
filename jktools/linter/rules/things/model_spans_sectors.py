"""JK426: a thing whose model reaches into other sectors."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import msgspec
import numpy as np

from jktools import geometry
from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.occluders import model_pose, placed_vertices
from jktools.linter.rule import Finding, Options, rule
from jktools.model import Level


class Tolerances(Options, frozen=True):
    """How much is let pass."""

    distance: Annotated[float, msgspec.Meta(ge=0, description="JKU that a model may reach through an adjoin")] = 0.05
    convexity: Annotated[float, msgspec.Meta(ge=0, description="JKU off convex up to which a sector is judged")] = 1e-3


@rule("JK426", "model-spans-sectors", severity=Severity.INFO, since="0.1.0", options=Tolerances, on=False)
def model_spans_sectors(level: Level, facts: LevelFacts, options: Tolerances) -> Iterator[Finding]:
    """Report a placed thing whose model reaches more than 0.05 JKU through an adjoin of its sector.

    ## Why it matters
    The engine draws a thing with the sector that it is in. Where another part of the model is in view but that sector
    is not, the thing vanishes: level authors of the community warn of it. Doors and lifts are built that way on
    purpose, which is why the rule is off. The model is taken at rest, at the thing's placed pose; things whose model
    is not at hand are passed over, and so are sectors that are not convex.
    """
    sound = level.sound_sectors & (facts.convexity.distance <= options.convexity)
    for thing in level.things:
        sector = thing.sector_index
        if thing.dropped is not None or not 0 <= sector < len(sound) or not sound[sector]:
            continue
        pose = model_pose(level, thing)
        if pose is None or not np.isfinite([*thing.position, *thing.angles]).all():
            continue
        corners = placed_vertices(pose, thing.position, thing.angles)
        outside = geometry.points_outside(level, corners, np.full(len(corners), sector))
        through = level.document.surfaces.adjoin[outside.surface] >= 0
        distance = np.where((outside.surface >= 0) & through, outside.distance, 0.0)
        worst = int(np.argmax(distance))
        if distance[worst] > options.distance:
            surface = level.surfaces[int(outside.surface[worst])]
            yield Finding(
                Label(thing.field_span("sector")),
                f"the model of {thing.title} reaches {distance[worst]:.4g} JKU through the adjoin of {surface.title}, "
                f"but is drawn with sector {sector} alone",
                "make the model smaller, or move it away from the adjoin",
                thing.subject,
                (Label(surface.head_span, f"surface {surface.index}"),),
            )
