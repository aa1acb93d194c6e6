"""The scripts that run in a level: each placed one, and each class COG with the things that carry it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.reachability import Reach
from jktools.facts.script import ScriptFacts
from jktools.model import Cog, Level, Thing
from jktools.syntax.cog.nodes import String

NO_THING = 0x1
"""Mask bit of a symbol whose script gets messages that no thing causes, as pulses (sithCog_SendMessageFromThingEx)."""

CAPTURE = "capturething"
"""From then on the thing sends its messages to the script too."""

ScriptOf = Callable[[str], "ScriptFacts | None"]


@dataclass(frozen=True, slots=True, eq=False)
class Runner:
    """One running copy of a script.

    A class COG has one copy for all the things that carry it; what comes from a thing (`created`, its pulse and its
    timer) still comes once for each (sithCog_HandleThingTimerPulse in the decompiled engine).
    """

    name: str
    """The script's, in lower case."""
    script: ScriptFacts
    analysis: Analysis
    things: tuple[Thing, ...]
    """Those whose messages it gets: the carriers of a class COG, those that a placed one is linked to or captures."""
    cog: Cog | None = None
    """The placed one; None for a class COG."""
    more: bool = False
    """Whether play can create more things that carry it: how many is not known."""

    @property
    def title(self) -> str:
        """For messages: `cog 3 (00_lamp.cog)`, `class cog lamp.cog on 60 things`."""
        if self.cog is not None:
            return self.cog.title
        count = len(self.things)
        more = " and what is created" if self.more else ""
        return f"class cog {self.name} on {count} thing{'' if count == 1 else 's'}{more}"

    @property
    def place(self) -> tuple[int, int]:
        """For sorting: placed ones first, then class COGs by their first thing."""
        return (0, self.cog.index) if self.cog is not None else (1, self.things[0].index)


def class_name(thing: Thing) -> str | None:
    """The class COG that a thing carries, in lower case."""
    return thing.resolved.name_in("cog")


def runners(level: Level, instances: Iterable[InstanceFacts], script_of: ScriptOf) -> list[Runner]:
    """Every script of the level's own that runs and can be read: those of static.jkl and items.dat are left out."""
    placed = [thing for thing in level.things if thing.dropped is None]
    by_number = {thing.number: thing for thing in placed}
    found = [
        Runner(each.cog.name.lower(), each.script, analysis, tuple(_linked(each, by_number)), each.cog)
        for each in instances
        if each.script is not None and (analysis := each.analysis) is not None
    ]
    carriers: dict[str, list[Thing]] = {}
    for thing in placed:
        name = class_name(thing)
        if name is not None:
            carriers.setdefault(name, []).append(thing)
    for name, things in carriers.items():
        script = script_of(name)
        if script is not None and not script.script.rejected:
            found.append(Runner(name, script, Analysis(script.program, {}, script.analysis), tuple(things)))
    return found


def _linked(instance: InstanceFacts, by_number: Mapping[int, Thing]) -> Iterator[Thing]:
    """The things whose pulses and timers reach a placed script: linked by a symbol, or captured."""
    numbers: list[int] = []
    for each in instance.values:
        symbol = each.slot.declared
        linked = each.slot.type == "thing" and symbol is not None and symbol.link >= 0 and symbol.mask & NO_THING
        if linked and isinstance(each.value, int):
            numbers.append(each.value)
    for number in dict.fromkeys([*numbers, *_captured(instance)]):
        if number in by_number:
            yield by_number[number]


def _captured(instance: InstanceFacts) -> Iterator[int]:
    """What CaptureThing binds to a script; any thing of its line where it is not known which."""
    analysis = instance.analysis
    for site in analysis.rates.sites if analysis is not None else ():
        if site.verb.name == CAPTURE and site.arguments:
            number = site.arguments[0].number
            if number is not None:
                yield int(number)
            else:
                yield from (v.value for v in instance.values if v.slot.type == "thing" and isinstance(v.value, int))


def with_created(level: Level, found: Sequence[Runner], reach: Reach) -> list[Runner]:
    """The same, with `more` set for class COGs of templates that something other than the level's things names."""
    names = {w.value.lower() for r in found for w in r.script.script.code.words if isinstance(w, String)}
    for cog in level.cogs:
        names.update(value.lower() for value in cog.values)
    for held in level.resolved_templates.entries:
        if reach.has(held):
            names.update(name for _, name, _ in held.templates)
    created = set()
    for name in names & reach.templates.keys():
        template = level.resolved_templates.get(name)
        if template is not None:
            created.add(template.name_in("cog"))
    return [replace(runner, more=runner.cog is None and runner.name in created) for runner in found]
