"""JK532: a verb that only another version of the game has."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script

TITLES = {
    "jk": "Jedi Knight",
    "mots": "Mysteries of the Sith",
    "openjkdf2": "OpenJKDF2",
    "droidworks": "Droidworks",
}


@rule("JK532", "verb-of-other-game", severity=Severity.ERROR, since="0.1.0", looks_at=Script)
def verb_of_other_game(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report a call of a verb that only another version of the game has.

    ## Why it matters
    Mysteries of the Sith, Droidworks and OpenJKDF2 added verbs. Where a game does not have one, the call does nothing
    and its arguments stay on the stack. A verb that takes none, as jkSyncForcePowers at the end of many a script of
    Jedi Knight, does no harm, and is a warning. A file of a GOO pack is read as one of Mysteries of the Sith; `--game`
    chooses.

    ## Bad
        startup:
            WorldFlash(1.0, 0.5);
            return;

    ## Good
        startup:
            AddDynamicAdd(GetLocalPlayerThing(), 255, 255, 255);
            return;
    """
    program = facts.program
    for name, places in program.called.items():
        verb = facts.vocabulary.elsewhere(name)
        if verb is None or name in program.labels:
            continue
        slot = program.slot_of.get(name)
        if slot is not None and slot.declared is not None:
            continue
        yield Finding(
            facts.label(places[0]),
            f'"{name}" is a verb of {TITLES[verb.game]}, but this is a script of {TITLES[facts.vocabulary.game]}',
            "use a verb of the game, or choose the other game with --game"
            if verb.args
            else "remove the call, which does nothing here, or choose the other game with --game",
            related=tuple(facts.label(place, f"{name} again") for place in places[1:]),
            severity=None if verb.args or verb.returns != "void" else Severity.WARNING,
        )
