"""JK152: an asset file with a name longer than the engine's fields."""

from collections.abc import Iterator
from pathlib import PurePosixPath

from jktools.diagnostics import Label, Severity
from jktools.facts import AssetFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.text.overlong_name import MOST_CHARACTERS
from jktools.syntax.assets.asset import Asset


@rule("JK152", "overlong-file-name", severity=Severity.WARNING, since="0.1.0", looks_at=Asset)
def overlong_file_name(asset: Asset, facts: AssetFacts) -> Iterator[Finding]:
    """Report an asset file with a name of more than 31 characters.

    ## Why it matters
    The engine keeps the names of files in fields of 32 bytes, one of which ends them. It cuts a longer name off, so
    that two files that begin alike are one to it; where a level names the file, JK012 tells of that too.

    ## Bad
        # the_sound_of_a_door_that_opens_slowly.snd
        create dooropen.wav

    ## Good
        # the_sound_of_a_door_opening.snd
        create dooropen.wav
    """
    name = PurePosixPath(asset.source.name).name
    if len(name) > MOST_CHARACTERS:
        yield Finding(
            Label(asset.source),
            f'the file has the name "{name}" of {len(name)} characters, but the engine keeps {MOST_CHARACTERS}',
            "shorten the name, and mend what names it",
        )
