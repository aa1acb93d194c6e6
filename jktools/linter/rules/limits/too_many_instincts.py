"""JK819: more instincts than the engine keeps."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.TOO_MANY_INSTINCTS, since="0.1.0", looks_at=(Asset,))
def too_many_instincts() -> None:
    """Report an AI file with more than 16 instincts.

    ## Why it matters
    The engine passes over the rest, without a word.
    """
