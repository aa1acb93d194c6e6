"""JK509: a hexadecimal number of the header that looks decimal."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK509", "header-number-without-prefix", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def header_number_without_prefix(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report flags and masks of two or more decimal digits without `0x`.

    ## Why it matters
    The engine reads both as hexadecimal whether `0x` stands before them or not: `mask=16` is 0x16, things of three
    types, where 0x10 is one.

    ## Bad
        flags=240
        symbols
        end

    ## Bad
        symbols
        sector room mask=1025
        end

    ## Good
        flags=0x240
        symbols
        sector room mask=0x401
        sector hall mask=4
        end
    """

    masks = (a for symbol in script.header.symbols for a in symbol.attributes if a.key == "mask")
    words = [script.header.flags_word] if script.header.flags_word else []
    for word in (*words, *masks):
        if len(word.value) > 1 and word.value.isdigit():
            yield Finding(
                facts.label(word),
                f"{word.key} is written {word.value}, but the engine reads 0x{word.value.lstrip('0')}",
                f"write 0x{int(word.value):x} if the number is decimal, 0x{word.value} if it is not",
            )
