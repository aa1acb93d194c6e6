"""The level with its references resolved."""

from jktools.model.level import Level
from jktools.model.views import Adjoin, Cog, Sector, Surface, Template, Thing

__all__ = ["Adjoin", "Cog", "Level", "Sector", "Surface", "Template", "Thing"]
