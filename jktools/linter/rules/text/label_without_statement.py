"""JK054: a label at the end of a block or of the code."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.LABEL_WITHOUT_STATEMENT, since="0.1.0", looks_at=(Script,))
def label_without_statement() -> None:
    """Report a label that no statement follows.

    ## Why it matters
    In the engine's grammar a label belongs to a statement. One before a closing brace, or before the final `end`, makes
    it give up the whole script.

    ## Bad
        startup:
            stop;
        killed:

    ## Good
        startup:
            stop;
        killed:
            ;
    """
