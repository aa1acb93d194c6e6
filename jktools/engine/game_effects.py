"""The colour effects and IR modes of the game's own scripts, as the research document quotes them."""

from __future__ import annotations

from jktools.engine.colour_effect import ColourEffect

JEDI_RANKS = range(9)
"""0..8, as items.dat defines jedi_rank."""

FORCE_SEEING = ColourEffect(filters=(0.0, 1.0, 1.0))
"""force_seeing.cog: the world without red."""

IR_GOGGLES = (0.3, 1.0)
"""item_irgoggles.cog: the arguments of EnableIRMode."""


def force_blinding(rank: int) -> ColourEffect:
    """Give what a blinded player sees, by the blinder's jedi rank (kyle.cog)."""
    return ColourEffect(add=(200.0 + 8 * rank, 210.0 + 10 * rank, 200.0 + 8 * rank))


def force_seeing_ir(rank: int) -> tuple[float, float]:
    """Give the arguments of EnableIRMode in force_seeing.cog, by jedi rank: 0.3 to 0.7, and 1."""
    return 0.3 + 0.05 * rank, 1.0
