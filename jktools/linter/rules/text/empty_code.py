"""JK056: code without a statement."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.EMPTY_CODE, since="0.1.0", looks_at=(Script,))
def empty_code() -> None:
    """Report a script whose code holds no statement.

    ## Why it matters
    In the engine's grammar code has at least one statement: it refuses a script without any, which editors offer as a
    template.

    ## Bad
        symbols
        message startup
        end
        code
        end

    ## Good
        symbols
        message startup
        end
        code
        startup:
            ;
        end
    """
