"""JK508: flags with blanks around the equals sign."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK508", "flags-with-blanks", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def flags_with_blanks(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report `flags = ...` with a blank beside the equals sign.

    ## Why it matters
    A blank ends the word. `flags = 0x240` is the word `flags`, whose text the engine reads as a hexadecimal number: it
    stops behind the `f`, and the script is disabled, in debug mode, with a pulse and a timer. `flags= 0x240` is 0.

    ## Bad
        flags = 0x240
        symbols
        end

    ## Bad
        flags= 0x240
        symbols
        end

    ## Good
        flags=0x240
        symbols
        end
    """

    word = script.header.flags_word
    if word is not None and word.value in ("", "flags"):
        yield Finding(
            facts.label(word),
            f"the flags stand behind a blank, but the engine reads the word {'flags' if word.value else 'flags='} "
            f"alone and takes 0x{script.header.flags:x}",
            "remove the blanks: flags=0x240",
        )
