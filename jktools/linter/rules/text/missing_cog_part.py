"""JK064: a script that lacks a part."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.MISSING_COG_PART, since="0.1.0", looks_at=(Script,))
def missing_cog_part() -> None:
    """Report a script without its `symbols`, their `end`, or its `code`.

    ## Why it matters
    The engine refuses such a script.

    ## Bad
        symbols
        thing door
        code
            stop;

    ## Good
        symbols
        thing door
        end
        code
            stop;
    """
