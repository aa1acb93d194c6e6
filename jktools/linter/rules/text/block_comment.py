"""JK058: a comment of the kind that COG does not have."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.BLOCK_COMMENT, since="0.1.0", looks_at=(Script,))
def block_comment() -> None:
    """Report a comment between `/*` and `*/`.

    ## Why it matters
    The engine knows comments behind `//` and `#` alone. It reads `/*` as a division and a multiplication, and gives up
    the whole script.

    ## Bad
        /* opens the door */
        MoveToFrame(door, 1, 8.0);

    ## Good
        // opens the door
        MoveToFrame(door, 1, 8.0);
    """
