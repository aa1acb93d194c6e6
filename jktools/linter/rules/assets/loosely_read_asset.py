"""JK031: a file that the engine reads as something else."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.LOOSELY_READ_ASSET, since="0.1.0", looks_at=(Asset,))
def loosely_read_asset() -> None:
    """Report a line of an asset file that is not well-formed, though the engine reads something from it.

    ## Why it matters
    The engine takes the longest prefix that is a number, 0 where there is none, and passes over what it does not
    understand. The file loads, with other values than its author wrote.

    ## Bad
        # crate.spr
        crate.mat 0 0.5x 0.5 4 3 1 0 0 0 0

    ## Bad
        # door.snd
        create

    ## Good
        # door.snd
        create dooropen.wav
    """
