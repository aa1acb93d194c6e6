"""JK515: more places to jump to than the engine has room for."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.model.cog.program import Program
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import DoWhile, For, If, While

MOST_JUMPS = {"jk": 511, "mots": 1023}
"""By game; slot 0 is not used (sithCogParse in the decompiled engine, and the addresses behind its array)."""


@rule("JK515", "too-many-jumps", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def too_many_jumps(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a script whose symbols and jumps together number more than 511.

    ## Why it matters
    The engine numbers the symbols of a script and the ends of its `if`, `while`, `do` and `for` together: one for an
    `if`, two with `else`, two for a `while`, one for a `do`, three for a `for`. JK 1.0 has room for 511 and does not
    look: the 512th overwrites the compiler's own state. Mysteries of the Sith has room for 1023.
    """
    jumps = _jumps(facts.program)
    symbols = len(facts.program.slots)
    most = MOST_JUMPS[script.game]
    if symbols + jumps > most:
        yield Finding(
            Label(script.source),
            f"the script has {symbols} symbols and {jumps} jumps, {symbols + jumps} together, but the engine has "
            f"room for {most}",
            "split the script in two, or replace chains of if by an array",
        )


def _jumps(program: Program) -> int:
    branches = sum(1 if each.otherwise is None else 2 for each in program.of_kind(If))
    return branches + 2 * len(program.of_kind(While)) + len(program.of_kind(DoWhile)) + 3 * len(program.of_kind(For))
