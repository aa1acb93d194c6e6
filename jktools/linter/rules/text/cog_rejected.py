"""JK050: a script that the engine refuses."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.COG_REJECTED, since="0.1.0", looks_at=(Script,))
def cog_rejected() -> None:
    """Report a script that the engine refuses to load.

    ## Why it matters
    The engine says "PARSER syntax error" in a log that nobody sees, and plays on without the script: the door never
    opens. It creates no cog for the lines of the level that name the script, and counts no number for them either, so
    that every later cog of the level has a number one lower than its line says and messages by number go astray.

    One such finding stands for the script; JK051 to JK065 tell each place. jktools reads on behind it, and says what
    else is wrong.

    ## Bad
        startup:
            Print("hello")

    ## Good
        startup:
            Print("hello");
    """
