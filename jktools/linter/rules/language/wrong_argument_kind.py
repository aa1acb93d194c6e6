"""JK534: an argument of a kind that the verb cannot read."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.ranges import NUMBER, STRING, VECTOR, Range
from jktools.linter.rule import Finding, rule
from jktools.model.cog.program import Program
from jktools.model.cog.verbs import REFERENCES, Argument
from jktools.syntax.cog import Script
from jktools.syntax.cog.nodes import Call, Expression, Name

OBJECTS = frozenset({"thing", "surface", "sector", "cog", "template", "model", "keyframe", "sound", "material"})
"""Symbols of these types are told apart; an int or a flex may hold any of them."""


@rule("JK534", "wrong-argument-kind", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def wrong_argument_kind(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report an argument that can only be of a kind that the verb does not read.

    ## Why it matters
    The engine converts without a word: a vector where a number belongs is 0 or -1, a number where a vector belongs is
    the zero vector, and most verbs then do nothing. A surface's number where a thing belongs names some thing or other.

    ## Bad
        symbols
        message startup
        thing ship
        flex x=2.0
        end
        code
        startup:
            SetThingVel(ship, x);
            return;
        end

    ## Good
        symbols
        message startup
        thing ship
        flex x=2.0
        end
        code
        startup:
            SetThingVel(ship, VectorSet(x, 0, 0));
            return;
        end
    """
    for site in facts.rates.sites:
        if len(site.call.arguments) != len(site.verb.args):
            continue
        for written, argument, value in zip(site.call.arguments, site.verb.args, site.arguments, strict=True):
            given = _misread(facts.program, written, argument, value)
            if given and not facts.is_doubtful(written.start, written.end):
                yield Finding(
                    facts.label(written),
                    f"{argument.name} of {site.verb.name} is a {argument.kind}, but gets {given}",
                    f"call {site.verb.signature}",
                )


def _misread(program: Program, written: Expression, argument: Argument, value: Range) -> str | None:
    """What is given instead, or None where it can be read."""
    if argument.kind == "any":
        return None
    if argument.kind == "vector":
        return None if value.kinds & VECTOR else "a string" if value.is_string else "a number"
    if argument.kind == "string":
        return None if value.kinds & STRING else "a vector" if value.is_vector else "a number"
    if not value.kinds & NUMBER and (value.is_vector or value.is_string):
        return "a vector" if value.is_vector else "a string"
    own = object_kind(program, written) if argument.kind in REFERENCES else None
    return f"a {own}" if own is not None and own != argument.kind else None


def object_kind(program: Program, written: Expression) -> str | None:
    """The one kind of object whose number an expression holds, None where that is open."""
    if isinstance(written, Name):
        slot = program.slot_of.get(written.name)
        if slot is not None and slot.type in OBJECTS and slot.name not in program.assigned:
            return slot.type
    elif isinstance(written, Call):
        verb = program.verb_of(written)
        if verb is not None and verb.returns in OBJECTS:
            return verb.returns
    return None
