"""JK065: a script with too many faults."""

from jktools.linter.rule import reading_rule
from jktools.syntax.cog import Script, faults


@reading_rule(faults.TOO_MANY_COG_FAULTS, since="0.1.0", looks_at=(Script,))
def too_many_cog_faults() -> None:
    """Report a script with more than a hundred places that the engine cannot read.

    ## Why it matters
    Such a file is mostly no script at all. The places behind the first hundred are not looked at.
    """
