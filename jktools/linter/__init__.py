"""Rules, one a file, and what runs them over a level or a script."""

from jktools.linter.registry import Selection, UnknownRuleError, find_rule, rules, select
from jktools.linter.rule import Finding, Options, Rule, reading_rule, rule
from jktools.linter.runner import lint

__all__ = [
    "Finding",
    "Options",
    "Rule",
    "Selection",
    "UnknownRuleError",
    "find_rule",
    "lint",
    "reading_rule",
    "rule",
    "rules",
    "select",
]
