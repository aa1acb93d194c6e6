"""JK036: a version that nobody knows."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.UNKNOWN_ASSET_VERSION, since="0.1.0", looks_at=(Asset,))
def unknown_asset_version() -> None:
    """Report an asset file of a version or kind that no known file has.

    ## Why it matters
    The engine reads it as one that it knows. It was made for another game, or is damaged.
    """
