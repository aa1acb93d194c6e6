"""JK055: words that no statement takes."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.UNUSABLE_WORD, since="0.1.0", looks_at=(Script,))
def unusable_word() -> None:
    """Report `break`, `continue`, `~` and `.`, which the engine's scanner knows and its grammar does not.

    ## Why it matters
    They look like C, and the engine gives up the whole script at the first of them. No loop can be left but by its
    condition, `goto`, `return` or `stop`.

    ## Bad
        while (i < 5)
        {
            if (found) break;
            i = i + 1;
        }

    ## Good
        while (i < 5)
        {
            if (found) goto done;
            i = i + 1;
        }
        done:
            stop;
    """
