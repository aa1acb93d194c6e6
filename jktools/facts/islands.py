"""Parts of a level that no player comes to."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.travel import Ways, reached
from jktools.model import Level, Thing

ITEM = "item"


class Island(NamedTuple):
    """Sectors that hang together, none of which a player comes to."""

    sectors: tuple[int, ...]
    items: tuple[Thing, ...]
    """Those in it that no script can take out."""
    leads_out: bool
    """Whether a player who was in it could come out, as from a window that lets nobody in."""

    @property
    def size(self) -> str:
        """For messages."""
        count = f"{len(self.sectors)} sectors" if len(self.sectors) > 1 else "one sector"
        return f"{count}, from which ways lead out, but none in" if self.leads_out else count


def islands(
    level: Level, visited: frozenset[int] | None, ways: Ways, instances: Iterable[InstanceFacts]
) -> list[Island]:
    """The parts of a level that players do not come to, in the order of their first sector.

    `visited` are the sectors that they come to, None where that is not known; `ways` lead from sector to sector. An
    item that a placed script names is in nobody's list: the script may give it to the player.
    """
    if not visited:
        return []
    handed = _handed(instances)
    items: dict[int, list[Thing]] = {}
    for thing in level.things:
        if thing.dropped is None and thing.resolved.type == ITEM and thing.number not in handed:
            items.setdefault(thing.sector_index, []).append(thing)
    return [
        Island(part, tuple(t for s in part for t in items.get(s, ())), any(b in visited for s in part for b in ways[s]))
        for part in _parts(ways, [s for s in range(len(level.sectors)) if s not in visited])
    ]


def _parts(ways: Ways, sectors: Sequence[int]) -> list[tuple[int, ...]]:
    """Cut sectors into those that hang together, whichever way one leads to the other."""
    both: dict[int, list[int]] = {sector: [] for sector in sectors}
    for sector in sectors:
        for behind in ways[sector]:
            if behind in both:
                both[sector].append(behind)
                both[behind].append(sector)
    around = [both.get(sector, []) for sector in range(len(ways))]
    found: list[tuple[int, ...]] = []
    seen: set[int] = set()
    for sector in sectors:
        if sector not in seen:
            part = reached(around, [sector])
            seen |= part
            found.append(tuple(sorted(part)))
    return found


def _handed(instances: Iterable[InstanceFacts]) -> frozenset[int]:
    """The numbers of things that placed scripts name; each number of a line whose script is not at hand."""
    found: set[int] = set()
    for instance in instances:
        if instance.script is None:
            found.update(int(text) for text in instance.cog.values if text.isdecimal() and len(text) < 10)
        found.update(v.value for v in instance.values if v.slot.type == "thing" and isinstance(v.value, int))
    return frozenset(found)
