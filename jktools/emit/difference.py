"""What differs between two levels, as text and as JSON."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

from jktools import __version__
from jktools.compiler.comparison import Difference, FieldChange
from jktools.emit.json import dump
from jktools.emit.printable import printable

NO_SURFACE = -1
"""The number of an edge that is a thing's."""

VERSION = 1
"""Of the shape of the JSON; grows when a reader would have to change."""

SHOWN = 10
"""Records of one kind and change that the text shows, unless all are asked for."""
WIDE = 72
"""Characters of a value that the text shows."""
LABELS = {
    "edge": "edge of surface", "view": "view from sector", "light": "light of thing", "cloud": "cloud of template",
    "motion": "motion of template", "hotspot": "hotspot of cog", "colour effect": "colour effect of cog",
}  # fmt: skip
"""What the number of a record counts, where it is not its own kind."""
PLURALS = {"vertex": "vertices", "body": "bodies", "settings": "settings"}


def text(names: tuple[str, str], found: Sequence[Difference], *, whole: bool = False) -> Iterator[str]:
    """The lines for a terminal; `whole` shows every record."""
    both = " and ".join(printable(name) for name in names)
    if not found:
        yield f"{both}: no difference"
        return
    yield f"{both} differ: {', '.join(_counts(found))}"
    section = ""
    shown: Counter[tuple[str, str]] = Counter()
    for each in found:
        if each.section != section:
            yield from _left(shown)
            shown.clear()
            section = each.section
            yield f"{section}:"
        shown[each.kind, each.change] += 1
        if whole or shown[each.kind, each.change] <= SHOWN:
            yield from _lines(each)
    if not whole:
        yield from _left(shown)


def json(names: tuple[str, str], found: Sequence[Difference]) -> str:
    """The same as JSON; its shape is docs/diff.schema.json."""
    return dump(
        {
            "version": VERSION,
            "tool": {"name": "jktools", "version": __version__},
            "before": names[0],
            "after": names[1],
            "same": not found,
            "differences": [
                {
                    "section": each.section,
                    "kind": each.kind,
                    "change": each.change,
                    "before": each.before,
                    "after": each.after,
                    "name": each.name,
                    "fields": [
                        {"field": name, "before": _plain(before), "after": _plain(after)}
                        for name, before, after in each.fields
                    ],
                }
                for each in found
            ],
        }
    )


def _plain(value: Any) -> Any:
    """As JSON can hold it: what is infinite as text, what is not known as null."""
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value


def _counts(found: Sequence[Difference]) -> Iterator[str]:
    for (kind, change), count in Counter((each.kind, each.change) for each in found).items():
        yield f"{count} {_plural(kind, count)} {change}"


def _plural(kind: str, count: int) -> str:
    if count == 1:
        return kind
    return PLURALS.get(kind) or f"{kind}{'es' if kind.endswith('ss') else 's'}"


def _left(shown: Counter[tuple[str, str]]) -> Iterator[str]:
    for (kind, change), count in shown.items():
        if count > SHOWN:
            more = count - SHOWN
            yield f"  and {more} more {_plural(kind, more)} {change}"


def _lines(each: Difference) -> Iterator[str]:
    number = each.after if each.before is None else each.before
    what = LABELS.get(each.kind, each.kind) + ("" if number is None or not _is_numbered(each) else f" {number}")
    if each.kind == "edge" and number == NO_SURFACE:
        what = each.kind  # its name tells of which thing
    if each.after is not None and each.before is not None and each.after != each.before:
        what += f" (now {each.after})"
    name = f" ({printable(each.name)})" if each.name else ""
    if each.change != "changed":
        yield f"  {what}{name}: {each.change}"
        return
    changes = [change for field in each.fields for change in _expanded(field)]
    if len(changes) == 1:
        yield f"  {what}{name}: {changes[0]}"
        return
    yield f"  {what}{name}:"
    yield from (f"    {change}" for change in changes)


def _is_numbered(each: Difference) -> bool:
    return each.section not in ("settings", "world", "passes")


def _expanded(field: FieldChange) -> Iterator[str]:
    """A change of a field in words; of values by name and of lists, only what differs."""
    name, before, after = field
    if name == "values" and _are_settings(before) and _are_settings(after):
        one, other = ({key: (value, source) for key, value, source in side} for side in (before, after))
        for key in [*one, *(key for key in other if key not in one)]:
            if one.get(key) != other.get(key):
                yield f"{key} {_setting(one.get(key))} -> {_setting(other.get(key))}"
    elif name == "gained":
        yield f"now sees {_list(after)}"
    elif name == "lost":
        yield f"no longer sees {_list(before)}"
    elif name == "intervals":
        was, now = _intervals(before), _intervals(after)
        yield f"{was} -> {now}" if was != now else _inside_intervals(before, after)
    elif name == "position":
        yield f"position {_value(before)} -> {_value(after)}, {math.dist(before, after):.7g} JKU"
    elif isinstance(before, list) and isinstance(after, list) and len(before) == len(after) > 1:
        places = [i for i, (a, b) in enumerate(zip(before, after, strict=True)) if a != b]
        shown = ", ".join(f"[{i}] {_value(before[i])} -> {_value(after[i])}" for i in places[:2])
        yield f"{name} {shown}" + (f" and {len(places) - 2} more" if len(places) > 2 else "")
    else:
        yield f"{name} {_value(before)} -> {_value(after)}"


def _are_settings(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(each, tuple) and len(each) == 3 for each in value)


def _setting(value: tuple[Any, Any] | None) -> str:
    return "not set" if value is None else f"{_value(value[0])} (by {_value(value[1])})"


def _intervals(value: Sequence[dict[str, Any]]) -> str:
    return ", ".join(
        f"{each['kind']} {each['from']:.4g}..{each['to']:.4g}"
        + ("" if math.isnan(each["drop"][0]) else f" ({each['drop'][0]:.4g} JKU)")
        for each in value
    )


def _inside_intervals(before: Sequence[dict[str, Any]], after: Sequence[dict[str, Any]]) -> str:
    """What differs in intervals that read the same."""
    told = []
    for one, other in zip(before, after, strict=True):
        changes = [
            f"{key} {told_before} -> {told_after}"
            for key in one
            if (told_before := _exact(one[key])) != (told_after := _exact(other[key]))
        ]
        if changes:
            told.append(f"{_intervals([one])}: {', '.join(changes)}")
    return "; ".join(told)


def _exact(value: Any) -> str:
    """With as many digits as tell two numbers of single precision apart."""
    if isinstance(value, (list, tuple)):
        return f"({', '.join(map(_exact, value))})"
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def _list(values: Sequence[int]) -> str:
    more = len(values) - SHOWN
    return ", ".join(map(str, values[:SHOWN])) + (f" and {more} more" if more > 0 else "")


def _value(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.7g}"
    if isinstance(value, (list, tuple)):
        if len(value) == 1:
            return _value(value[0])
        shown = f"({', '.join(_value(each) for each in value)})"
    else:
        shown = "none" if value is None or value == "" else printable(str(value))
    return shown if len(shown) <= WIDE else f"{shown[: WIDE - 3]}..."
