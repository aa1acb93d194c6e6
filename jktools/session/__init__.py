"""The calls that Python and the command line share."""

from jktools.session.batch import Batch, Built, build_all, check
from jktools.session.levels import discover, game_of, load
from jktools.session.settings import Settings

__all__ = ["Batch", "Built", "Settings", "build_all", "check", "discover", "game_of", "load"]
