"""JK020: a comment that hides nothing."""

from jktools.diagnostics import UNUSED_SUPPRESSION
from jktools.linter.rule import ANY_DOCUMENT, reading_rule


@reading_rule(UNUSED_SUPPRESSION, since="0.1.0", looks_at=ANY_DOCUMENT)
def unused_suppression() -> None:
    """Report a comment `jktools: ignore` that hides no finding.

    ## Why it matters
    The fault has been mended, or stands on another line: the comment would hide the next one that comes. Codes that
    did not run are left alone. An `[[ignore]]` of the configuration that hides nothing is told too, at its file.

    ## Bad
        World adjoins 2
        1: 0x7 0 1 # jktools: ignore JK201 -- mended long ago

    ## Good
        World adjoins 2
        1: 0x7 0 1
    """
