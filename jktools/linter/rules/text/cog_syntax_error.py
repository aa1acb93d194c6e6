"""JK051: code that the grammar does not allow."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.COG_SYNTAX_ERROR, since="0.1.0", looks_at=(Script,))
def cog_syntax_error() -> None:
    """Report a place where the code is not what the engine's grammar allows.

    ## Why it matters
    The engine gives up the whole script at the first such place.

    ## Bad
        for (i = 0; i < 5;)
        {
            Print("five times");
        }

    ## Bad
        x = +1;

    ## Good
        for (i = 0; i < 5; i = i + 1)
        {
            Print("five times");
        }
    """
