"""JK010: a file that its pack holds only in part."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.CUT_OFF_FILE, since="0.1.0")
def cut_off_file() -> None:
    """Report a file of which the pack's directory claims more bytes than the pack has.

    ## Why it matters
    The pack was cut off while it was copied or written. What is there is read; what follows is lost.
    """
