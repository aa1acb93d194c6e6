"""JK035: a file that goes on."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.SURPLUS_IN_ASSET, since="0.1.0", looks_at=(Asset,))
def surplus_in_asset() -> None:
    """Report an asset file that goes on behind its end.

    ## Why it matters
    Nobody reads the rest. It may be what an editor left there, or the file says less than its author thinks.

    ## Bad
        # crate.spr
        crate.mat 0 0.5 0.5 4 3 1 0 0 0 0
        glass.mat 0 0.5 0.5 4 3 1 0 0 0 0

    ## Good
        # crate.spr
        crate.mat 0 0.5 0.5 4 3 1 0 0 0 0
    """
