"""JK531: a call of a verb that does not exist."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.model.cog.program import Role
from jktools.syntax.cog import Script

FOREIGN = frozenset({"elseif", "switch"})
"""Words of other languages that look like calls."""


@rule("JK531", "unknown-verb", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def unknown_verb(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a call of a verb that no version of the game has.

    ## Why it matters
    The engine says nothing: the call does nothing, its arguments stay on the stack, and whatever asks for its value
    gets one of them.

    Verbs that a custom build of the game adds are declared in the configuration, under `[cog.verbs]`.

    ## Bad
        startup:
            SetPuls(0.5);
            return;

    ## Good
        startup:
            SetPulse(0.5);
            return;
    """
    program = facts.program
    for name, places in program.called.items():
        if script.rejected and name in FOREIGN:
            continue  # the fault where the engine stops tells of it
        role = program.role_of(name)
        if role is Role.VERB or name in program.labels or facts.vocabulary.elsewhere(name) is not None:
            continue
        if role is Role.SYMBOL and name in facts.vocabulary.verbs:
            continue
        what = {Role.SYMBOL: "a symbol", Role.MESSAGE: "a message", Role.SHARED: "a shared variable"}.get(role)
        yield Finding(
            facts.label(places[0]),
            f'"{name}" is {what}, but is called as a verb' if what else f'there is no verb "{name}"',
            did_you_mean(name, facts.vocabulary.verbs) or "name a verb, or declare it under [cog.verbs]",
            related=tuple(facts.label(place, f"{name} again") for place in places[1:]),
        )
