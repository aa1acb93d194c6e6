"""JK059: a value behind return."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.RETURN_WITH_VALUE, since="0.1.0", looks_at=(Script,))
def return_with_value() -> None:
    """Report a value behind `return` or `stop`.

    ## Why it matters
    Both end the handler and take nothing: a value behind them makes the engine give up the whole script. What a message
    hands back is said by the verb `ReturnEx`.

    ## Bad
        damaged:
            return 0;

    ## Good
        damaged:
            ReturnEx(0);
            return;
    """
