"""JK053: a bracket that is never closed."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.UNCLOSED_BRACKET, since="0.1.0", looks_at=(Script,))
def unclosed_bracket() -> None:
    """Report a bracket that is never closed.

    ## Why it matters
    The engine gives up the whole script, for a missing brace often far behind the place where it should stand.

    ## Bad
        if (x == 1
        {
            stop;
        }

    ## Bad
        if (x == 1)
        {
            stop;

    ## Good
        if (x == 1)
        {
            stop;
        }
    """
