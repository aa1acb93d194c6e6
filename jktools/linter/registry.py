"""All rules, found by walking the rules folder, and how users choose among them."""

from __future__ import annotations

import difflib
import importlib
import pkgutil
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

from jktools.linter import rules as rules_package
from jktools.linter.rule import Rule


class UnknownRuleError(ValueError):
    """A code or name that belongs to no rule; the message names the nearest one."""


@cache
def rules() -> tuple[Rule, ...]:
    """Every rule, by code. Raises RuntimeError when two have the same code or name."""
    found: dict[str, Rule] = {}
    for info in pkgutil.walk_packages(rules_package.__path__, rules_package.__name__ + "."):
        for value in vars(importlib.import_module(info.name)).values():
            if not isinstance(value, Rule) or value.module != info.name:
                continue
            for key in (value.code.id, value.code.name):
                if found.setdefault(key, value) is not value:
                    raise RuntimeError(f"{key} is taken by {found[key].module} and {value.module}")
    return tuple(sorted(set(found.values()), key=lambda r: r.code.id))


def find_rule(typed: str) -> Rule:
    """The rule of a code or a name, in any case. Raises UnknownRuleError."""
    for each in rules():
        if typed.upper() == each.code.id or typed.lower() == each.code.name:
            return each
    known = [key for each in rules() for key in (each.code.id, each.code.name)]
    near = difflib.get_close_matches(typed, known, n=1) or difflib.get_close_matches(typed.upper(), known, n=1)
    hint = f"; did you mean {near[0]}?" if near else "; `jktools rules` lists them"
    raise UnknownRuleError(f"no rule is called {typed}{hint}")


@dataclass(frozen=True, slots=True)
class Selection:
    """Which rules run: codes, prefixes of codes (`JK2`) or names; nothing selected means all that are on."""

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()


def select(selection: Selection) -> tuple[Rule, ...]:
    """The chosen rules; the longer of two prefixes that meet a rule wins, and `ignore` wins a tie.

    Raises UnknownRuleError.
    """
    chosen, left_out = _specificity(selection.select), _specificity(selection.ignore)

    def default(each: Rule) -> int:
        return 0 if each.on and not selection.select else -1

    return tuple(r for r in rules() if chosen.get(r.code.id, default(r)) > left_out.get(r.code.id, -1))


def _specificity(typed: Sequence[str]) -> dict[str, int]:
    """Per code, the length of the longest prefix that names it; a name counts as the whole code."""
    longest: dict[str, int] = {}
    for each in typed:
        prefix = each.upper()
        met = [r.code.id for r in rules() if r.code.id.startswith(prefix)] if prefix.startswith("JK") else []
        if not met:
            whole = find_rule(each)
            met, prefix = [whole.code.id], whole.code.id
        for code in met:
            longest[code] = max(longest.get(code, 0), len(prefix))
    return longest
