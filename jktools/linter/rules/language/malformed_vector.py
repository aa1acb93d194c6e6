"""JK518: a vector that is not three numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Vector

_THREE = re.compile(r"\s*(?:[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?(?:\s+|$)){3}")


@rule("JK518", "malformed-vector", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def malformed_vector(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a vector literal that is not three numbers with blanks between.

    ## Why it matters
    The engine reads numbers up to the first character that fits in none, commas included, and takes 0 for those that
    are missing: `'1,2,3'` is (1, 0, 0).

    ## Bad
        up = '0,0,1';

    ## Bad
        up = '1 2';

    ## Good
        up = '0 0 1';
    """

    for part in facts.program.of_kind(Vector):
        if not _THREE.fullmatch(part.text):
            read = " ".join(f"{x:g}" for x in part.value)
            yield Finding(
                facts.label(part),
                f"the vector is written '{part.text}', but the engine reads '{read}'",
                "write three numbers with blanks between",
            )
