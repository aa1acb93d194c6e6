"""JK034: a file that ends too early."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.CUT_OFF_ASSET, since="0.1.0", looks_at=(Asset,))
def cut_off_asset() -> None:
    """Report a MAT, CMP or WAV that ends before its header says.

    ## Why it matters
    The engine reads on beyond the end and shows or plays what happens to lie in memory, or refuses the file.
    """
