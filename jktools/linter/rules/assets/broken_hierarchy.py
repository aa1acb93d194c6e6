"""JK037: a hierarchy that breaks."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.BROKEN_HIERARCHY, since="0.1.0", looks_at=(Asset,))
def broken_hierarchy() -> None:
    """Report a model whose hierarchy leads nowhere, or leaves a mesh out.

    ## Why it matters
    The engine follows a node's first child and as many siblings as the node announces. A chain that ends early crashes
    it; what the chain does not reach is never shown.
    """
