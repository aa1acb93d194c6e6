"""JK007: a number that a comment cuts."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.COMMENT_IN_NUMBER, since="0.1.0")
def comment_in_number() -> None:
    """Report a `#` in the middle of a word.

    ## Why it matters
    `#` starts a comment anywhere. A tool that writes `1.#QNAN` for an undefined number so cuts the rest of the line,
    and the engine takes left-over values of the line before for the missing fields.

    ## Bad
        World adjoins 2
        0: 0x7 1 1.#QNAN

    ## Good
        World adjoins 2
        0: 0x7 1 1 # a comment
    """
