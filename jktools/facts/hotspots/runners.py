"""The scripts that run in a level: each placed one, and each class COG with the things that carry it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.dataflow import default_value
from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.cog.stack import written
from jktools.facts.hotspots.traces import leaves
from jktools.facts.reachability import ITEMS, OF_STATIC, STATIC, Reach
from jktools.facts.script import ScriptFacts
from jktools.model import Cog, Level, Thing
from jktools.model.cog.verbs import all_verbs
from jktools.model.resolved import Resolved
from jktools.model.resources import Kind, Resources
from jktools.source import InputError
from jktools.syntax.assets.small import Items

NO_THING = 0x1
"""Mask bit of a symbol whose script gets messages that no thing causes, as pulses (sithCog_SendMessageFromThingEx)."""

CAPTURE = "capturething"
"""From then on the thing sends its messages to the script too."""

COSTLY = tuple(sorted(verb.name.encode() for verb in all_verbs().values() if verb.sight in ("ray", "flood")))
"""The names of the verbs of sight that cost something."""

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
    """The carriers of a class COG; those that a placed one is linked to or captures."""
    cog: Cog | None = None
    """The one that the level places; None for a class COG and for one of the game's own."""
    more: bool = False
    """Whether it can get messages from things that are not known: how many play creates, or which it captures."""
    captures: bool = False
    """Whether it captures things that are not known."""
    links: Mapping[int, int] = field(default_factory=dict)
    """By number of a thing: how often each of its messages comes."""
    number: int = -1
    """The engine's; -1 where it is not known."""
    of: str = ""
    """The file of the game that runs it, `static.jkl` or `items.dat`; empty for one of the level's."""
    template: Resolved | None = None
    """Of a class COG that no placed thing carries: a template that does."""

    @property
    def title(self) -> str:
        """For messages: `cog 3 (00_lamp.cog)`, `class cog lamp.cog on 60 things`."""
        if self.cog is not None:
            return self.cog.title
        if self.of:
            return f"{self.name} of {self.of}"
        count = len(self.things)
        more = " and others" if self.more else ""
        return f"class cog {self.name} on {count} thing{'' if count == 1 else 's'}{more}"

    @property
    def place(self) -> tuple[int, int, str]:
        """For sorting: placed ones first, then class COGs by their first thing, those of things to come, the game's."""
        if self.cog is not None:
            return 0, self.cog.index, self.name
        if self.things:
            return 1, self.things[0].index, self.name
        return (2, 0, self.name) if not self.of else (3, self.number, self.name)


def class_name(thing: Thing) -> str | None:
    """The class COG that a thing carries, in lower case."""
    return thing.resolved.name_in("cog")


def runners(level: Level, instances: Iterable[InstanceFacts], script_of: ScriptOf) -> list[Runner]:
    """Every script that runs from the start and can be read: those that the level places, and its things carry."""
    placed = [thing for thing in level.things if thing.dropped is None]
    by_number = {thing.number: thing for thing in placed}
    found = [
        _placed(each, each.script, analysis, by_number)
        for each in instances
        if each.script is not None and (analysis := each.analysis) is not None
    ]
    carriers: dict[str, list[Thing]] = {}
    for thing in placed:
        name = class_name(thing)
        if name is not None:
            carriers.setdefault(name, []).append(thing)
    for name, things in carriers.items():
        class_cog = _class_cog(name, script_of, things)
        if class_cog is not None:
            found.append(class_cog)
    return found


def _placed(instance: InstanceFacts, script: ScriptFacts, analysis: Analysis, by_number: Mapping[int, Thing]) -> Runner:
    links = Counter(_linked(instance))
    captured, known = _captured(analysis)
    if not known:
        captured |= {v.value for v in instance.values if v.slot.type == "thing" and isinstance(v.value, int)}
    links.update(captured)
    present = {number: count for number, count in links.items() if number in by_number}
    things = tuple(by_number[number] for number in present)
    name = instance.cog.name.lower()
    return Runner(
        name, script, analysis, things, instance.cog, not known, not known, present, instance.number
    )  # fmt: skip


def _class_cog(name: str, script_of: ScriptOf, things: Sequence[Thing] = ()) -> Runner | None:
    script = script_of(name)
    if script is None or script.script.rejected:
        return None
    analysis = Analysis(script.program, {}, script.analysis)
    captured, known = _captured(analysis)
    links = Counter(thing.number for thing in things)
    links.update(captured)
    return Runner(name, script, analysis, tuple(things), more=not known, captures=not known, links=links)


def _linked(instance: InstanceFacts) -> Iterator[int]:
    """The numbers of the things whose pulses and timers reach a placed script by its symbols, once for each symbol."""
    values = {each.slot.index: each.value for each in instance.values}
    for slot in instance.script.program.valued if instance.script is not None else ():
        symbol = slot.declared
        if slot.type == "thing" and symbol is not None and symbol.link >= 0 and symbol.mask & NO_THING:
            value = values.get(slot.index, default_value("thing", symbol.default))
            if isinstance(value, int):
                yield value


def _captured(analysis: Analysis) -> tuple[set[int], bool]:
    """The numbers of the things that CaptureThing binds to a script, and whether those are all."""
    found: set[int] = set()
    known = True
    for site in analysis.rates.sites:
        if site.verb.name != CAPTURE or not site.arguments:
            continue
        number = site.arguments[0].number
        if number is not None:
            found.add(int(number))
            continue
        given = written(analysis.program, site.call)[0]
        for leaf in [None] if given is None else leaves(analysis, given, starts=True):
            if isinstance(leaf, int):
                found.add(leaf)
            else:
                known = False
    return found, known


# ---- what is not there from the start


def class_scripts(level: Level) -> Iterator[str]:
    """The names of the class COGs that any template or thing carries, reached or not, in lower case."""
    for held in level.resolved_templates.by_name.values():
        name = held.name_in("cog")
        if name is not None:
            yield name
    for thing in level.things:
        name = class_name(thing)
        if name is not None:
            yield name


def mentions_sight(resources: Resources, name: str) -> bool:
    """Whether the text of a script names a verb of sight that costs something, in its code or in a comment."""
    found = resources.find(Kind.COG, name)
    if found is None:
        return False
    try:
        text = bytes(resources.read(found).data).lower()
    except InputError:
        return False
    return any(verb in text for verb in COSTLY)


def with_created(level: Level, found: Sequence[Runner], reach: Reach, script_of: ScriptOf) -> list[Runner]:
    """The same with `more` set for class COGs of templates that play can create, and with those that it alone does."""
    created: dict[str, Resolved] = {}
    for name in sorted(reach.created):
        template = level.resolved_templates.get(name)
        carried = None if template is None else template.name_in("cog")
        if template is not None and carried is not None:
            created.setdefault(carried, template)
    there = {runner.name for runner in found if runner.cog is None}
    told = [replace(r, more=True) if r.cog is None and r.name in created else r for r in found]
    for name, template in created.items():
        class_cog = None if name in there else _class_cog(name, script_of)
        if class_cog is not None:
            told.append(replace(class_cog, more=True, template=template))
    return told


def game_scripts(level: Level) -> Iterator[tuple[str, str]]:
    """The scripts that the game runs in every level, as far as its files are at hand: name and file that names it."""
    if level.static is not None:
        yield from ((cog.name.lower(), STATIC) for cog in level.static.cogs)
    items = level.resources.asset(Kind.ITEMS, ITEMS)
    if isinstance(items, Items):
        names = (item.cog.lower() for item in items.items if item.cog is not None and item.cog.lower() != "none")
        yield from ((name, ITEMS) for name in dict.fromkeys(names))


def game_runners(level: Level, script_of: ScriptOf) -> list[Runner]:
    """Those of the game's scripts that can be read. None is linked to a thing of the level (sithCog_Open)."""
    found = []
    number = OF_STATIC
    values = [] if level.static is None else list(level.static.cogs)
    for position, (name, of) in enumerate(game_scripts(level)):
        script = script_of(name)
        if script is None or script.script.rejected:
            number += of == STATIC and script is None
            continue
        if of == STATIC:
            placed = InstanceFacts(values[position], script, number)
            if placed.analysis is not None:
                captured, known = _captured(placed.analysis)
                runner = Runner(name, script, placed.analysis, (), number=number, of=of, links=Counter(captured))
                found.append(replace(runner, more=not known, captures=not known))
            number += 1
        else:
            item = _class_cog(name, script_of)
            found += [] if item is None else [replace(item, of=of)]
    return found
