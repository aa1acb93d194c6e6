"""The parse tables that Lark makes of `grammars/cog.lark`, as arrays that a short loop can run.

Lark's own loop takes some ten reductions to make an expression of a name, one for each level of precedence, and a
callback for each. Here a run of reductions that only pass a value on is one step, worked out once and kept; and the
depth of the stack, which limits what the engine accepts, is at hand.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from types import MappingProxyType

import lark
from lark.grammar import Rule as LarkRule
from lark.lexer import PatternStr
from lark.parsers.lalr_analysis import Shift

from jktools.syntax import grammar

START_RULES = ("body", "unusable")
END_OF_CODE = "$END"

SHORT_RULES = frozenset({"body", "arguments"})
"""Rules of one symbol that make something of it all the same: the first of a list."""


@dataclass(frozen=True, slots=True)
class Rule:
    """A reduction: how many symbols it takes, and what it makes."""

    size: int
    origin: int
    """Column of the symbol that it makes."""
    name: str
    """Its alias in the grammar, or the symbol."""
    passes: bool
    """Whether it hands its one value on as it is."""


@dataclass(frozen=True, slots=True)
class Tables:
    """An LALR automaton: states and columns (one for each symbol of the grammar) are numbers."""

    columns: Mapping[str, int]
    """Column of a terminal or a rule, by name."""
    rows: tuple[tuple[int, ...], ...]
    """`rows[state][column]`: a state to go to (above 0), minus the number of a rule to reduce by, 0 for neither."""
    rules: tuple[Rule, ...]
    """Rule 0 is none."""
    start: int
    accept: int
    """The state in which the end of the code ends a well-formed one."""
    entered_by: tuple[str, ...]
    """For each state, the symbol that leads into it; empty for the start."""
    words: Mapping[str, int]
    """Column of each keyword and operator, by its text in lower case."""
    texts: Mapping[int, str]
    """The other way round."""
    chains: dict[tuple[int, int, int], int] = field(default_factory=dict)
    """Kept results of `settle`."""

    def settle(self, below: int, state: int, column: int) -> int:
        """The state after all reductions that only pass a value on, before a symbol of this column."""
        key = (below, state, column)
        known = self.chains.get(key)
        if known is None:
            while (action := self.rows[state][column]) < 0 and self.rules[-action].passes:
                state = self.rows[below][self.rules[-action].origin]
            known = self.chains[key] = state
        return known

    def after(self, states: list[int], columns: list[int]) -> int:
        """How many of these terminals can follow on a stack of states, which is changed."""
        for count, column in enumerate(columns):
            while (action := self.rows[states[-1]][column]) < 0:
                rule = self.rules[-action]
                del states[len(states) - rule.size :]
                states.append(self.rows[states[-1]][rule.origin])
            if action == 0:
                accepted = column == self.columns[END_OF_CODE] and states[-1] == self.accept
                return count + accepted
            states.append(action)
        return len(columns)


KEYWORDS = ("if", "else", "while", "do", "for", "goto", "call", "return", "break", "continue")
"""Each is the name of its terminal in lower case; `stop` is another spelling of `return`."""


@cache
def tables() -> Tables:
    """The tables, made once a process."""
    parser = grammar.load("cog", START_RULES, "basic")
    parsing = parser.parse_interactive("", start="body").parser_state.parse_conf
    names = sorted({symbol for row in parsing.states.values() for symbol in row} | {END_OF_CODE})
    columns = {name: i for i, name in enumerate(names)}
    # State 0 would be mistaken for "neither": the start, which nothing leads into, takes its place.
    order = [parsing.start_state, *sorted(s for s in parsing.states if s != parsing.start_state)]
    number = {state: i for i, state in enumerate(order)}
    rules = [Rule(0, 0, "", False)]
    rule_number: dict[object, int] = {}
    rows = [[0] * len(columns) for _ in order]
    entered_by = [""] * len(order)
    for state, actions in parsing.states.items():
        row = rows[number[state]]
        for symbol, (action, target) in actions.items():
            if action is Shift:
                row[columns[symbol]] = number[target]
                entered_by[number[target]] = symbol
                continue
            if target not in rule_number:
                rule_number[target] = len(rules)
                rules.append(_rule(target, columns))
            row[columns[symbol]] = -rule_number[target]
    words = _words(parser, columns)
    return Tables(
        MappingProxyType(columns),
        tuple(map(tuple, rows)),
        tuple(rules),
        number[parsing.start_state],
        number[parsing.end_state],
        tuple(entered_by),
        MappingProxyType(words),
        MappingProxyType({column: text for text, column in words.items() if text != "stop"}),
    )


def _rule(made: LarkRule, columns: Mapping[str, int]) -> Rule:
    name = made.alias or str(made.origin.name)
    size = len(made.expansion)
    return Rule(size, columns[made.origin.name], name, size == 1 and made.alias is None and name not in SHORT_RULES)


def _words(parser: lark.Lark, columns: Mapping[str, int]) -> dict[str, int]:
    """The keywords, and the terminals that are one text."""
    words = {word: columns[word.upper()] for word in KEYWORDS}
    words["stop"] = words["return"]
    for terminal in parser.terminals:
        if isinstance(terminal.pattern, PatternStr):
            words[terminal.pattern.value] = columns[terminal.name]
    return words
