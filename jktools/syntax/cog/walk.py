"""Ways through a tree that need no recursion, however deep the tree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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


def operands(expression: Expression) -> tuple[Expression, ...]:
    """The parts of an expression, as they stand in the text."""
    match expression:
        case Binary():
            return expression.left, expression.right
        case Call():
            return expression.callee, *expression.arguments
        case Assign():
            return expression.target, expression.value
        case Index():
            return expression.base, expression.index
        case Unary():
            return (expression.operand,)
        case _:
            return ()


def postorder(expression: Expression) -> list[Expression]:
    """An expression and all that is in it, parts before the whole, left to right."""
    pending: list[Expression] = [expression]
    found: list[Expression] = []
    while pending:
        at = pending.pop()
        found.append(at)
        pending += operands(at)
    found.reverse()
    return found


def parts(statement: Statement) -> tuple[Statement, ...]:
    """The statements directly in a statement, as they stand in the text."""
    match statement:
        case Block():
            return statement.body
        case If():
            return (statement.then,) if statement.otherwise is None else (statement.then, statement.otherwise)
        case While() | DoWhile() | For():
            return (statement.body,)
        case Labeled():
            return (statement.statement,)
        case _:
            return ()


def expressions(statement: Statement) -> tuple[Expression, ...]:
    """The expressions directly in a statement, as they stand in the text."""
    match statement:
        case ExprStatement():
            return (statement.expression,)
        case If() | While() | DoWhile():
            return (statement.condition,)
        case For():
            return tuple(e for e in (statement.first, statement.condition, statement.step) if e is not None)
        case _:
            return ()


def statements(body: Sequence[Statement]) -> Iterator[Statement]:
    """All statements of a body, each before those in it, as they stand in the text."""
    pending = list(reversed(body))
    while pending:
        at = pending.pop()
        yield at
        pending += reversed(parts(at))


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
