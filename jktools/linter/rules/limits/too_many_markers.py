"""JK820: more markers than the engine takes."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.TOO_MANY_MARKERS, since="0.1.0", looks_at=(Asset,))
def too_many_markers() -> None:
    """Report a KEY file with more than 8 markers.

    ## Why it matters
    The engine refuses the animation, and a level that lists it.
    """
