"""From tokens to statements: the engine's grammar, and a way on behind what it refuses."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from jktools.syntax.cog.nodes import (
    Assign,
    Binary,
    Block,
    Call,
    CallLabel,
    DoWhile,
    Empty,
    ExprStatement,
    For,
    Goto,
    If,
    Index,
    Labeled,
    Return,
    Statement,
    Unary,
    While,
)
from jktools.syntax.cog.recovery import Recovery
from jktools.syntax.cog.scanner import Scan
from jktools.syntax.cog.stack import Stack
from jktools.syntax.cog.tables import END_OF_CODE, Tables

DEEPEST_STACK = 300
"""States that the engine's parser can hold (YYSTACKSIZE in y.tab.c of the decompiled engine, its tool's default)."""

Build = Callable[[int, int, list[Any]], Any]


def _listed(_start: int, _end: int, v: list[Any]) -> list[Any]:
    return v


def _appended(_start: int, _end: int, v: list[Any]) -> list[Any]:
    grown: list[Any] = v[0]
    grown.append(v[-1])
    return grown


def _for_loop(start: int, end: int, v: list[Any]) -> For:
    first, condition = (s.expression if isinstance(s, ExprStatement) else None for s in v[2:4])
    return For(start, end, first, condition, v[4], v[6])


BUILD: dict[str, Build] = {
    "body": _listed,
    "more": _appended,
    "arguments": _listed,
    "more_arguments": _appended,
    "labeled": lambda start, end, v: Labeled(start, end, v[0], v[2]),
    "empty_block": lambda start, end, _: Block(start, end, ()),
    "block": lambda start, end, v: Block(start, end, tuple(v[1])),
    "if_then": lambda start, end, v: If(start, end, v[2], v[4], None),
    "if_else": lambda start, end, v: If(start, end, v[2], v[4], v[6]),
    "while_loop": lambda start, end, v: While(start, end, v[2], v[4]),
    "do_loop": lambda start, end, v: DoWhile(start, end, v[1], v[4]),
    "for_loop": _for_loop,
    "goto": lambda start, end, v: Goto(start, end, v[1]),
    "call_label": lambda start, end, v: CallLabel(start, end, v[1]),
    "return_statement": lambda start, end, v: Return(start, end, v[0]),
    "empty": lambda start, end, _: Empty(start, end),
    "expression_statement": lambda start, end, v: ExprStatement(start, end, v[0]),
    "binary": lambda start, end, v: Binary(start, end, v[1], v[0], v[2]),
    "assign": lambda start, end, v: Assign(start, end, v[0], v[2]),
    "unary": lambda start, end, v: Unary(start, end, v[0], v[1]),
    "index": lambda start, end, v: Index(start, end, v[0], v[2]),
    "call_bare": lambda start, end, v: Call(start, end, v[0], ()),
    "call": lambda start, end, v: Call(start, end, v[0], tuple(v[2])),
    "parenthesised": lambda _start, _end, v: v[1],
}
"""What each rule of the grammar makes of the values of its symbols."""


def parse(scan: Scan, tables: Tables, recovery: Recovery) -> list[Statement]:
    """The statements of some code; `recovery` is asked what to do where the engine stops."""
    rows, rules, settle, chains = tables.rows, tables.rules, tables.settle, tables.chains
    builds: list[Build] = [BUILD.get(rule.name, _listed) for rule in rules]
    end_column, accept = tables.columns[END_OF_CODE], tables.accept
    stack = Stack([tables.start], [None], [0])
    states, values, starts = stack.states, stack.values, stack.starts
    tokens = scan.tokens
    at = 0
    while True:
        column, start, end, value = tokens[at]
        state = states[-1]
        while (action := rows[state][column]) < 0:
            rule = rules[-action]
            if rule.passes:
                key = (states[-2], state, column)
                state = states[-1] = chains.get(key) or settle(*key)
                continue
            size = rule.size
            made = builds[-action](starts[-size], stack.end, values[-size:])
            if size == 1:
                values[-1] = made
                state = states[-1] = rows[states[-2]][rule.origin]
            else:
                del values[-size:], states[-size:], starts[1 - size :]
                values.append(made)
                state = rows[states[-1]][rule.origin]
                states.append(state)
        if action > 0 and len(states) < DEEPEST_STACK:
            states.append(action)
            values.append(value)
            starts.append(start)
            stack.end = end
            at += 1
        elif column == end_column and state == accept:
            body: list[Statement] = values[1]
            return body
        else:
            at = recovery.recover(stack, tokens, at, too_deep=action > 0)
