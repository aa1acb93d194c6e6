"""Inputs kept where no product of theirs can overflow."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64

LIMIT = 1e30
"""Greatest magnitude that a rule computes with, and 1 / LIMIT the least, in the unit of the input.

The longest product in this package has ten factors (the position in a fourth-order step), and 1e30 to the
tenth is the last power of 1e30 below the greatest float64, 1.8e308. Nothing in the game comes near either
end.
"""


def bounded(values: npt.ArrayLike) -> Float64:
    """Convert to float64, saturate at `LIMIT`, infinities too, and flush what is below 1 / `LIMIT` to 0.

    NaN passes through.
    """
    single: object = values
    if isinstance(single, float) and (single == 0 or 1 / LIMIT <= abs(single) <= LIMIT):
        return np.asarray(single, np.float64)  # asked twenty times a tick, the arrays' way is half its cost
    array = np.asarray(values, np.float64)
    kept = np.minimum(np.maximum(array, -LIMIT), LIMIT)
    return np.where(np.abs(kept) < 1 / LIMIT, 0.0, kept)


def length(vectors: npt.ArrayLike) -> Float64:
    """Measure vectors along the last axis: `(..., n) -> (...)`, without overflow or underflow of the squares."""
    array = np.abs(bounded(vectors))
    scale = array.max(axis=-1, keepdims=True)
    unit = np.divide(array, scale, out=np.zeros_like(array), where=scale != 0)
    with np.errstate(under="ignore"):
        root: Float64 = np.sqrt(np.square(unit).sum(axis=-1))
    size: Float64 = root * scale[..., 0]
    return size
