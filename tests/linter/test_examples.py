"""The docs' examples are tests: what a page calls bad raises its rule, what it calls good does not."""

from __future__ import annotations

import pytest

from jktools.linter import Rule, lint, rules
from jktools.linter.rule import Document, Example
from jktools.syntax.assets.asset import Asset
from jktools.syntax.cog import Script
from tests.support.assets import asset_of
from tests.support.levels import FILE, level_of, level_with_files, two_rooms
from tests.support.scripts import script_of, whole

WITHOUT_EXAMPLES = {
    "JK009", "JK010", "JK120", "JK061", "JK062", "JK065", "JK656", "JK512", "JK513", "JK514", "JK515", "JK516",
    "JK802", "JK803", "JK804", "JK901", "JK902",
    "JK426", "JK034", "JK036", "JK037", "JK039", "JK816", "JK817", "JK818", "JK819", "JK820", "JK822",
    "JK110", "JK111", "JK112", "JK113", "JK142", "JK114", "JK140", "JK150", "JK151", "JK830", "JK831", "JK832",
}  # fmt: skip
"""Hundreds of faults, of nested levels or records; binary files, models, a cut-off pack, a bug: tested elsewhere."""

BAD = [(r, e) for r in rules() for e in r.bad]
GOOD = [(r, e) for r in rules() for e in r.good]


def codes(rule: Rule, example: Example) -> set[str]:
    # Whether a comment is unused shows only beside the rules that it names.
    running = rules() if rule.code.id == "JK020" else [rule]
    if any(line.startswith(FILE) for line in example.lines):
        with level_with_files(*example.lines) as level:
            return {d.code.id for d in lint(level, running)}
    return {d.code.id for d in lint(document_of(rule, example), running)}


def document_of(rule: Rule, example: Example) -> Document:
    if rule.looks_at == (Script,):
        return script_of(whole(*example.lines))
    if all(issubclass(kind, Asset) for kind in rule.looks_at):
        return asset_of(example.lines)
    return level_of(two_rooms(*example.lines))


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
