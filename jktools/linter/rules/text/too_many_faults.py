"""JK009: a file with more faults than are told."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.TOO_MANY_FAULTS, since="0.1.0")
def too_many_faults() -> None:
    """Report how many faults of reading are not told one by one.

    ## Why it matters
    Reading tells at most 1000 faults of a file, so that a file of garbage does not yield a report longer than itself.
    """
