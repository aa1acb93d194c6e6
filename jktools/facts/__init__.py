"""What can be known about a level, each fact worked out on first use and kept."""

from jktools.facts.level import LevelFacts

__all__ = ["LevelFacts"]
