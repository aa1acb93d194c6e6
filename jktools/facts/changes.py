"""Which surfaces the scripts of a level can open to sight and movement, or shut."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.cog.rates import Site
from jktools.model import Level

OF_SURFACES = frozenset({"setadjoinflags", "clearadjoinflags", "setsurfaceflags", "clearsurfaceflags"})
OF_SECTORS = frozenset({"sectoradjoins"})


def changeable_surfaces(level: Level, instances: Iterable[InstanceFacts], others: Iterable[Analysis]) -> frozenset[int]:
    """Surfaces whose flags or adjoin flags a script of the level can change; those of an adjoin both.

    Of a placed script that cannot be read, every number of its line counts as a surface and as a sector. `others` are
    the scripts that the level does not place: what they name by a number that is not known could be any surface.
    """
    found: set[int] = set()
    for each in instances:
        analysis = each.analysis
        if each.script is None:
            for text in each.cog.values:
                if text.isdecimal():
                    found.update(_of_number(level, int(text), sector=True))
        elif analysis is not None:
            found.update(_of_script(level, analysis))
    for analysis in others:
        found.update(_of_script(level, analysis))
    behind = (level.surfaces[i].adjoin for i in found if 0 <= i < len(level.surfaces))
    mirrors = {
        int(level.adjoin_surface[a.mirror]) for a in behind if a is not None and 0 <= a.mirror < len(level.adjoins)
    }
    return frozenset(i for i in found | mirrors if 0 <= i < len(level.surfaces))


def _of_script(level: Level, analysis: Analysis) -> Iterator[int]:
    for site in analysis.rates.sites:
        if site.verb.name in OF_SURFACES or site.verb.name in OF_SECTORS:
            yield from _of_call(level, analysis, site, sector=site.verb.name in OF_SECTORS)


def _of_call(level: Level, analysis: Analysis, site: Site, *, sector: bool) -> Iterator[int]:
    number = site.arguments[0].number if site.arguments else None
    if number is not None:
        yield from _of_number(level, int(number), sector=sector, surface=not sector)
        return
    kind = "sector" if sector else "surface"
    held = [slot for slot in analysis.program.slots if slot.type == kind and slot.takes_value]
    if not held:
        yield from range(len(level.surfaces))
    for slot in held:
        value = (analysis.bound or {}).get(slot.index)
        if isinstance(value, int):
            yield from _of_number(level, value, sector=sector, surface=not sector)


def _of_number(level: Level, number: int, *, sector: bool, surface: bool = True) -> Iterator[int]:
    if surface:
        yield number
    if sector and 0 <= number < len(level.sectors):
        yield from (each.index for each in level.sectors[number].surfaces)
