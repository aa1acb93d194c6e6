"""JK032: a count that is not met."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.ASSET_COUNT_MISMATCH, since="0.1.0", looks_at=(Asset,))
def asset_count_mismatch() -> None:
    """Report a heading in an asset file that announces another number than follow.

    ## Why it matters
    The engine reads as many lines as the heading says. With one too few or too many it takes a heading for a record,
    and refuses the file.

    ## Bad
        # ky.uni
        MSGS 1
        "A" 0 "one"
        "B" 0 "two"
        END

    ## Good
        # ky.uni
        MSGS 2
        "A" 0 "one"
        "B" 0 "two"
        END
    """
