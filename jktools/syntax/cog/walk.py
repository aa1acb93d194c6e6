"""Ways through a tree that need no recursion, however deep the tree."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from jktools.syntax.cog.nodes import (
    Assign,
    Binary,
    Block,
    Call,
    DoWhile,
    Expression,
    ExprStatement,
    For,
    If,
    Index,
    Labeled,
    Node,
    Statement,
    Unary,
    While,
)

Parts = Callable[[Any], tuple[Any, ...]]

_OPERANDS: dict[type[Node], Parts] = {
    Binary: lambda e: (e.left, e.right),
    Call: lambda e: (e.callee, *e.arguments),
    Assign: lambda e: (e.target, e.value),
    Index: lambda e: (e.base, e.index),
    Unary: lambda e: (e.operand,),
}
_PARTS: dict[type[Node], Parts] = {
    Block: lambda s: s.body,
    If: lambda s: (s.then,) if s.otherwise is None else (s.then, s.otherwise),
    While: lambda s: (s.body,),
    DoWhile: lambda s: (s.body,),
    For: lambda s: (s.body,),
    Labeled: lambda s: (s.statement,),
}
_EXPRESSIONS: dict[type[Node], Parts] = {
    ExprStatement: lambda s: (s.expression,),
    If: lambda s: (s.condition,),
    While: lambda s: (s.condition,),
    DoWhile: lambda s: (s.condition,),
    For: lambda s: tuple(e for e in (s.first, s.condition, s.step) if e is not None),
}


def _nothing(_: Any) -> tuple[Any, ...]:
    return ()


def operands(expression: Expression) -> tuple[Expression, ...]:
    """The parts of an expression, as they stand in the text."""
    return _OPERANDS.get(type(expression), _nothing)(expression)


def postorder(expression: Expression) -> list[Expression]:
    """An expression and all that is in it, parts before the whole, left to right."""
    pending: list[Expression] = [expression]
    found: list[Expression] = []
    operands_of = _OPERANDS.get
    while pending:
        at = pending.pop()
        found.append(at)
        inner = operands_of(type(at))
        if inner is not None:
            pending += inner(at)
    found.reverse()
    return found


def parts(statement: Statement) -> tuple[Statement, ...]:
    """The statements directly in a statement, as they stand in the text."""
    return _PARTS.get(type(statement), _nothing)(statement)


def expressions(statement: Statement) -> tuple[Expression, ...]:
    """The expressions directly in a statement, as they stand in the text."""
    return _EXPRESSIONS.get(type(statement), _nothing)(statement)


def statements(body: Sequence[Statement]) -> Iterator[Statement]:
    """All statements of a body, each before those in it, as they stand in the text."""
    pending = list(reversed(body))
    parts_of = _PARTS.get
    while pending:
        at = pending.pop()
        yield at
        inner = parts_of(type(at))
        if inner is not None:
            pending += reversed(inner(at))


def same_tree(one: Sequence[Statement], other: Sequence[Statement]) -> bool:
    """Whether two bodies say the same, wherever they stand in their texts."""
    pending: list[tuple[Any, Any]] = [(tuple(one), tuple(other))]
    while pending:
        a, b = pending.pop()
        if type(a) is not type(b):
            return False
        if isinstance(a, tuple):
            if len(a) != len(b):
                return False
            pending += zip(a, b, strict=True)
        elif isinstance(a, Node):
            names = a.__struct_fields__[2:]  # without start and end
            pending += ((getattr(a, name), getattr(b, name)) for name in names)
        elif a != b:
            return False
    return True
