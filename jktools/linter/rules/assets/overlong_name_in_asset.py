"""JK141: a name in an asset that is longer than the engine's fields."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import AssetFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.text.overlong_name import MOST_CHARACTERS
from jktools.syntax.assets.asset import Asset


@rule("JK141", "overlong-name-in-asset", severity=Severity.WARNING, since="0.1.0", looks_at=Asset)
def overlong_name_in_asset(asset: Asset, facts: AssetFacts) -> Iterator[Finding]:
    """Report a file that is named with more than 31 characters in a model, sprite, puppet, sound class or the like.

    ## Why it matters
    The engine keeps the names of files in fields of 32 bytes, one of which ends them: a longer name is cut off and
    leads to another file or to none, or overwrites what lies behind. JK012 tells of such names in a level, JK152 of
    the file itself.

    ## Bad
        # door.snd
        create the_sound_of_a_door_that_opens.wav

    ## Good
        # door.snd
        create the_sound_of_an_opening_dr.wav
    """
    for reference in asset.references:
        if len(reference.name) > MOST_CHARACTERS:
            yield Finding(
                Label(reference.place),
                f'the file names "{reference.name}" of {len(reference.name)} characters, but the engine keeps '
                f"{MOST_CHARACTERS}",
                "shorten the name, and that of the file",
            )
