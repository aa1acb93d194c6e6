"""JK006: a line longer than the engine's buffer."""

from jktools.linter.rule import reading_rule
from jktools.syntax.jkl import faults


@reading_rule(faults.OVERLONG_LINE, since="0.1.0")
def overlong_line() -> None:
    """Report a line that the engine reads in pieces.

    ## Why it matters
    The engine fetches at most 1023 bytes of a line, its end included (2047 in Mysteries of the Sith), and takes the
    rest for a line of its own.

    ## Bad
        World templates 4
        long none type=cog \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) \
frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0) frame=(0.000000/0.000000/0.000000:0.0/0.0/0.0)

    ## Good
        World templates 4
        long none type=cog timer=1
    """
