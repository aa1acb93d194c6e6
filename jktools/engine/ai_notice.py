"""Whether an AI notices a target that it could see.

Source: `sithAI_CanDetectSightThing` in the decompiled engine. It is asked when the target was not in sight
the last time, when it is invisible and when the AI is blind; a target in sight stays so. The research
document has nothing on it, so both profiles take these rules.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from jktools.engine.arrays import Float64

NEAR = 2.0
"""JKU: nearer targets are noticed whatever the light and their stance."""
LOST_A_JKU = 0.1
MOST_LOST = 0.6
DARK = 0.5
"""Ambient light of the target's sector below which it is harder to see."""
LEAST_CHANCE = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class Notice:
    """Hold what the chance depends on: n pairs, or one value for all."""

    distance: npt.ArrayLike
    """JKU to the target's rim, as `ai_sight.distance_to_target` gives it."""
    ambient: npt.ArrayLike = 1.0
    """Ambient light of the target's sector."""
    alert: npt.ArrayLike = True
    """The AI is in its active mode."""
    shining: npt.ArrayLike = False
    """The target's field light (actor flag 0x4) or saber is on."""
    sees_in_dark: npt.ArrayLike = False
    """Actor flag 0x2000000 of the AI."""
    crouching: npt.ArrayLike = False
    still: npt.ArrayLike = False
    """The target moves by physics and has no velocity."""
    invisible: npt.ArrayLike = False
    """Actor flag 0x80 of the target, and not 0x8000 of the AI."""
    blind: npt.ArrayLike = False
    """Actor flag 0x800 of the AI."""


@np.errstate(under="ignore")  # what is too small for a float is 0
def chance(notice: Notice) -> Float64:
    """Give the chance, 0.05 to 1, that one look notices an actor or player, (n,); other things always are.

    From 2 JKU on it halves for an AI that is not active; unless the target shines, it falls by a tenth a JKU
    to 0.4, in the dark to ambient + 0.2, and to 3/4 and 1/2 for a target that crouches and one that stands
    still. Invisible targets and blind AIs take a twentieth at any distance. A NaN distance is near, a NaN
    light bright.
    """
    far = np.asarray(notice.distance, np.float64) >= NEAR
    unlit = far & ~np.asarray(notice.shining, np.bool_)
    ambient = np.asarray(notice.ambient, np.float64)
    dark = (ambient < DARK) & ~np.asarray(notice.sees_in_dark, np.bool_)
    beyond = np.clip(np.where(far, np.asarray(notice.distance), NEAR) - NEAR, 0.0, MOST_LOST / LOST_A_JKU)
    shares = (
        np.where(far & ~np.asarray(notice.alert, np.bool_), 0.5, 1.0),
        np.where(unlit, 1.0 - beyond * LOST_A_JKU, 1.0),
        np.where(unlit & dark, ambient + 0.2, 1.0),
        np.where(unlit & np.asarray(notice.crouching, np.bool_), 0.75, 1.0),
        np.where(unlit & np.asarray(notice.still, np.bool_), 0.5, 1.0),
        np.where(np.asarray(notice.invisible, np.bool_), 0.05, 1.0),
        np.where(np.asarray(notice.blind, np.bool_), 0.05, 1.0),
    )
    total = np.ones(())
    for share in shares:
        total = total * share
    return np.asarray(np.clip(total, LEAST_CHANCE, 1.0))
