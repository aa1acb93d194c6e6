"""The level with its references resolved."""

from jktools.model.level import Level
from jktools.model.objects import Cog, Template, Thing
from jktools.model.views import Adjoin, Sector, Surface

__all__ = ["Adjoin", "Cog", "Level", "Sector", "Surface", "Template", "Thing"]
