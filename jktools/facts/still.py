"""Which things stay where they are placed, as they are, for as long as a level runs; and what may come into a line.

Of types that neither the engine nor the player moves, takes or kills: cog, ghost and camera, without a way to move, a
life time, or a game mode or difficulty that they are left out of. A script may do anything to a thing that it can hand
to a verb, but for verbs that only light, sound, tell or ask. What a script that is not at hand names may change too.

The game's own scripts (items.dat, static.jkl), where they are not at hand, are taken to leave such things alone, and
to create none that is solid and of type cog.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from jktools.engine import sight
from jktools.engine.profile import Engine
from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.hotspots.ends import ends
from jktools.facts.hotspots.runners import Runner, class_name
from jktools.facts.reachability import Reach
from jktools.model import Level, Thing
from jktools.model.cog.verbs import Verb
from jktools.model.resolved import Resolved
from jktools.syntax.template.parameters import TYPES

STILL_TYPES = frozenset({"cog", "ghost", "camera"})
LEFT_OUT = 0x1F000
"""Thing flags: not in easy, medium, hard, multiplayer or single player."""
HARMLESS = frozenset(
    {
        "capturething", "damagething", "healthing", "playsoundclass", "playsoundthing", "playsoundthinglocal",
        "playvoicething", "releasething", "sendtrigger", "setcamerafocus", "sethealth", "setthingcapturecog",
        "setthingclasscog", "setthingcurgeomode", "setthingcurlightmode", "setthingcurtexmode", "setthinggeomode",
        "setthinghealth", "setthinglight", "setthinglightmode", "setthingpulse", "setthingtexmode", "setthingtimer",
        "setthinguserdata", "syncthingattachment", "syncthingpos", "syncthingstate", "thinglight", "thinglightanim",
        "waitforstop", "addthingvel", "applyforce", "setthingvel", "creatething", "createthinglocal", "createthingnr",
    }
)  # fmt: skip
"""Verbs that leave a thing that stays where it is, and as solid; forces move only what moves by physics."""
CREATING = (
    "creatething", "createthingatpos", "createthingatposnr", "createthingatposold", "createthingatposowner",
    "createthinglocal", "createthingnr", "createbackpack", "fireprojectile", "fireprojectiledata",
    "fireprojectilelocal",
)  # fmt: skip


class Still:
    """What stays, in one level with all its scripts."""

    def __init__(
        self, level: Level, instances: Iterable[InstanceFacts], runners: Iterable[Runner], reach: Reach
    ) -> None:
        """`runners` are the scripts that run and can be read."""
        self.level, self.reach = level, reach
        self._runners = tuple(runners)
        self._read = {runner.name for runner in self._runners}
        self._unread = [each for each in instances if each.script is None]
        self._placed = [thing for thing in level.things if thing.dropped is None]
        self._touched = self._all_touched()
        verbs = {site.verb.name for runner in self._runners for site in runner.analysis.rates.sites}
        self._creates = bool(verbs & set(CREATING))

    def stays(self, thing: Thing) -> bool:
        """Whether a thing is in its place, and solid or not, as it is placed at all times and in all modes."""
        held = thing.resolved
        own = class_name(thing)
        return (
            thing.dropped is None
            and held.type in STILL_TYPES
            and not held.leaves_level
            and held.move == "none"
            and held.number("timer") == 0
            and not held.flags("thingflags") & (LEFT_OUT | sight.THING_DISABLED | sight.THING_WILL_BE_REMOVED)
            and (own is None or own in self._read)
            and thing.number not in self._touched
        )

    def is_clear(self, engine: Engine) -> bool:
        """Whether nothing that blocks in a profile can come into a line that it does not stand in."""
        if (
            self._creates
            or self._unread
            or any(self._may_block(t.resolved, engine) for t in self._placed if self._turns(t))
        ):
            return False
        if engine is Engine.RESEARCH and any(thing.resolved.type == "player" for thing in self._placed):
            return False  # players shoot
        created = {name for held in self._reached() for _, name, _ in held.templates}
        templates = (self.level.resolved_templates.get(name) for name in created)
        return not any(held is not None and self._may_block(held, engine) for held in templates)

    def _reached(self) -> Iterator[Resolved]:
        yield from (held for held in self.level.resolved_templates.entries if self.reach.has(held))
        yield from (thing.resolved for thing in self._placed)

    def _turns(self, thing: Thing) -> bool:
        """Whether a thing may be elsewhere, or solid though it is not placed so."""
        return not self.stays(thing)

    def _may_block(self, held: Resolved, engine: Engine) -> bool:
        """Whether it blocks, or may: what is touched can become solid and change its type."""
        touched = getattr(held.owner, "number", None) in self._touched
        if touched or held.leaves_level:
            return True
        return held.number("collide") != 0 and (engine is Engine.RESEARCH or held.type == "cog")

    # ---- what scripts do

    def _all_touched(self) -> frozenset[int]:
        """The numbers of the things that some script may change."""
        found: set[int] = set()
        for each in self._unread:
            found.update(int(text) for text in each.cog.values if text.isdecimal() and len(text) < 10)
        for runner in self._runners:
            for site in runner.analysis.rates.sites:
                place = _first_thing(site.verb)
                if place is not None and not site.verb.pure and site.verb.name not in HARMLESS:
                    for end in ends(runner, site, place):
                        found.update(self._meant(runner, end.kind, end.number, end.mask))
        return frozenset(found)

    def _meant(self, runner: Runner, kind: str, number: int, mask: int) -> Iterator[int]:
        if kind == "thing":
            yield number
        elif kind == "carrier":
            yield from (thing.number for thing in runner.things)
        elif kind != "player":
            mask = mask if kind == "seen" else -1
            yield from (t.number for t in self._placed if mask >> TYPES.index(t.resolved.type) & 1)


def _first_thing(verb: Verb) -> int | None:
    return next((i for i, argument in enumerate(verb.args) if argument.kind == "thing"), None)
