"""The calls that Python and the command line share."""

from jktools.session.building import build_all
from jktools.session.checking import Batch, check
from jktools.session.compiling import Built
from jktools.session.config import Config, ConfigError, find_config, load_config
from jktools.session.levels import build, discover, game_of, load, mesh
from jktools.session.linting import lint
from jktools.session.scripts import load_script
from jktools.session.settings import Ignore, Settings

__all__ = [
    "Batch",
    "Built",
    "Config",
    "ConfigError",
    "Ignore",
    "Settings",
    "build",
    "build_all",
    "check",
    "discover",
    "find_config",
    "game_of",
    "lint",
    "load",
    "load_config",
    "load_script",
    "mesh",
]
