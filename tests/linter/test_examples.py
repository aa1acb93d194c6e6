"""The docs' examples are tests: what a page calls bad raises its rule, what it calls good does not."""

from __future__ import annotations

import pytest

from jktools.linter import Rule, lint, rules
from jktools.linter.rule import Example
from jktools.syntax.cog import Script
from tests.support.levels import FILE, level_of, level_with_files, two_rooms
from tests.support.scripts import script_of, whole

WITHOUT_EXAMPLES = {
    "JK009",
    "JK010",
    "JK061",
    "JK062",
    "JK065",
    "JK512",
    "JK513",
    "JK514",
    "JK515",
    "JK516",
    "JK802",
    "JK803",
    "JK804",
    "JK901",
    "JK902",
}
"""Hundreds of faults, levels of nesting or records, a cut-off pack and a bug: tests of their own elsewhere."""

BAD = [(r, e) for r in rules() for e in r.bad]
GOOD = [(r, e) for r in rules() for e in r.good]


def codes(rule: Rule, example: Example) -> set[str]:
    # Whether a comment is unused shows only beside the rules that it names.
    running = rules() if rule.code.id == "JK020" else [rule]
    if any(line.startswith(FILE) for line in example.lines):
        with level_with_files(*example.lines) as level:
            return {d.code.id for d in lint(level, running)}
    document = script_of(whole(*example.lines)) if rule.looks_at == (Script,) else level_of(two_rooms(*example.lines))
    return {d.code.id for d in lint(document, running)}


@pytest.mark.parametrize(("rule", "example"), BAD, ids=[f"{r.code}-{i}" for i, (r, _) in enumerate(BAD)])
def test_bad_examples_raise_their_rule(rule: Rule, example: Example) -> None:
    assert codes(rule, example) == {rule.code.id}


@pytest.mark.parametrize(("rule", "example"), GOOD, ids=[f"{r.code}-{i}" for i, (r, _) in enumerate(GOOD)])
def test_good_examples_do_not(rule: Rule, example: Example) -> None:
    assert codes(rule, example) == set()


@pytest.mark.parametrize("rule", rules(), ids=lambda r: str(r.code))
def test_every_rule_is_documented_and_named_alike(rule: Rule) -> None:
    assert rule.module.rpartition(".")[2] == rule.code.name.replace("-", "_")
    assert rule.summary.startswith("Report ")
    assert "## Why it matters" in rule.docs
    if rule.code.id not in WITHOUT_EXAMPLES:
        assert rule.bad
        assert rule.good
