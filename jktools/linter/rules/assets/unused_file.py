"""JK150: a file that nobody names."""

from jktools.facts.usage_codes import UNUSED_FILE
from jktools.linter.rule import ANY_DOCUMENT, reading_rule


@reading_rule(UNUSED_FILE, since="0.1.0", looks_at=ANY_DOCUMENT, on=False)
def unused_file() -> None:
    """Report a file of a mod that nothing in the mod names, when every level and script of it is linted.

    ## Why it matters
    It makes the pack larger for nothing. It may also be meant to replace a file of the game: with a base (`--base`)
    those are left out, without one they are reported too, which is why this rule is off unless selected.
    """
