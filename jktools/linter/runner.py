"""Runs rules over one level."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from jktools.diagnostics import Diagnostic, Label, Subject
from jktools.facts import LevelFacts
from jktools.linter.registry import rules
from jktools.linter.rule import RULE_FAILED, Rule
from jktools.model import Level


def lint(level: Level, chosen: Sequence[Rule] | None = None, facts: LevelFacts | None = None) -> list[Diagnostic]:
    """Run rules (all, when none are chosen) over a level and sort what they find.

    A rule that raises becomes a finding JK901 about jktools itself, and the others still run.
    """
    facts = facts or LevelFacts(level)
    found = [d for each in (rules() if chosen is None else chosen) for d in _run(each, level, facts)]
    return sorted(found, key=lambda d: d.sort_key)


def _run(each: Rule, level: Level, facts: LevelFacts) -> Iterator[Diagnostic]:
    latest: Subject | None = None
    try:
        for finding in each.check(level, facts):
            latest = finding.subject
            if isinstance(finding, Diagnostic):
                yield finding
                continue
            yield Diagnostic(
                each.code, each.code.severity, finding.label, finding.message, finding.help, finding.subject,
                finding.related,
            )  # fmt: skip
    except Exception as error:
        after = f" after {latest.kind} {latest.index}" if latest else ""
        yield Diagnostic(
            RULE_FAILED, RULE_FAILED.severity, Label(level.source),
            f"rule {each.code} ({each.code.name}) failed{after}: {type(error).__name__}: {error}",
            "this is a bug in jktools; please report it with the level",
        )  # fmt: skip
