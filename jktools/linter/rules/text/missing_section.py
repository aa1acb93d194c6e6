"""JK003: a level without a section that it needs."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.MISSING_SECTION, since="0.1.0")
def missing_section() -> None:
    """Report a level that lacks COPYRIGHT, HEADER, GEORESOURCE or SECTORS.

    ## Why it matters
    Without a header there is no gravity; without one of the others the engine refuses the level.

    ## Bad
        - Section: COPYRIGHT

    ## Good
        World vertices 12
        3: 0 1 0
    """
