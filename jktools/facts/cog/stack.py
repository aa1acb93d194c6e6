"""What expressions leave on the stack of the engine's machine: whether a value is that of the expression it stands for.

A verb takes as many values as it wants, however many the call writes, and `=` leaves none: what an operator or a verb
then finds is not what stands beside it in the text.
"""

from __future__ import annotations

from collections.abc import Sequence

from jktools.model.cog.program import Program
from jktools.syntax.cog.nodes import Assign, Binary, Call, Expression, Index, Name, Unary


def is_plain(program: Program, *expressions: Expression) -> bool:
    """Whether each leaves one value, its own, and touches none that was there before.

    Verbs that run handlers in between do not: those share the stack, and leave things on it.
    """
    pending: list[Expression] = list(expressions)
    while pending:
        at = pending.pop()
        if isinstance(at, Assign):
            return False
        if isinstance(at, Call):
            verb = program.verb_of(at)
            if verb is None or verb.returns == "void" or verb.pushes != "once" or verb.delivers:
                return False
            if len(at.arguments) != len(verb.args) or not isinstance(at.callee, Name):
                return False
            pending += at.arguments
        elif isinstance(at, Binary):
            if at.op == ",":
                return False
            pending += (at.left, at.right)
        elif isinstance(at, Unary):
            pending.append(at.operand)
        elif isinstance(at, Index):
            pending += (at.base, at.index)
    return True


def written(program: Program, call: Call) -> Sequence[Expression | None]:
    """For each value that a verb takes, what the call writes for it; None where it may be another.

    Empty for a call of what is no verb.
    """
    verb = program.verb_of(call)
    if verb is None or len(call.arguments) != len(verb.args):
        return [None] * (0 if verb is None else len(verb.args))
    found: list[Expression | None] = []
    on_top = True
    for each in reversed(call.arguments):
        found.append(each if on_top else None)
        on_top = on_top and is_plain(program, each)
    return found[::-1]
