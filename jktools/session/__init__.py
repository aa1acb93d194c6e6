"""The calls that Python and the command line share, each part imported when it is first asked for."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jktools.session.building import build_all as build_all
    from jktools.session.checking import Batch as Batch
    from jktools.session.checking import check as check
    from jktools.session.compiling import Built as Built
    from jktools.session.config import Config as Config
    from jktools.session.config import ConfigError as ConfigError
    from jktools.session.config import find_config as find_config
    from jktools.session.config import load_config as load_config
    from jktools.session.levels import build as build
    from jktools.session.levels import discover as discover
    from jktools.session.levels import game_of as game_of
    from jktools.session.levels import load as load
    from jktools.session.levels import mesh as mesh
    from jktools.session.linting import lint as lint
    from jktools.session.scripts import load_script as load_script
    from jktools.session.settings import Ignore as Ignore
    from jktools.session.settings import Settings as Settings

_PARTS = {
    "Batch": "jktools.session.checking",
    "Built": "jktools.session.compiling",
    "Config": "jktools.session.config",
    "ConfigError": "jktools.session.config",
    "Ignore": "jktools.session.settings",
    "Settings": "jktools.session.settings",
    "build": "jktools.session.levels",
    "build_all": "jktools.session.building",
    "check": "jktools.session.checking",
    "discover": "jktools.session.levels",
    "find_config": "jktools.session.config",
    "game_of": "jktools.session.levels",
    "lint": "jktools.session.linting",
    "load": "jktools.session.levels",
    "load_config": "jktools.session.config",
    "load_script": "jktools.session.scripts",
    "mesh": "jktools.session.levels",
}

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


def __getattr__(name: str) -> Any:
    if name not in _PARTS:
        raise AttributeError(f"module 'jktools.session' has no attribute '{name}'")
    value = getattr(import_module(_PARTS[name]), name)
    globals()[name] = value
    return value
