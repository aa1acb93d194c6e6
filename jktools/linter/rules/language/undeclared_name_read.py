"""JK530: a name that is read but that nothing declares or assigns."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.model.cog.program import Role
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Assign, Index, Name


@rule("JK530", "undeclared-name-read", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def undeclared_name_read(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a name that is read, but that nothing declares or assigns.

    ## Why it matters
    The engine makes a variable of every name that it does not know, a flex of 0, and says nothing. So a misspelt name
    is 0 for ever. The nearest name of the script is suggested.

    A name that the script assigns somewhere is not reported: it works, since the engine declares it on the spot.

    ## Bad
        symbols
        message startup
        thing elevator
        flex speed=2.0
        end
        code
        startup:
            MoveToFrame(elevator, 1, sped);
            return;
        end

    ## Good
        symbols
        message startup
        thing elevator
        flex speed=2.0
        end
        code
        startup:
            MoveToFrame(elevator, 1, speed);
            return;
        end
    """
    program = facts.program
    if not facts.is_whole:
        return
    reached = min((_base(facts, part) for part in program.of_kind(Assign)), default=len(program.slots))
    own = [name for name, slot in program.slot_of.items() if slot.declared is not None or name in program.assigned]
    for name, places in program.read.items():
        if program.role_of(name) is not Role.IMPLICIT or name in program.assigned:
            continue
        if name in program.labels or program.slot_of[name].index > reached:
            continue
        if facts.is_doubtful(places[0].start, places[0].end):
            continue
        yield Finding(
            facts.label(places[0]),
            f'nothing declares or assigns "{name}", so that it is always 0 here',
            did_you_mean(name, own) or "declare it in the symbols, or assign it first",
        )


def _base(facts: ScriptFacts, part: Assign) -> int:
    """The slot from which an array is written, or one behind the last for another assignment."""
    slots = facts.program.slot_of
    if isinstance(part.target, Index) and isinstance(part.target.base, Name):
        slot = slots.get(part.target.base.name)
        if slot is not None:
            return slot.index
    return len(facts.program.slots)
