"""JK008: a section that stands in the file twice."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.REPEATED_SECTION, since="0.1.0")
def repeated_section() -> None:
    """Report a section that the level has already.

    ## Why it matters
    The engine reads the second one over the first; what then refers to what is undefined. jktools keeps the first.

    ## Bad
        + Section: COPYRIGHT

    ## Good
        World vertices 12
        3: 0 1 0
    """
