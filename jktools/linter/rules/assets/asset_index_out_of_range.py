"""JK033: an index that points nowhere."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.ASSET_INDEX_OUT_OF_RANGE, since="0.1.0", looks_at=(Asset,))
def asset_index_out_of_range() -> None:
    """Report an index in an asset file that names nothing.

    ## Why it matters
    The engine does not check the vertex of a face, the texture of a cel or the mesh of a node: it reads whatever lies
    behind its table, and crashes or shows garbage.

    ## Bad
        # episode.jk
        "Title"
        TYPE 1
        SEQ 1
        10: 1 1 LEVEL a.jkl 0 0 20 -1
        end

    ## Good
        # episode.jk
        "Title"
        TYPE 1
        SEQ 1
        10: 1 1 LEVEL a.jkl 0 0 -1 -1
        end
    """
