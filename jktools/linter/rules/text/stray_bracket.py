"""JK060: a bracket that closes nothing."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.STRAY_BRACKET, since="0.1.0", looks_at=(Script,))
def stray_bracket() -> None:
    """Report a closing bracket that closes nothing.

    ## Why it matters
    The engine gives up the whole script there.

    ## Bad
        startup:
            stop;
        }

    ## Good
        startup:
        {
            stop;
        }
    """
