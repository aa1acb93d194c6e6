"""Pulses that each run of their handler turns off: they come once for each time that they are set, as a timer does."""

from __future__ import annotations

from jktools.facts.cog import ranges
from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.lowering import Block, Op
from jktools.facts.cog.rates import Site
from jktools.facts.cog.stack import written
from jktools.model.cog.verbs import Verb
from jktools.syntax.cog.nodes import Assign, Call, Expression, Name

SENDER = "getsenderref"


def turns_off(site: Site) -> bool:
    """Whether a call of SetPulse or SetThingPulse can only turn a pulse off.

    A thing's pulse below 0 comes every frame (sithCogFunctionThing_SetThingPulse in the decompiled engine).
    """
    least, most = ranges.as_flex(site.arguments[-1])
    return most <= 0 if site.verb.name == "setpulse" else least == most == 0


def calls_off(analysis: Analysis, label: str, thing: int | None = None) -> frozenset[Call]:
    """The calls in a handler that turn the pulse off which runs it; none where the handler may also set it.

    That is the script's own pulse, or with `thing` that of the thing with this number, which sent it.
    """
    verb = "setpulse" if thing is None else "setthingpulse"
    inside = frozenset(analysis.reach.blocks_from([analysis.flow.label_block[label]]))
    sites = [site for site in analysis.rates.sites if site.verb.name == verb and site.block in inside]
    if any(not turns_off(site) for site in sites):
        return frozenset()
    return frozenset(site.call for site in sites if thing is None or _is_of_sender(analysis, label, site, thing))


def _is_of_sender(analysis: Analysis, label: str, site: Site, thing: int) -> bool:
    if site.arguments[0].number == thing:
        return True
    given = written(analysis.program, site.call)[0]
    return given is not None and _is_sender(analysis, label, given, site.call.start)


def _is_sender(analysis: Analysis, label: str, given: Expression, before: int) -> bool:
    """`GetSenderRef()`, or a variable that this alone is assigned to, above and in the first block of the handler."""
    if isinstance(given, Name):
        stores = [
            each for each in analysis.program.of_kind(Assign)
            if not isinstance(each.target, Name) or each.target.name == given.name
        ]  # fmt: skip
        if len(stores) != 1 or not isinstance(stores[0].target, Name) or stores[0].start > before:
            return False
        first = analysis.flow.blocks[analysis.flow.label_block[label]]
        if not any(op is Op.STORE and node is stores[0] for op, _, node in first.code):
            return False
        given = stores[0].value
    verb = analysis.program.verb_of(given) if isinstance(given, Call) else None
    return verb is not None and verb.name == SENDER


def turns_off_in_each_run(analysis: Analysis, label: str, off: frozenset[Call]) -> bool:
    """Whether no way through a handler ends, waits or lets other code run before it turns its pulse off.

    What the handler calls counts only where it is harmless: a `call` too deep in others is passed over.
    """
    flow = analysis.flow
    start = flow.label_block[label]
    pending, seen = [start], {start}
    while pending:
        block = flow.blocks[pending.pop()]
        outcome = _passes(block, off)
        if outcome is None and block.callee >= 0 and may_wait(analysis, block.callee):
            return False
        if outcome is False or (outcome is None and block.returns):
            return False
        if outcome is None:
            fresh = [s for s in block.successors if s not in seen and s in analysis.known.visited]
            seen.update(fresh)
            pending += fresh
    return bool(off)


def _passes(block: Block, off: frozenset[Call]) -> bool | None:
    """True where a block turns the pulse off, False where something else can run before that, None for neither."""
    for op, arg, node in block.code:
        if op is Op.CALL:
            if node in off:
                return True
            if lets_run(arg):
                return False
    return None


def may_wait(analysis: Analysis, entry: int) -> bool:
    """Whether other code can run before a label that is called is through."""
    return any(
        op is Op.CALL and lets_run(arg)
        for index in analysis.reach.blocks_from([entry])
        for op, arg, _ in analysis.flow.blocks[index].code
    )


def lets_run(verb: Verb) -> bool:
    """Whether other code can run before the script goes on behind a verb."""
    return verb.sleeps or verb.delivers
