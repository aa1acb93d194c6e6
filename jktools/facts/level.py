"""The facts of one level."""

from __future__ import annotations

from functools import cached_property

from jktools import geometry
from jktools.geometry import Concavity, Convexity, Outside, Planarity
from jktools.geometry.validity import Int32
from jktools.model import Level


class LevelFacts:
    """Facts are pulled: nothing is computed that no rule or pass asks for, and nothing twice."""

    def __init__(self, level: Level) -> None:
        """Know nothing yet."""
        self.level = level

    @cached_property
    def convexity(self) -> Convexity:
        """Each sector's worst vertex behind one of its surfaces."""
        return geometry.sector_convexity(self.level)

    @cached_property
    def planarity(self) -> Planarity:
        """Each surface's corner farthest from its plane."""
        return geometry.surface_planarity(self.level)

    @cached_property
    def concavity(self) -> Concavity:
        """Each surface's most reflex corner."""
        return geometry.surface_concavity(self.level)

    @cached_property
    def collide_boxes(self) -> tuple[Int32, Outside]:
        """The sectors that have a collide box, and how far each box sticks out."""
        return geometry.collide_boxes_outside(self.level)
