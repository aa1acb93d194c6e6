"""JK822: a sound that the engine cannot play."""

from jktools.linter.rule import reading_rule
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset


@reading_rule(faults.UNPLAYABLE_SOUND, since="0.1.0", looks_at=(Asset,))
def unplayable_sound() -> None:
    """Report a WAV that the engine cannot play.

    ## Why it matters
    The engine never looks at the encoding. It takes the samples for PCM of 8 or 16 bits, mono or stereo: what is
    packed in another way is noise or silence.
    """
