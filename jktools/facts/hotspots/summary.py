"""Hotspots in the shape of reports."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

import msgspec

from jktools.facts.hotspots.hotspots import Cost, Hotspot

MOST_CAUSES = 3
"""Causes that a message names."""


class CostSummary(msgspec.Struct, frozen=True):
    """What one call of a verb of sight costs in a level."""

    level: str
    """Path."""
    runner: str
    """What runs the script: `cog 3 (00_lamp.cog)`, `class cog lamp.cog on 60 things`."""
    verb: str
    line: int
    """In the script, from 1."""
    calls_per_second: float | None
    """At most, of what is known and lasts; None where nothing bounds it."""
    more: bool
    """Whether there can be more calls than is known."""
    causes: tuple[str, ...]
    """The messages from the player or the world each of which can make more calls."""
    mean_sectors: float
    """Sectors entered in one call."""
    mean_surfaces: float
    """Surfaces tested in one call."""
    most_sectors: int
    most_surfaces: int
    pairs: int
    """Pairs of places that were tried; 0 where nothing is known of the ends."""
    verdict: str
    """`always`, `never` or `varies`, where both profiles agree; else `varies`."""
    verdicts: Mapping[str, str]
    """The same by profile."""
    finds: str | None
    """In words; None where it varies by both."""
    help: str
    """What would make it cheaper."""


def frequency(calls: float | None, more: bool, causes: Sequence[str]) -> str:
    """For messages: `at most 4 times a second`, `after each touched`, `how often is not known`."""
    words = []
    if calls is None or math.isinf(calls):
        words.append("any number of times a second")
    elif calls:
        words.append(f"at most {calls:.6g} time{'' if calls == 1 else 's'} a second")
    if causes:
        left = len(causes) - MOST_CAUSES
        words.append("after each " + ", ".join(causes[:MOST_CAUSES]) + f" and {left} more" * (left > 0))
    if more:
        words.append("more often by what is not known" if words else "how often is not known")
    return ", ".join(words) or "not after the start"


def mean_work(cost: Cost | CostSummary) -> str:
    """For messages: `9 surfaces in 1.5 sectors on the mean`."""
    parts = [
        f"{count:.6g} {kind}{'' if count == 1 else 's'}"
        for count, kind in ((cost.mean_surfaces, "surface"), (cost.mean_sectors, "sector"))
    ]
    return f"{' in '.join(parts)} on the mean"


def summarise_costs(path: str, spots: Iterable[Hotspot]) -> Mapping[str, list[CostSummary]]:
    """The hotspots of a level by the lower-case name of their script, the dearest first."""
    found: dict[str, list[CostSummary]] = {}
    for spot in spots:
        calls = spot.calls_per_second
        found.setdefault(spot.runner.name, []).append(
            CostSummary(
                path,
                spot.runner.title,
                spot.site.verb.name,
                spot.runner.script.span(spot.site.call).first.line,
                None if math.isinf(calls) else calls,
                spot.more,
                spot.causes,
                spot.cost.mean_sectors,
                spot.cost.mean_surfaces,
                spot.cost.most_sectors,
                spot.cost.most_surfaces,
                spot.cost.pairs,
                spot.verdict.value,
                {engine.value: verdict.value for engine, verdict in spot.verdicts.items()},
                spot.finds,
                spot.help,
            )
        )
    return found
