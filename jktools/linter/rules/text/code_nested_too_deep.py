"""JK061: code nested too deep."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.CODE_NESTED_TOO_DEEP, since="0.1.0", looks_at=(Script,))
def code_nested_too_deep() -> None:
    """Report code that is nested deeper than the engine's parser can hold.

    ## Why it matters
    The parser keeps every symbol that is not finished on a stack of 300: some 48 `else if` in a row, 58 blocks of `if`
    in each other, or 293 parentheses. One more, and it gives up the whole script. The number is that of OpenJKDF2, and
    the default of the tool that made both parsers; that of the game of 1997 is not known.
    """
