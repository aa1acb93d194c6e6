"""What each pass answers at one tier: plain data, so that it can be sent from one process to another."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.facts.basins import Basin
from jktools.facts.ledges import Ledges
from jktools.geometry import VisibleSectors
from jktools.tradeoff.overlay import Intervals

Float64 = npt.NDArray[np.float64]


class Viewed(NamedTuple):
    """The visible sectors, and what segments say of them."""

    visible: VisibleSectors
    segments: int
    """That see their target on a way that enters its sector."""
    refuted: int
    """Of these, how many join sectors that do not see each other by the matrix: each proves it wrong."""
    filed: npt.NDArray[np.bool_]
    """(n, n): what the file has. At `fast` it is about the vertices on their grid."""


class Walked(NamedTuple):
    """The ledges of one body."""

    length: Float64
    """(edges,): of each floor edge, JKU."""
    intervals: Intervals
    kind: npt.NDArray[np.uint8]
    drop_start: Float64
    drop_end: Float64


class Hollow(NamedTuple):
    """One basin of one body."""

    body: int
    surfaces: frozenset[int]
    shallowest: float
    deepest: float
    entered: int
    left: int


class Stop(NamedTuple):
    """How far one template goes on after its keys are released, JKU: the least and the greatest that is said."""

    template: str
    gait: str
    least: float
    most: float


def walked(ledges: Ledges) -> Walked:
    """The ledges of a body as plain data."""
    here, there = ledges.edges.ends(np.arange(len(ledges.edges.surface)))
    return Walked(
        np.linalg.norm(there - here, axis=1),
        Intervals(ledges.edge, ledges.start, ledges.end),
        ledges.kind,
        ledges.drop_start,
        ledges.drop_end,
    )


def hollow(body: int, basin: Basin) -> Hollow:
    """A basin as plain data."""
    return Hollow(body, frozenset(basin.surfaces), basin.shallowest, basin.deepest, int(basin.entered), int(basin.left))
