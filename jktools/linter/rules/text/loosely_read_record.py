"""JK002: a record that the engine reads as something else."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.LOOSELY_READ_RECORD, since="0.1.0")
def loosely_read_record() -> None:
    """Report a line that is not well-formed, though the engine reads something from it.

    ## Why it matters
    The engine takes the longest prefix that is a number, 0 where there is none, and never looks at what follows
    the last field. The level loads, with other values than its author wrote.

    ## Bad
        World adjoins 2
        0: 0x7 one 1

    ## Bad
        World vertices 12
        3: 0 1 0 0.5

    ## Good
        World vertices 12
        3: 0 1 0
    """
