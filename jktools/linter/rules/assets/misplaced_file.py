"""JK151: a file in the wrong folder."""

from jktools.facts.usage_codes import MISPLACED_FILE
from jktools.linter.rule import ANY_DOCUMENT, reading_rule


@reading_rule(MISPLACED_FILE, since="0.1.0", looks_at=ANY_DOCUMENT, on=False)
def misplaced_file() -> None:
    """Report a file in a pack that lies where the engine does not look for its kind.

    ## Why it matters
    The engine finds a material in `mat` and `3do/mat` only, a sound in `sound` and `voice`, and so on. What lies
    elsewhere in a pack is never found. Off unless selected: packs carry pictures and notes of their makers, too.
    """
