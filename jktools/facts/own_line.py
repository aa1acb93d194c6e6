"""Templates and placed things alike, and what their own lines set: a fault is told where it is written."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.model import Level
from jktools.model.resolved import Origin, Resolved


def templates_and_things(level: Level) -> Iterator[Resolved]:
    """The templates that the engine keeps, then the things that it places."""
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        if held.dropped is None:
            yield held


def own_origin(held: Resolved, *keys: str) -> Origin | None:
    """Where its own line sets the first of these parameters that it sets; None where it only inherits them."""
    for key in keys:
        setting = held.values.get(key)
        if setting is not None and setting.origins[0].owner == held.owner:
            return setting.origins[0]
    return None
