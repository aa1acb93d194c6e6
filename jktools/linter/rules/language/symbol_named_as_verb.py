"""JK549: a symbol with the name of a verb, a message or a shared variable."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.model.cog.messages import GLOBALS
from jktools.syntax.cog import Script


@rule("JK549", "symbol-named-as-verb", severity=Severity.INFO, since="0.1.0", on=False, looks_at=Script)
def symbol_named_as_verb(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a symbol that has the name of a verb, of a message, or of a variable that all scripts share.

    ## Why it matters
    The script sees only the symbol. That works as long as it does not want the verb: JK548 reports when it does. It is
    off by default.

    ## Bad
        symbols
        message startup
        flex sleep=2.0
        end
        code
        startup:
            SetPulse(sleep);
            return;
        end

    ## Good
        symbols
        message startup
        flex pause=2.0
        end
        code
        startup:
            SetPulse(pause);
            return;
        end
    """
    for slot in facts.program.slots:
        if slot.declared is None or slot.type == "message":
            continue
        if slot.name in facts.vocabulary.verbs:
            kind = "a verb"
        elif slot.name in facts.vocabulary.messages:
            kind = "a message"
        elif slot.name in GLOBALS:
            kind = "a variable that all scripts share"
        else:
            continue
        yield Finding(
            facts.label(slot.declared),
            f'symbol "{slot.name}" has the name of {kind}, which the script can then not reach',
            "give it another name",
        )
