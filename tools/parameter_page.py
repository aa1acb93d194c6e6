"""`docs/parameters.md`: every parameter of templates and things, from the one table."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from jktools.syntax.template.parameters import PARAMETERS, Act, Parameter, Refers, Scope, Use

HEAD = """# Parameters of templates and things

Made by `make generate` from `jktools/syntax/template/parameters.py`; how a value is written is
`grammars/template.lark`. Source: the decompiled engine (sithThing_ParseArg and the handlers that it asks).

The engine reads a line from left to right. For each `key=value` it asks its handlers in this order until one accepts:
any thing, then that of the type, then that of the way to move, then the AI. So `type=` and `move=` must stand before
what depends on them, unless a parent has them. What no handler accepts changes nothing, and nobody is told; the rules
JK407 and JK410 to JK418 tell.

- A template starts as a copy of its parent's whole record, a thing as one of its template. What is never set is 0 or
  nothing. A value replaces the inherited one; flags are replaced too, not merged.
- Some values switch on flags of another parameter. A `thingflags=` or `typeflags=` further right switches them off
  again.
- The values of the types share their memory, and so do those of physics and of a path: a child that changes from one
  to another inherits nothing useful (JK424).
- Names of templates mean those that stand above; others are nothing. So no template creates itself.
- Whole numbers are read with atoi and decimals with atof: the longest prefix that is a number, 0 where there is none.
  Flags are read with %x, with or without 0x.
"""


def parameter_page(into: Path) -> Path:
    """Write the page."""
    target = into / "docs/parameters.md"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("\n".join(_lines()) + "\n")
    return target


def _lines() -> Iterator[str]:
    yield HEAD
    yield "| key | for | written as | unit | taken | effect |"
    yield "|---|---|---|---|---|---|"
    for parameter in PARAMETERS.values():
        if not parameter.uses:
            yield f"| {_key(parameter)} | nothing | | | | the engine knows it and does nothing with it |"
        shown: list[str] = []
        for use in parameter.uses:
            cells = [use.kind.form, use.unit, _taken(use), _effect(use)]
            scopes = [other.scope for other in parameter.uses if _same(other, use)]
            row = f"| {_key(parameter)} | {_for(scopes)} | " + " | ".join(cells) + " |"
            if row not in shown:
                shown.append(row)
        yield from shown


def _key(parameter: Parameter) -> str:
    return f"`{parameter.key}`" + (" (Mysteries of the Sith)" if parameter.game == "mots" else "")


def _same(one: Use, other: Use) -> bool:
    return (one.kind, one.unit, _taken(one), _effect(one)) == (other.kind, other.unit, _taken(other), _effect(other))


def _for(scopes: list[Scope]) -> str:
    return ", ".join(scope.value.removeprefix("type ") for scope in scopes)


def _taken(use: Use) -> str:
    if use.least is None:
        return "any"
    return f"{use.least:g} or more" if use.most is None else f"{use.least:g} to {use.most:g}"


def _effect(use: Use) -> str:
    parts = [use.act.value] if use.act is not Act.SET else []
    if use.refers is not None:
        parts.append("names a template" if use.refers is Refers.TEMPLATE else f"names a .{use.refers.value} file")
    if use.none_clears:
        parts.append("`none` for nothing")
    parts += [f"sets `{other}` too" for other in use.sets]
    parts += [f"switches on 0x{bits:x} of `{flags}`" for flags, bits in use.turns_on]
    return "; ".join([*parts, *([use.note] if use.note else [])])
