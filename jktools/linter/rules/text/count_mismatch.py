"""JK004: a heading that announces another number of records."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.COUNT_MISMATCH, since="0.1.0")
def count_mismatch() -> None:
    """Report a heading whose number is not that of the records that follow.

    ## Why it matters
    In GEORESOURCE and SECTORS the engine reads exactly as many records as announced and refuses the level when
    another line comes. In lists it drops what is beyond the number, or, for materials, refuses the level. Room to
    spare in a list is normal and not reported.

    ## Bad
        World vertices 13

    ## Bad
        World templates 2

    ## Good
        World vertices 12
    """
