"""JK005: a list without its end."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.MISSING_END, since="0.1.0")
def missing_end() -> None:
    """Report a list that is not closed by the line `end`.

    ## Why it matters
    The engine reads entries until it meets `end`: it swallows the sections that follow. At the end of the file the
    fault does no harm and is a warning; a list that announces no entry needs no end.

    ## Bad
        World templates 3
        - end

    ## Good
        World templates 3

    ## Good
        World scripts 0
        - end
    """
