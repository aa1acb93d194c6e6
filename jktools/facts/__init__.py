"""What can be known about a level, a script or an asset, each fact worked out on first use and kept."""

from jktools.facts.asset import AssetFacts
from jktools.facts.level import LevelFacts
from jktools.facts.script import ScriptFacts

__all__ = ["AssetFacts", "LevelFacts", "ScriptFacts"]
