"""JK057: a number that goes on in letters."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.MALFORMED_NUMBER, since="0.1.0", looks_at=(Script,))
def malformed_number() -> None:
    """Report a number with letters behind it.

    ## Why it matters
    The engine's scanner takes `1.5f` for a number and a name, which fit nowhere side by side, and gives up the script.

    ## Bad
        x = 1.5f;

    ## Bad
        x = 0xg1;

    ## Good
        x = 1.5;
    """
