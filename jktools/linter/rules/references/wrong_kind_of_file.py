"""JK114: a COG's value that names a file of another kind than its symbol."""

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.references import NONE
from jktools.linter.rule import Finding, rule
from jktools.model import Level
from jktools.model.resources import Kind
from jktools.syntax.jkl import records

KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "ai": Kind.AI_CLASS,
        "keyframe": Kind.KEYFRAME,
        "material": Kind.MATERIAL,
        "model": Kind.MODEL,
        "sound": Kind.SOUND,
    }
)
"""Types of symbols whose values name files."""

NUMBER = "-1"
"""What editors write for nothing."""


@rule("JK114", "wrong-kind-of-file", severity=Severity.WARNING, since="0.1.0")
def wrong_kind_of_file(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a value of a placed COG whose extension is not that of its symbol's type.

    ## Why it matters
    A `sound` symbol takes a .wav, a `material` a .mat, a `model` a .3do, a `keyframe` a .key and an `ai` an .ai. The
    engine looks for the file in the folder of the symbol's type, does not find it and leaves the symbol empty. Told as
    far as the script is at hand.
    """
    for instance in facts.instances:
        for value in instance.values:
            kind = KINDS.get(value.slot.type)
            text = value.text.lower()
            if kind is None or text in (NONE, NUMBER) or text.endswith(f".{kind.extension}"):
                continue
            cog = instance.cog
            place = level.document.field_span(records.COG, cog.line, len(records.COG.fields) + value.position)
            yield Finding(
                Label(place),
                f'{cog.title} gives "{value.text}" to the symbol "{value.slot.name}", but that takes a '
                f".{kind.extension} file",
                f"name a .{kind.extension} file, or {NONE}",
                cog.subject,
            )
