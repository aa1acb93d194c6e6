"""What the scripts of the pack call: a compiled level holds a placed script's values, not its code."""

from __future__ import annotations

from fixtures.smithdev.pack import GOB
from jktools.source import Member, resolve
from jktools.syntax.cog import read_script
from jktools.syntax.cog.nodes import Call
from jktools.syntax.cog.printer import print_expression
from jktools.syntax.cog.walk import expressions, postorder, statements


def calls(script: str, *verbs: str) -> list[str]:
    """The calls of these verbs (in lower case), as they stand in a script of `smithdev.gob`."""
    member = resolve(f"{GOB}!cog/{script}")
    assert isinstance(member, Member)
    read = read_script(member.read())
    assert not read.rejected
    found = (
        print_expression(node)
        for statement in statements(read.code.body)
        for whole in expressions(statement)
        for node in postorder(whole)
        if isinstance(node, Call)
    )
    return [each for each in found if each.partition("(")[0].lower() in verbs]
