"""JK030: a file that the engine refuses."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.MALFORMED_ASSET, since="0.1.0", looks_at=(Asset,))
def malformed_asset() -> None:
    """Report an asset file with a line, or a header, that the engine cannot read.

    ## Why it matters
    The engine stops at the first such line and loads nothing of the file: a model becomes dflt.3do, a sprite or an
    animation that the level lists fails the level, particles and sounds are left out.

    ## Bad
        # crate.spr
        crate.mat 3 0.5 0.5 4 3 1 0 0 0 0

    ## Good
        # crate.spr
        crate.mat 0 0.5 0.5 4 3 1 0 0 0 0
    """
