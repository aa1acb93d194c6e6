"""JK052: a statement without its semicolon."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.MISSING_SEMICOLON, since="0.1.0", looks_at=(Script,))
def missing_semicolon() -> None:
    """Report a statement that does not end with a semicolon.

    ## Why it matters
    The engine reads on into the next line, finds nothing that fits, and gives up the whole script.

    ## Bad
        x = 1
        y = 2;

    ## Good
        x = 1;
        y = 2;
    """
