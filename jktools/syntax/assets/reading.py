"""Which reader an asset file goes to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from jktools.source import Source
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.cloud import read_cloud
from jktools.syntax.assets.colormap import read_colormap
from jktools.syntax.assets.keyframe import read_keyframe
from jktools.syntax.assets.material import read_material
from jktools.syntax.assets.small import (
    read_ai_class,
    read_episode,
    read_items,
    read_puppet,
    read_sound_class,
    read_sprite,
)
from jktools.syntax.assets.strings import read_strings
from jktools.syntax.assets.threedo import read_model
from jktools.syntax.assets.wave import read_wave

_TEXT: Mapping[str, Callable[[Source, str], Asset]] = MappingProxyType(
    {
        "3do": read_model,
        "ai": read_ai_class,
        "dat": read_items,
        "jk": read_episode,
        "key": read_keyframe,
        "par": read_cloud,
        "pup": read_puppet,
        "snd": read_sound_class,
        "spr": read_sprite,
    }
)
_WHOLE: Mapping[str, Callable[[Source], Asset]] = MappingProxyType(
    {"cmp": read_colormap, "mat": read_material, "uni": read_strings, "wav": read_wave}
)

ASSET_EXTENSIONS = frozenset({*_TEXT, *_WHOLE})


def read_asset(source: Source, extension: str, game: str = "jk") -> Asset:
    """Read a file of one of `ASSET_EXTENSIONS`. What is wrong inside is in `Asset.diagnostics`. Raises KeyError."""
    if extension in _TEXT:
        return _TEXT[extension](source, game)
    return _WHOLE[extension](source)
