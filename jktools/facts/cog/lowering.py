"""A script as flat code in basic blocks, in the order in which the engine's stack machine runs it.

Each block is a run of operations with one way in and, at its end, one or two ways out. What an expression statement
pushes is never popped, `=` pops and pushes nothing, and a verb takes as many values as it wants, however many the
call writes: so an operation says what it pops, and the stack below a statement is unknown.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any, NamedTuple, cast

from jktools.model.cog import values
from jktools.model.cog.program import Program, Role
from jktools.syntax.cog.nodes import (
    Assign,
    Binary,
    Call,
    CallLabel,
    DoWhile,
    Expression,
    ExprStatement,
    For,
    Goto,
    If,
    Index,
    Labeled,
    Name,
    Node,
    Number,
    Return,
    Statement,
    String,
    Unary,
    Vector,
    While,
)  # fmt: skip
from jktools.syntax.cog.nodes import (
    Block as Braces,
)


class Op(IntEnum):
    """What an operation does with the stack; `arg` is what it needs to know."""

    PUSH = 0
    """Push a constant: `arg` is a Value."""
    LOAD = 1
    """Push a symbol's value: `arg` is its slot's index."""
    LOAD_AT = 2
    """Pop an index, push the symbol that many entries behind slot `arg`."""
    STORE = 3
    """Pop a value into slot `arg`."""
    STORE_AT = 4
    """Pop a value, then an index."""
    UNKNOWN = 5
    """Pop `arg` values, push one of which nothing is known."""
    UNARY = 6
    """`arg` is the operator."""
    BINARY = 7
    CALL = 8
    """Pop what the verb `arg` takes, push what it gives."""
    DROP = 9
    """Pop `arg` values."""


Instruction = tuple[Op, Any, Node]
"""One operation, its `arg`, and the part of the tree that it comes from; a plain tuple, since there are so many."""


@dataclass(slots=True, eq=False)
class Block:
    """Operations that run one after the other."""

    index: int
    code: list[Instruction] = field(default_factory=list)
    statements: list[Statement] = field(default_factory=list)
    """Those that begin here."""
    starts: list[int] = field(default_factory=list)
    """For each of them, how many operations come before it."""
    labels: list[Labeled] = field(default_factory=list)
    """Labels that stand at its start."""
    condition: Expression | None = None
    """What decides between the two ways out; a `for` without one decides by the stack, with `tests` set."""
    tests: bool = False
    """Whether there are two ways out: `successors[0]` when the condition holds, `successors[1]` when not."""
    callee: int = -1
    """The block that a `call` at its end runs before it goes on."""
    goes: bool = False
    """Whether it ends with a `goto` of a label."""
    returns: bool = False
    """Whether the handler may end here."""
    successors: list[int] = field(default_factory=list)
    predecessors: list[int] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Flow:
    """The code of a script as a graph of blocks."""

    blocks: list[Block]
    label_block: Mapping[str, int]
    """The block that each label starts."""


class _Jump(NamedTuple):
    """A pseudo operation between lowering and the making of blocks."""

    kind: str
    """`to`, `unless`, `if`, `call`, `return`."""
    target: object = None
    condition: Expression | None = None


class _Mark(NamedTuple):
    target: object


_EXPRESSIONS = frozenset({Assign, Binary, Call, Index, Name, Number, String, Unary, Vector})

_Line = Instruction | _Jump | _Mark | Statement


def lower(program: Program) -> Flow:
    """Make the graph of a script's code; one pass, no recursion, time in proportion to the code."""
    return _blocks(_Lowering(program).run(), program)


class _Lowering:
    def __init__(self, program: Program) -> None:
        self.program = program
        self.lines: list[_Line] = []

    def run(self) -> list[_Line]:
        lines = self.lines
        pending: list[Any] = list(reversed(self.program.code.body))
        while pending:
            at = pending.pop()
            kind = type(at)
            if kind is _Jump:
                if at.condition is not None:
                    self.evaluate(at.condition)
                lines.append(at)
                continue
            if kind is _Mark:
                lines.append(at)
                continue
            if kind in _EXPRESSIONS:
                self.evaluate(at)
                continue
            lines.append(at)
            if kind is ExprStatement:
                self.evaluate(at.expression)
            elif kind is Braces:
                pending += reversed(at.body)
            elif kind is Labeled:
                lines[-1] = _Mark(at)
                lines.append(at)
                pending.append(at.statement)
            elif kind is If:
                pending += reversed(_if(at))
            elif kind in (While, DoWhile, For):
                pending += reversed(_loop(at))
            elif kind is Goto:
                label = self.program.labels.get(at.label.name)
                lines.append(_Jump("return") if label is None else _Jump("to", label))
            elif kind is CallLabel:
                label = self.program.labels.get(at.label.name)
                if label is not None:
                    lines.append(_Jump("call", label))
            elif kind is Return:
                lines.append(_Jump("return"))
        return lines

    def evaluate(self, expression: Expression) -> None:
        """Append the operations of an expression."""
        emit = self.lines.append
        pending: list[Any] = [expression]
        while pending:
            at = pending.pop()
            kind = type(at)
            if kind is tuple:
                emit(at)
            elif kind is Name:
                emit(self.name(at))
            elif kind is Number:
                emit((Op.PUSH, at.value, at))
            elif kind is Call:
                self.call(at, pending)
            elif kind is Assign:
                self.assign(at, pending)
            elif kind is Binary:
                if at.op != ",":
                    pending.append((Op.BINARY, at.op, at))
                pending += (at.right, at.left)
            elif kind is Unary:
                pending += ((Op.UNARY, at.op, at), at.operand)
            elif kind is Vector:
                emit((Op.PUSH, values.Vector(*at.value), at))
            elif kind is String:
                emit((Op.PUSH, values.String(at.value), at))
            elif kind is Index:
                slot = self.slot(at.base)
                if slot >= 0:
                    pending += ((Op.LOAD_AT, slot, at), at.index)
                else:
                    pending += ((Op.UNKNOWN, 2, at), at.index, at.base)

    def slot(self, base: Expression) -> int:
        if isinstance(base, Name):
            slot = self.program.slot_of.get(base.name)
            if slot is not None:
                return slot.index
        return -1

    def name(self, at: Name) -> Instruction:
        slot = self.program.slot_of.get(at.name)
        if slot is not None:
            return (Op.LOAD, slot.index, at)
        if self.program.role_of(at.name) is Role.MESSAGE:
            return (Op.PUSH, self.program.vocabulary.messages[at.name].id, at)
        return (Op.UNKNOWN, 0, at)

    def call(self, at: Call, pending: list[Any]) -> None:
        """A call of what is no verb leaves its arguments where they are."""
        verb = self.program.verb_of(at)
        if verb is not None:
            pending.append((Op.CALL, verb, at))
        elif not isinstance(at.callee, Name):
            pending.append(at.callee)
        pending += reversed(at.arguments)

    def assign(self, at: Assign, pending: list[Any]) -> None:
        target = at.target
        if isinstance(target, Name):
            slot = self.slot(target)
            pending += ((Op.STORE, slot, at) if slot >= 0 else (Op.DROP, 1, at), at.value)
        elif isinstance(target, Index) and self.slot(target.base) >= 0:
            pending += ((Op.STORE_AT, self.slot(target.base), at), at.value, target.index)
        else:
            pending += ((Op.DROP, 2, at), at.value, target)


def _if(at: If) -> list[Any]:
    if at.otherwise is None:
        return [_Jump("unless", (at, 0), at.condition), at.then, _Mark((at, 0))]
    return [
        _Jump("unless", (at, 0), at.condition), at.then, _Jump("to", (at, 1)), _Mark((at, 0)), at.otherwise,
        _Mark((at, 1)),
    ]  # fmt: skip


def _loop(at: While | DoWhile | For) -> list[Any]:
    if isinstance(at, DoWhile):
        return [_Mark((at, 0)), at.body, _Jump("if", (at, 0), at.condition)]
    if isinstance(at, While):
        return [_Mark((at, 0)), _Jump("unless", (at, 1), at.condition), at.body, _Jump("to", (at, 0)), _Mark((at, 1))]
    first = [] if at.first is None else [at.first]
    return [
        *first, _Mark((at, 0)), _Jump("unless", (at, 1), at.condition), at.body, at.step, _Jump("to", (at, 0)),
        _Mark((at, 1)),
    ]  # fmt: skip


def _blocks(lines: Iterable[_Line], program: Program) -> Flow:
    blocks = [Block(0)]
    starts: dict[object, int] = {}
    jumps: list[tuple[Block, _Jump]] = []
    at: Block | None = blocks[0]  # None behind a jump: what follows needs a new block

    def fresh() -> Block:
        block = Block(len(blocks))
        blocks.append(block)
        return block

    for line in lines:
        if type(line) is tuple:
            if at is None:
                at = fresh()
            at.code.append(cast("Instruction", line))
        elif type(line) is _Mark:
            if at is None or at.code or at.statements:
                before, at = at, fresh()
                if before is not None:
                    before.successors.append(at.index)
            starts[line.target] = at.index
            if isinstance(line.target, Labeled):
                at.labels.append(line.target)
        elif type(line) is _Jump:
            if at is None:
                at = fresh()
            jumps.append((at, line))
            if line.kind in ("unless", "if", "call"):
                before, at = at, fresh()
                before.successors.append(at.index)
                before.condition = line.condition
                before.tests = line.kind != "call"
            else:
                at.returns = line.kind == "return"
                at.goes = isinstance(line.target, Labeled)
                at = None
        else:
            if at is None:
                at = fresh()
            at.statements.append(line)  # type: ignore[arg-type]
            at.starts.append(len(at.code))
    if at is not None:
        at.returns = True
    for block, jump in jumps:
        if jump.kind == "call":
            block.callee = starts[jump.target]
        elif jump.kind == "if":
            block.successors.insert(0, starts[jump.target])
        elif jump.kind != "return":
            block.successors.append(starts[jump.target])
    for block in blocks:
        block.predecessors = []
    for block in blocks:
        for successor in block.successors:
            blocks[successor].predecessors.append(block.index)
    return Flow(blocks, {name: starts[node] for name, node in program.labels.items()})
