from __future__ import annotations

import pytest

from jktools.diagnostics import Diagnostic
from jktools.linter import find_rule, lint
from tests.support.levels import level_of, two_rooms

WRONG = "1: 0x7 1 1"
"""Breaks JK201: reported at the line of adjoin 0, the one whose mirror does not name it back."""


def found(*fragment: str) -> list[Diagnostic]:
    return lint(level_of(two_rooms("World adjoins 2", WRONG, *fragment)))


def test_without_a_comment_there_is_a_finding() -> None:
    assert [d.code.id for d in found()] == ["JK201"]


@pytest.mark.parametrize(
    "comment",
    [
        "# jktools: ignore JK201 -- the other room is gone",
        "#jktools:ignore jk201",
        "# jktools: ignore adjoin-mirror-mismatch -- by name",
        "# jktools: ignore JK201",
    ],
)
def test_a_comment_hides_what_stands_on_its_line(comment: str) -> None:
    assert found(f"0: 0x7 1 1 {comment}") == []


def test_a_comment_on_a_line_of_its_own_speaks_for_the_next_record() -> None:
    assert found("0: 0x7 1 1", "- 0: 0x7 1 1") != []
    text = two_rooms("World adjoins 2", WRONG).replace(
        "0: 0x7 1 1\n", "# jktools: ignore JK201 -- known\n\n# another comment\n0: 0x7 1 1\n"
    )
    assert lint(level_of(text)) == []


def test_a_comment_may_speak_for_the_whole_file() -> None:
    assert found("+ # jktools: ignore-file JK201 -- all of them") == []


def test_a_comment_hides_only_its_code_and_is_told_when_it_hides_nothing() -> None:
    told = found("0: 0x7 1 1 # jktools: ignore JK301, JK202")
    assert [d.code.id for d in told] == ["JK201", "JK020", "JK020"]
    assert told[1].label.span is not None
    assert told[1].label.span.text == "# jktools: ignore JK301, JK202"
    assert "the comment hides JK202, but there is no such finding on line" in told[1].message


def test_a_code_that_did_not_run_is_not_called_unused() -> None:
    level = level_of(two_rooms("World adjoins 2", "1: 0x7 0 1 # jktools: ignore JK301"))
    assert lint(level, [find_rule("JK201"), find_rule("JK020")]) == []
    assert len(lint(level, [find_rule("JK301"), find_rule("JK020")])) == 1


def test_a_comment_that_names_no_rule_is_told() -> None:
    told = found("0: 0x7 1 1 # jktools: ignore JK210x")
    assert [d.code.id for d in told] == ["JK201", "JK021"]
    assert "no rule is called JK210x" in told[1].message
