"""JK021: a comment to jktools that cannot be understood."""

from jktools.diagnostics import MALFORMED_SUPPRESSION
from jktools.linter.rule import ANY_DOCUMENT, reading_rule


@reading_rule(MALFORMED_SUPPRESSION, since="0.1.0", looks_at=ANY_DOCUMENT)
def malformed_suppression() -> None:
    """Report a comment `jktools: ...` that cannot be understood, or that names no rule.

    ## Why it matters
    It hides nothing. Write `# jktools: ignore JK201 -- reason` behind a record or on the line before it, or
    `# jktools: ignore-file JK301 -- reason` anywhere.

    ## Bad
        World adjoins 2
        1: 0x7 0 1 # jktools: hide JK201

    ## Bad
        World adjoins 2
        1: 0x7 0 1 # jktools: ignore JK299

    ## Good
        World adjoins 2
        1: 0x7 0 1 # JED wrote this
    """
