"""A resolved template or thing: every value with the line that it comes from, as text and as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from jktools import __version__
from jktools.emit.json import VERSION, dump
from jktools.facts import LevelFacts
from jktools.facts.reachability import Reach
from jktools.model import Level, Template, Thing
from jktools.model.resolved import Ignored, Origin, Reason, Resolved, Setting
from jktools.model.wanted import wanted_value
from jktools.syntax.template.parameters import PARAMETERS
from jktools.syntax.template.values import ValueKind

MOST_FRAMES = 3
"""Frames and debris written out in the text; JSON has them all."""

MOST_ANCESTORS = 20
"""Likewise."""


def text(held: Resolved) -> Iterator[str]:
    """Lines for a terminal."""
    yield f"{title(held.owner)} of {held.owner.level.path}"
    chain = [_short(each.owner) for each in held.chain]
    if len(chain) > MOST_ANCESTORS:
        chain = [*chain[: MOST_ANCESTORS // 2], f"... ({len(chain)})", *chain[-MOST_ANCESTORS // 2 :]]
    yield "  " + " <- ".join([*chain, _base(held)])
    if held.dropped is not None:
        yield f"  the engine does not keep it: {held.dropped}"
    if held.leaves_level:
        yield "  a template above it is not in the level; values that the game's own may give are missing here"
    if held.owner.level.has_geometry and isinstance(held.owner, Template) and held.dropped is None:
        yield f"  {_reached(held)}"
    yield ""
    rows = [_row(key, setting, held) for key, setting in _in_order(held)]
    widths = [max((len(row[i]) for row in rows), default=0) for i in range(4)]
    for row in rows:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=False)]
        yield ("  " + "  ".join([cells[0], cells[1].rjust(widths[1]), *cells[2:], row[4]])).rstrip()
    yield from _told("nothing comes of", [(*_cells(i.origin), _word(i), why(i)) for i in _all_ignored(held)])
    lost = [(lost, each) for each in held.chain for lost in each.lost]
    yield from _told(
        "lost on the way",
        [(*_cells(s.origins[0]), f"{k}={s.text}", f"{o.span.text} gives its memory away") for (k, s, o), _ in lost],
    )
    yield from _told(
        "in memory, but unused",
        [
            (*_cells(s.origins[0]), f"{key}={s.text}", f"it is for {parked.scope.value}")
            for parked in held.parked.values()
            for key, s in parked.values.items()
        ],
    )


def _reached(held: Resolved) -> str:
    """Whether the level can reach a template, and the first way there."""
    reached = LevelFacts(held.owner.level).reach
    way = _way(held, reached)
    if way is not None:
        return f"reached: {way}"
    return "nothing reaches it" if reached.is_complete else "nothing is known to reach it; not all COGs are at hand"


def _way(held: Resolved, reached: Reach) -> str | None:
    return reached.templates.get(str(held.owner.name).lower()) if reached.has(held) else None


def listing(level: Level) -> Iterator[str]:
    """One line a template of a level."""
    rows = [
        (str(t.index), t.name, t.parent_name, t.resolved.type if t.resolved.knows_type else "?", t.dropped or "")
        for t in level.templates
    ]
    if not rows:
        yield f"{level.path} has no templates"
    widths = [max((len(row[i]) for row in rows), default=0) for i in range(4)]
    for row in rows:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=False)]
        note = f"  not kept: {row[4]}" if row[4] else ""
        yield ("  ".join([row[0].rjust(widths[0]), cells[1], "<- " + cells[2], cells[3]]) + note).rstrip()


def json(held: Resolved) -> str:
    """The same as JSON; its shape is docs/template.schema.json."""
    return dump(
        {
            "version": VERSION,
            "tool": {"name": "jktools", "version": __version__},
            "path": held.owner.level.path,
            **_owner(held.owner),
            "type": held.type,
            "move": held.move,
            "has_ai": held.has_ai,
            "dropped": held.dropped,
            "leaves_level": held.leaves_level,
            "reached": _way(held, LevelFacts(held.owner.level).reach) if isinstance(held.owner, Template) else None,
            "chain": [{**_owner(each.owner), "path": each.owner.level.path} for each in held.chain],
            "parameters": [
                {
                    "key": key,
                    "value": setting.value,
                    "text": setting.text,
                    "unit": setting.use.unit or None,
                    "before": before.text if (before := _before(key, setting, held)) else None,
                    "origins": [_origin(origin) for origin in setting.origins],
                }
                for key, setting in _in_order(held)
            ],
            "ignored": [
                {"key": i.key, "text": i.text, "reason": i.reason.name.lower(), "why": why(i),
                 "origin": _origin(i.origin)}
                for i in _all_ignored(held)
            ],
            "lost": [
                {"key": lost.key, "text": lost.setting.text, "origins": [_origin(o) for o in lost.setting.origins],
                 "to": _origin(lost.origin)}
                for each in held.chain for lost in each.lost
            ],
            "unused": [
                {"key": key, "text": setting.text, "for": parked.scope.value,
                 "origins": [_origin(o) for o in setting.origins]}
                for parked in held.parked.values() for key, setting in parked.values.items()
            ],
        }
    )  # fmt: skip


def title(owner: Template | Thing) -> str:
    """`walkplayer, template 12`."""
    return f"{_short(owner)}, template {owner.index}" if isinstance(owner, Template) else owner.title


def why(ignored: Ignored) -> str:
    """Why nothing comes of a parameter, with what it would take."""
    uses = PARAMETERS[ignored.key].uses if ignored.key in PARAMETERS else ()
    match ignored.reason:
        case Reason.NOT_FOR_THIS:
            return f"it is for {_joined([use.scope.value for use in uses])}, but this is {_kind(ignored)}"
        case Reason.REJECTED:
            return f"the engine takes {wanted_value(ignored)}"
        case Reason.FULL:
            return "4 debris are there already" if ignored.key == "debris" else "numframes makes no more room"
        case _:
            return str(ignored.reason.value)


def _kind(ignored: Ignored) -> str:
    return f"type {ignored.type}, move {ignored.move}"


def _joined(parts: Sequence[str]) -> str:
    return " or ".join(dict.fromkeys(parts))


def _short(owner: Template | Thing) -> str:
    return owner.name if isinstance(owner, Template) else f"thing {owner.number}"


def _base(held: Resolved) -> str:
    last = [*held.chain][-1].owner
    name = last.parent_name if isinstance(last, Template) else last.template_name
    return name if name.lower() == "none" else f"{name} (not in the level)"


_ORDER = {key: i for i, key in enumerate(PARAMETERS)}


def _in_order(held: Resolved) -> list[tuple[str, Setting]]:
    return sorted(held.values.items(), key=lambda item: _ORDER[item[0]])


def _all_ignored(held: Resolved) -> list[Ignored]:
    return [ignored for each in held.chain for ignored in each.ignored]


def _before(key: str, setting: Setting, held: Resolved) -> Setting | None:
    """What the parent had, where the own line changed it."""
    before = None if held.parent is None else held.parent.values.get(key)
    return before if before is not None and before.value != setting.value else None


def _cells(origin: Origin) -> tuple[str, str]:
    first = origin.span.first
    return _short(origin.owner), f"{first.line}:{first.column}"


def _row(key: str, setting: Setting, held: Resolved) -> tuple[str, str, str, str, str]:
    shown = setting.text
    if isinstance(setting.value, tuple) and len(setting.origins) > MOST_FRAMES:
        shown = " ".join(shown.split()[:MOST_FRAMES]) + f" ... ({len(setting.value)})"
    if setting.value is None:
        shown += " (nothing)" if setting.use.refers is not None else " (not at hand)"
    notes = [setting.use.unit] if setting.use.unit else []
    first, *more = setting.origins
    if setting.use.kind is ValueKind.HEX:
        notes += [f"with {o.span.text} of {_short(o.owner)}" for o in more]
    if not any(o.span.text.lower().startswith(key + "=") for o in setting.origins) and first.place >= 0:
        notes.append(f"by {first.span.text}")
    before = _before(key, setting, held)
    if before is not None:
        notes.append(f"was {before.text} from {_short(before.origins[0].owner)}")
    return (*_cells(first), key, shown, "; ".join(notes))


def _word(ignored: Ignored) -> str:
    return ignored.key if ignored.key == ignored.text else f"{ignored.key}={ignored.text}"


def _told(heading: str, rows: Sequence[tuple[str, str, str, str]]) -> Iterator[str]:
    if not rows:
        return
    yield ""
    yield f"  {heading}:"
    widths = [max(len(row[i]) for row in rows) for i in range(3)]
    for owner, place, word, told in rows:
        yield f"  {owner.ljust(widths[0])}  {place.rjust(widths[1])}  {word.ljust(widths[2])}  {told}"


def _owner(owner: Template | Thing) -> dict[str, Any]:
    number = None if isinstance(owner, Template) else owner.number
    name = owner.name if isinstance(owner, Template) else owner.template_name
    return {"kind": owner.kind, "index": owner.index, "number": number, "name": name}


def _origin(origin: Origin) -> dict[str, Any]:
    first = origin.span.first
    return {
        **_owner(origin.owner), "path": origin.owner.level.path, "line": first.line, "column": first.column,
        "text": origin.span.text,
    }  # fmt: skip
