from __future__ import annotations

from collections.abc import Iterator

import pytest

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter import Finding, Selection, UnknownRuleError, find_rule, lint, rule, rules, select
from jktools.model import Level
from tests.support.levels import TWO_ROOMS, level_of, two_rooms


def chosen(select_: str = "", ignore: str = "") -> set[str]:
    return {r.code.id for r in select(Selection(tuple(select_.split()), tuple(ignore.split())))}


def test_rules_are_chosen_by_code_prefix_and_name() -> None:
    assert chosen("JK201 collidebox-outside-sector") == {"JK201", "JK301"}
    topology = {r.code.id for r in rules() if r.code.id.startswith("JK2")}
    assert "JK207" in topology
    assert chosen("JK2", "JK201") == topology - {"JK201"}
    assert "JK218" not in chosen()
    assert chosen("JK218") == {"JK218"}
    assert "JK201" not in chosen(ignore="JK2")
    assert chosen("JK201", "JK2") == {"JK201"}
    assert chosen("JK2", "JK2") == set()
    assert "JK301" in chosen(ignore="JK2")


def test_an_unknown_rule_names_the_nearest() -> None:
    with pytest.raises(UnknownRuleError, match=r"did you mean adjoin-mirror-mismatch\?"):
        find_rule("adjoin-miror-mismatch")
    with pytest.raises(UnknownRuleError):
        select(Selection(("JK999",)))


@rule("JK999", "raises", severity=Severity.INFO, since="0")
def raises(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report one thing, then fail."""
    yield Finding(Label(level.source), "first", subject=level.sectors[1].subject)
    raise ZeroDivisionError("by nought")


def test_a_rule_that_raises_is_a_finding_and_the_rest_still_runs() -> None:
    found = lint(level_of(two_rooms("World adjoins 2", "1: 0x7 1 1")), [raises, find_rule("JK201")])
    assert [d.code.id for d in found] == ["JK901", "JK999", "JK201"]
    assert found[0].message == "rule JK999 (raises) failed after sector 1: ZeroDivisionError: by nought"


def test_findings_name_objects_and_places() -> None:
    text = two_rooms("World surfaces 12", "7: 0 0x4 0x4 4 3 1 -1 0 4 7,0 11,1 10,9 6,3 1 1 1 1")
    (found,) = lint(level_of(text))
    assert (
        found.message
        == "surface 7 (sector 1, surface 1) names texture vertex 9, but the level has the texture vertices 0 to 3"
    )
    assert found.subject is not None
    assert (found.subject.kind, found.subject.index) == ("surface", 7)
    assert found.label.span is not None
    assert found.label.span.text == ["10", "9"][1]
    line, column = found.label.span.first
    assert text.split("\n")[line - 1][column - 1 :].startswith("9 6,3")


def test_a_clean_level_has_no_findings() -> None:
    assert lint(level_of(TWO_ROOMS)) == []
