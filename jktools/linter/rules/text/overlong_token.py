"""JK062: a token that is too long."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.OVERLONG_TOKEN, since="0.1.0", looks_at=(Script,))
def overlong_token() -> None:
    """Report a string, a comment or an unpaired quote behind which the scanner runs out of memory.

    ## Why it matters
    The engine's scanner holds 16 KB of text. For a quote that nothing closes it looks for the next one to the end of
    the file; where that is farther away, the game ends with "scanner input buffer overflow".
    """
