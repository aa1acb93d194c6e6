"""JK063: a line out of place in a header."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.MALFORMED_COG_HEADER, since="0.1.0", looks_at=(Script,))
def malformed_cog_header() -> None:
    """Report a line that the engine does not expect in a script's header.

    ## Why it matters
    Before `symbols`, and between their `end` and `code`, the engine takes blank lines and comments alone, and comments
    start with `#`, or with `;` in the first column: a line of `//` there makes it refuse the script.

    ## Bad
        // a door
        symbols
        thing door
        end

    ## Good
        # a door
        symbols
        thing door
        end
    """
