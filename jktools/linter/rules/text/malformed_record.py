"""JK001: a record that the engine cannot read."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.MALFORMED_RECORD, since="0.1.0")
def malformed_record() -> None:
    """Report a line that the engine cannot read as the record that belongs there.

    ## Why it matters
    The engine stops at the first such line and refuses the whole level with a bare "Parse problem in file".
    jktools keeps the record's place, reads on, and tells every one of them.

    ## Bad
        World vertices 12
        3: 0 1

    ## Bad
        Sector 1
        Flags none

    ## Good
        World vertices 12
        3: 0 1 0
    """
