"""What rules say of the two rooms with a fragment laid over them."""

from __future__ import annotations

from jktools.diagnostics import Diagnostic
from jktools.linter import find_rule, lint
from tests.support.levels import level_of, two_rooms


def findings(code: str, *fragment: str, game: str = "jk") -> list[Diagnostic]:
    """The findings of one rule."""
    return lint(level_of(two_rooms(*fragment), game=game), [find_rule(code)])


def messages(code: str, *fragment: str) -> list[str]:
    """Their messages."""
    return [d.message for d in findings(code, *fragment)]


def marked(code: str, *fragment: str) -> list[str]:
    """The text that each finding points at."""
    return ["" if d.label.span is None else d.label.span.text for d in findings(code, *fragment)]
