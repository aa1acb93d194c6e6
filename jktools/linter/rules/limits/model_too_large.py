"""JK816: a model beyond the engine's limits."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.MODEL_TOO_LARGE, since="0.1.0", looks_at=(Asset,))
def model_too_large() -> None:
    """Report a model with more than the engine takes.

    512 vertices, 768 texture vertices and 512 faces a mesh, 24 corners a face, 4 geosets.

    ## Why it matters
    The engine rejects the model and shows dflt.3do instead; with more geosets it writes beyond its memory.
    """
