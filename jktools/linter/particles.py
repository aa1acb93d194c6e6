"""Which clouds of particles are at fault, each fault once: where it first comes in."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from jktools.facts.particles import PARTICLE, Cloud, own_clouds
from jktools.facts.reachability import Reach
from jktools.model import Level
from jktools.model.objects import Template
from jktools.model.resolved import Resolved

Fault = Callable[[Cloud], "str | None"]
"""Which parameter is at fault; None for a sound cloud."""


def new_faults(level: Level, reach: Reach, fault: Fault) -> Iterator[tuple[Cloud, str]]:
    """The clouds that the level makes and that are at fault, with the parameter; not those that only inherit it.

    A template that the level can reach is told itself, unless things are placed of it and all of them mend it; a
    thing is told for what its own line does.
    """
    found = {id(cloud.template): (cloud, _known(cloud, fault(cloud))) for cloud in own_clouds(level)}
    made: dict[int, list[Resolved]] = {}
    for cloud, _ in found.values():
        if not isinstance(cloud.template.owner, Template) and cloud.template.parent is not None:
            made.setdefault(id(cloud.template.parent), []).append(cloud.template)

    def is_told(held: Resolved | None, key: str) -> bool:
        """Whether a template is at fault in the same way, and the level makes it as it is."""
        if held is None or held.type != PARTICLE or id(held) not in found or found[id(held)][1] != key:
            return False
        placed = made.get(id(held), ())
        return reach.has(held) and (not placed or any(found[id(thing)][1] == key for thing in placed))

    for cloud, key in found.values():
        held = cloud.template
        if key is None or is_told(held.parent, key):
            continue
        if not isinstance(held.owner, Template) or is_told(held, key):
            yield cloud, key


def _known(cloud: Cloud, key: str | None) -> str | None:
    """The fault, unless the value may come from a template that is not at hand."""
    return None if key is not None and cloud.template.leaves_level and key not in cloud.template.values else key
