"""JK902: a file on which jktools itself failed."""

from jktools.linter.rule import ANY_DOCUMENT, FILE_FAILED, reading_rule


@reading_rule(FILE_FAILED, since="0.1.0", looks_at=ANY_DOCUMENT)
def file_failed() -> None:
    """Report a file whose reading raised an error: a bug in jktools, not in the level.

    ## Why it matters
    Nothing is known of this file; the others were read. The exit status is 3.
    """
