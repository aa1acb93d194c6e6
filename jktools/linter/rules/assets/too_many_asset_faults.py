"""JK039: an asset with more faults than are told."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.TOO_MANY_ASSET_FAULTS, since="0.1.0", looks_at=(Asset,))
def too_many_asset_faults() -> None:
    """Report an asset file with more faults than are reported.

    ## Why it matters
    The first hundred are reported; the rest often follow from them.
    """
