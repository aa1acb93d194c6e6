"""No rule raises on a level that was broken at random, whatever else it says."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.linter import lint, rules
from tests.support.levels import TWO_ROOMS, level_of

LINES = TWO_ROOMS.split("\n")
WORDS = st.sampled_from(
    ["-1", "0", "1", "3", "99", "4294967295", "-2147483648", "1e30", "nan", "x", "", "end", ".5", "0x7", "7,7", "none"]
)


@st.composite
def broken_levels(draw: st.DrawFn) -> str:
    """The two rooms with up to eight words replaced, and lines doubled or left out.

    Labels and the counts of headings stay: what becomes of those is for the tests of reading.
    """
    lines = list(LINES)
    for _ in range(draw(st.integers(1, 8))):
        at = draw(st.integers(40, len(lines) - 1))  # behind the copyright
        how = draw(st.sampled_from(["word", "word", "word", "delete", "double"]))
        words = lines[at].split(" ")
        if how == "word" and len(words) > 1 and words[0].lower() != "world":
            words[draw(st.integers(1, len(words) - 1))] = draw(WORDS)
            lines[at] = " ".join(words)
        elif how == "delete" and len(lines) > 60:
            del lines[at]
        elif how == "double":
            lines.insert(at, lines[at])
    return "\n".join(lines)


@settings(max_examples=150, deadline=None)
@given(broken_levels())
def test_no_rule_raises_on_a_broken_level(text: str) -> None:
    found = lint(level_of(text), rules())
    assert [d.message for d in found if d.code.id == "JK901"] == []
    assert all(d.message and d.message == d.message.strip() for d in found)
