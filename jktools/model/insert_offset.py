"""The insert offset of a body's model: read from its 3DO, or known of a model of the base game."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from jktools.model.resources import Kind, Resources
from jktools.source.container import canonical

KNOWN: Mapping[str, tuple[float, float, float]] = MappingProxyType({"ky.3do": (-5.0e-05, 0.0, 0.120114)})
"""Insert offsets of models that ship with the game, JKU; for levels whose base is not at hand.

ky.3do: verified in the game's own file (research notes on asset formats, 3DO).
"""


@dataclass(frozen=True, slots=True)
class InsertOffset:
    """Where a model's origin lies from the place it is inserted at, JKU. A body hovers by its z."""

    x: float
    y: float
    z: float
    origin: str
    """The file that says so, or `known of the base game`: outputs tell which."""

    @property
    def known(self) -> bool:
        """Whether it comes from the table and not from the file itself."""
        return self.origin == KNOWN_ORIGIN


KNOWN_ORIGIN = "known of the base game"


def insert_offset(resources: Resources, name: str) -> InsertOffset | None:
    """The insert offset of a model by its name; None when its file is not at hand and the table lacks it.

    A file beside the level or in a base wins over the table; one that does not say its offset is unknown.
    """
    model = resources.model(name)
    if model is not None:
        x, y, z = map(float, model.insert_offset)
        return InsertOffset(x, y, z, model.source.path) if math.isfinite(x + y + z) else None
    if resources.find(Kind.MODEL, name) is None and canonical(name) in KNOWN:
        # A model's file is read in single precision; what is known of one must not differ from it.
        x, y, z = np.array(KNOWN[canonical(name)], np.float32).tolist()
        return InsertOffset(x, y, z, KNOWN_ORIGIN)
    return None
