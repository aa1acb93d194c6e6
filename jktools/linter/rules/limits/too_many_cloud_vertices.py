"""JK818: a cloud with too many particles."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.TOO_MANY_CLOUD_VERTICES, since="0.1.0", looks_at=(Asset,))
def too_many_cloud_vertices() -> None:
    """Report a PAR file with more than 256 vertices.

    ## Why it matters
    The engine refuses the file and shows no particles.
    """
