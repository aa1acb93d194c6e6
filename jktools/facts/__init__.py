"""What can be known about a level or a script, each fact worked out on first use and kept."""

from jktools.facts.level import LevelFacts
from jktools.facts.script import ScriptFacts

__all__ = ["LevelFacts", "ScriptFacts"]
