"""JK901: a rule of jktools that failed."""

from jktools.linter.rule import ANY_DOCUMENT, RULE_FAILED, reading_rule


@reading_rule(RULE_FAILED, since="0.1.0", looks_at=ANY_DOCUMENT)
def rule_failed() -> None:
    """Report a rule that raised an error: a bug in jktools, not in the level.

    ## Why it matters
    The other rules still ran, but what this one would have found is unknown. The exit status is 3.
    """
