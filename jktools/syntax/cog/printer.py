"""A script's text from its tree, in one canonical form: what comes back from reading it is the same tree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from jktools.syntax.cog.nodes import (
    Assign,
    Binary,
    Block,
    Call,
    CallLabel,
    DoWhile,
    Expression,
    ExprStatement,
    For,
    Goto,
    Header,
    If,
    Index,
    Labeled,
    Name,
    Number,
    Return,
    Statement,
    String,
    Symbol,
    Unary,
    Vector,
    While,
)
from jktools.syntax.cog.script import Script

INDENT = "    "

_BINARY = {
    op: level
    for level, ops in enumerate(
        (",", "=", "||", "&&", "|", "^", "&", "== !=", "< > <= >=", "+ -", "* / %"), start=1
    )
    for op in ops.split()
}  # fmt: skip
_COMMA, _ASSIGN, _UNARY, _POSTFIX = 1, 2, 12, 13


def print_script(script: Script) -> str:
    """The whole script. Lines of the header that the engine drops are kept; comments and characters it drops are not.

    A statement that could not be read becomes a semicolon.
    """
    return "\n".join([*_header(script.header), "code", *_statements(script.code.body), "end", ""])


def print_expression(expression: Expression) -> str:
    """One expression, with the parentheses that it needs and no others."""
    out: list[str] = []
    pending: list[str | tuple[Expression, int]] = [(expression, _COMMA)]
    while pending:
        item = pending.pop()
        if isinstance(item, str):
            out.append(item)
            continue
        node, least = item
        parts = list(_parts(node))
        if _level(node) < least:
            parts = ["(", *parts, ")"]
        pending += reversed(parts)
    return "".join(out)


def _level(node: Expression) -> int:
    match node:
        case Binary():
            return _BINARY[node.op]
        case Assign():
            return _ASSIGN
        case Unary():
            return _UNARY
        case _:
            return _POSTFIX


def _parts(node: Expression) -> Iterator[str | tuple[Expression, int]]:
    """What an expression is made of: text, and operands with the least level that needs no parentheses."""
    match node:
        case Binary():
            level = _BINARY[node.op]
            yield node.left, level
            yield ", " if node.op == "," else f" {node.op} "
            yield node.right, level + 1
        case Assign():
            yield node.target, _UNARY
            yield " = "
            yield node.value, _ASSIGN
        case Unary():
            yield node.op
            yield node.operand, _UNARY
        case Call():
            yield node.callee, _POSTFIX
            yield "("
            for i, argument in enumerate(node.arguments):
                if i:
                    yield ", "
                yield argument, _ASSIGN
            yield ")"
        case Index():
            yield node.base, _POSTFIX
            yield "["
            yield node.index, _COMMA
            yield "]"
        case Name():
            yield node.name
        case Number():
            yield node.text
        case String():
            yield f'"{node.value}"'
        case Vector():
            yield f"'{node.text}'"


def _header(header: Header) -> Iterator[str]:
    if header.flags_word is not None:
        yield f"flags=0x{header.flags:x}"
    yield "symbols"
    for symbol in sorted((*header.symbols, *header.dropped), key=lambda s: s.start):
        yield _symbol(symbol)
    yield "end"


def _symbol(symbol: Symbol) -> str:
    words = [symbol.name, *symbol.attributes]
    return " ".join([symbol.type, *(f"{w.key}={w.value}" if w.has_value else w.key for w in words)]).rstrip()


def _statements(body: Sequence[Statement]) -> Iterator[str]:
    """The lines of some statements."""
    pending: list[tuple[Statement | str, int, str]] = [(statement, 0, "") for statement in reversed(body)]
    while pending:
        item, depth, lead = pending.pop()
        if isinstance(item, str):
            yield INDENT * depth + item
            continue
        head, rest = _lines(item, depth)
        if lead and isinstance(item, If):
            head = f"{lead} {head}"
        elif lead:
            yield INDENT * depth + lead
            pending.append((item, depth + (not isinstance(item, Block)), ""))
            continue
        yield INDENT * depth + head
        pending += reversed(rest)


def _lines(statement: Statement, depth: int) -> tuple[str, list[tuple[Statement | str, int, str]]]:
    """The first line of a statement, and what follows: statements or text, how deep, and what leads to it."""

    def inner(body: Statement) -> tuple[Statement | str, int, str]:
        return body, depth + (not isinstance(body, Block)), ""

    match statement:
        case ExprStatement():
            return f"{print_expression(statement.expression)};", []
        case Block():
            body: list[tuple[Statement | str, int, str]] = [(s, depth + 1, "") for s in statement.body]
            return "{", [*body, ("}", depth, "")]
        case If():
            rest = [inner(statement.then)]
            if statement.otherwise is not None:
                rest.append((statement.otherwise, depth, "else"))
            return f"if ({print_expression(statement.condition)})", rest
        case While():
            return f"while ({print_expression(statement.condition)})", [inner(statement.body)]
        case DoWhile():
            tail = f"while ({print_expression(statement.condition)});"
            return "do", [inner(statement.body), (tail, depth, "")]
        case For():
            first, condition = (
                "" if e is None else print_expression(e) for e in (statement.first, statement.condition)
            )  # fmt: skip
            step = print_expression(statement.step)
            return f"for ({first}; {condition}; {step})", [inner(statement.body)]
        case Goto():
            return f"goto {statement.label.name};", []
        case CallLabel():
            return f"call {statement.label.name};", []
        case Return():
            return f"{statement.keyword};", []
        case Labeled():
            return f"{statement.label.name}:", [(statement.statement, depth, "")]
        case _:
            return ";", []
