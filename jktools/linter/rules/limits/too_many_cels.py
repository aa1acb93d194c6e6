"""JK817: a material with more cels than the engine keeps."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.TOO_MANY_CELS, since="0.1.0", looks_at=(Asset,))
def too_many_cels() -> None:
    """Report a material with more than 16 cels.

    ## Why it matters
    The engine does not read the rest, so that an animation lacks its end.
    """
