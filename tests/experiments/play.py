"""smithdev in play: bodies in the level, the scripts that it places, and the messages that pass between them.

Which scripts are placed, the values of their symbols, things, templates and flags come from the compiled file; code
comes from the pack, for a compiled file holds none. Bodies move by `jktools.trace`, all else is asked of
`jktools.engine`. Time passes in frames: bodies first, then what scripts have waited for. A body meets no other; only
players, actors, crates and shots are bodies. An actor has arrived when it is within its sphere's radius of its goal,
seen from above: a distance of this test, not of the game.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np

import jktools
from fixtures.smithdev.pack import GOB
from jktools.engine import orientation
from jktools.engine.flags import PhysicsFlag
from jktools.engine.orientation import Creation
from jktools.engine.profile import Engine
from jktools.engine.thrust import ACTOR_READABLE_THRUST, Keys
from jktools.trace.in_level import body_named
from jktools.trace.script import parse
from jktools.trace.stage import Start, stage_of
from tests.experiments.living import Array, Body, LiveCollision, Thing
from tests.experiments.scripts import Placed, placed, program
from tests.experiments.smithdev import ACTOR, DEBRIS, PLAYER, WEAPON, Experiment
from tests.experiments.verbs import Running

PHYSICS = 1
"""What a template's `move` is as a number."""
BODIES = (ACTOR, WEAPON, DEBRIS, PLAYER)
ACTIVATED, STARTUP, ENTERED, EXITED, CROSSED, ARRIVED, CREATED = 1, 3, 6, 7, 8, 11, 15


class Said(NamedTuple):
    """What a script printed: when (s), its name in the chamber, and the words or the number."""

    time: float
    script: str
    what: str | float


class Moment(NamedTuple):
    """The player after a frame: s, JKU, JKU/s, JKU/s^2 in his look, the sector, whether a floor carries him."""

    time: float
    place: Array
    velocity: Array
    thrust: Array
    sector: int
    attached: bool


class Play:
    """One chamber in play, with a player in it."""

    def __init__(
        self, smithdev: Experiment, start: str, *, body: str = "walkplayer", engine: Engine = Engine.RESEARCH,
        aside: float = 0.0, frame: int = 20,
    ) -> None:  # fmt: skip
        """Start a chamber with a player at a thing of it, looking as it does, or in the middle of a sector.

        In a sector he looks as who comes in, `aside` JKU to the right of the middle. A frame is so many milliseconds.
        """
        self.smithdev, self.frame = smithdev, frame
        self.engine = engine
        self.chamber, _, name = start.partition("/")
        self.held = smithdev.handles[self.chamber]
        self.stage = stage_of(smithdev.level)
        self.collision = LiveCollision(self.stage)
        self.geo_modes: dict[int, int] = {}
        self.lights: dict[int, float] = {}
        """What scripts made of surfaces and things."""
        self.effects: list[tuple[float, ...]] = []
        self.effect: int | None = None
        self.infrared: float | None = None
        """What scripts did to the screen: every call of NewColorEffect, the one that holds, and the infrared level."""
        self._sights: dict[tuple[str, str], bool] = {}
        self.asked: Counter[str] = Counter()
        """Questions of HasLOS, by the template that looks."""
        self.sector_thrust: dict[int, Array] = {}
        self.now = 0
        self.said: list[Said] = []
        self.seen: list[Moment] = []
        self.things: dict[int, Thing] = {}
        self._place_things()
        if name in self.held["things"]:
            at = self.things[smithdev.thing(start)]
            self.player = self._add(body, at.place, at.sector, at.look)
        else:
            place, look = self._inside(start, aside)
            self.player = self._add(body, place, smithdev.sector(start), look)
        self.scripts = [Running(self, placed(smithdev, f"{self.chamber}/{own}")) for own in self.held["cogs"]]
        for script in self.scripts:
            script.receive(STARTUP, 0, -1)
        self._create_classes()

    # ---- what a test does

    def run(self, seconds: float, keys: str = "release") -> list[Moment]:
        """Let time pass while the player holds keys, as a script of `jktools trace` names them; gives its frames."""
        held = parse(f"0 {keys}\n1 end").phases[0].keys
        first = len(self.seen)
        for i in range(round(seconds * 1000 / self.frame)):
            self._frame(held, pressed=held.jump and i == 0)
        return self.seen[first:]

    def run_until(self, sector: str, keys: str) -> Moment:
        """Let time pass, at most 10 s, until the player comes into a sector."""
        for _ in range(round(10_000 / self.frame)):
            self.run(self.frame / 1000, keys)
            if self.player.sector == self.smithdev.sector(sector):
                return self.seen[-1]
        raise AssertionError(f"{sector} was not reached")

    def press(self, switch: str) -> None:
        """The player uses a switch of the chamber, by the name of its panel."""
        surfaces = self.held["surfaces"].items()
        ((surface,),) = (numbers for name, numbers in surfaces if name.partition(".")[2] == switch)
        self.send(ACTIVATED, "surface", surface, self.player)

    def send(self, message: int, kind: str, number: int, source: Thing | None) -> None:
        """Send what happens to an object to every script that is linked to it for this type of source."""
        bit = 1 << (source.type if source else 0)
        for script in self.scripts:
            if any(link.kind == kind and link.number == number and link.mask & bit for link in script.placed.links):
                script.receive(message, number, source.number if source else -1)

    def printed(self, script: str) -> list[tuple[float, list[str | float]]]:
        """What one script printed, all of one moment together."""
        found: list[tuple[float, list[str | float]]] = []
        for time, by, what in self.said:
            if by == script:
                if not found or found[-1][0] != time:
                    found.append((time, []))
                found[-1][1].append(what)
        return found

    def living(self, template: str) -> list[Thing]:
        """The things of a template that are in play, the oldest first."""
        return [thing for thing in self.things.values() if thing.template == template]

    # ---- what scripts do

    def create(self, template: str, at: Thing, how: Creation) -> Thing:
        """Make a thing at another, oriented as the engine does, on its way by its template's velocity."""
        record = self.smithdev.template(template)
        look = orientation.created(how, record.get("orient", (0.0, 0.0, 0.0)), spawner=at.look)
        thing = self._thing(template, at.place.copy(), look, at.sector)
        if thing.type in BODIES and self._moves(thing):
            self._embody(thing)
            assert thing.body is not None
            thing.body.velocity = orientation.created_velocity(record.get("vel", (0.0, 0.0, 0.0)), look)
        return thing

    def destroy(self, thing: Thing) -> None:
        """Take a thing out of play."""
        thing.died = self.now
        del self.things[thing.number]

    def say(self, script: str, what: str | float) -> None:
        """Print."""
        self.said.append(Said(self.now / 1000, script, what))

    def sees(self, looker: Thing, target: Thing) -> bool:
        """HasLOS, past walls and what the level has placed; whoever asks is counted."""
        self.asked[looker.template] += 1
        pair = self._end(looker), self._end(target)
        if pair not in self._sights:
            (verdict,) = jktools.sights(pack_level(), [pair], engine=self.engine)
            self._sights[pair] = str(verdict) == "visible"
        return self._sights[pair]

    def velocity(self, thing: Thing) -> Array:
        """JKU/s in the level."""
        return np.zeros(3) if thing.body is None else thing.body.velocity

    # ---- time

    def _frame(self, keys: Keys, pressed: bool) -> None:
        self.now += self.frame
        for thing in list(self.things.values()):
            if thing.body is not None:
                mine = thing is self.player
                self._move(thing, keys if mine else Keys(), pressed and mine)
            elif thing.heading is not None:
                self._travel(thing)
        for thing in self.things.values():
            if thing.carrier is not None:
                thing.place = thing.carrier.place + thing.carrier.look @ thing.hold
        for script in self.scripts:
            script.turn(self.now)
        body = self.player.body
        assert body is not None
        self.seen.append(
            Moment(
                self.now / 1000, body.position.copy(), body.velocity.copy(), self.player.thrust.copy(),
                self.player.sector, body.floor is not None,
            )
        )  # fmt: skip

    def _move(self, thing: Thing, keys: Keys, pressed: bool) -> None:
        body, before = thing.body, thing.sector
        assert body is not None
        x, y, z = self.sector_thrust.get(before, np.zeros(3)).tolist()
        body.world = replace(body.world, sector_thrust=(x, y, z))
        thrust, _ = body.tick(keys, self.frame / 1000, jumps=pressed)
        thing.thrust = np.full(3, ACTOR_READABLE_THRUST) if thing.type == ACTOR else thrust
        thing.place = body.position
        body.level_ground.move_to((float(thing.place[0]), float(thing.place[1]), float(thing.place[2])))
        thing.sector = body.level_ground.sector
        if body.goal is not None and np.linalg.norm((body.goal - thing.place)[:2]) < body.body.movesize:
            body.goal = None
            self.send(ARRIVED, "thing", thing.number, None)
        if thing.sector != before:
            self._crossed(thing, before)

    def _crossed(self, thing: Thing, before: int) -> None:
        for surface in self.collision.surfaces(before):
            if self.collision.behind(surface) == thing.sector:
                self.send(CROSSED, "surface", surface, thing)
        self.send(EXITED, "sector", before, thing)
        self.send(ENTERED, "sector", thing.sector, thing)

    def _travel(self, thing: Thing) -> None:
        assert thing.heading is not None
        frame, speed = thing.heading
        way = thing.path[frame] - thing.place
        left, step = float(np.linalg.norm(way)), speed * self.frame / 1000
        thing.place = thing.path[frame].copy() if left <= step else thing.place + way * (step / left)
        if left <= step:
            thing.heading, thing.frame = None, frame
            self.send(ARRIVED, "thing", thing.number, None)

    # ---- the level's start

    def _place_things(self) -> None:
        held, strings = self.smithdev.level.things, self.smithdev.level.strings
        assert held is not None
        for row, number in enumerate(held.source.tolist()):
            if number not in self.held["things"].values():
                continue
            look = orientation.matrix(np.asarray(held.angles[row], np.float64))
            place = np.asarray(held.position[row], np.float64)
            thing = self._thing(strings[held.template[row]], place, look, int(held.sector[row]), int(number))
            thing.path = self._path(row)
            if thing.type in BODIES and self._moves(thing):
                self._embody(thing)

    def _end(self, thing: Thing) -> str:
        """An end of a line of sight: what the level placed by its number, another by where it is."""
        if thing.number in self.held["things"].values():
            return str(thing.number)
        return ",".join(map(str, thing.place.tolist()))

    def _create_classes(self) -> None:
        """The scripts of templates: one for all things of its class, which it is told of one by one."""
        for thing in list(self.things.values()):
            file = self.smithdev.template(thing.template).get("cog")
            if file is not None:
                running = next((script for script in self.scripts if script.placed.name == file), None)
                if running is None:
                    running = Running(self, Placed(file, program(file), {}, ()))
                    self.scripts.append(running)
                running.receive(CREATED, thing.number, -1)

    def _path(self, row: int) -> list[Array]:
        held, strings = self.smithdev.level.things, self.smithdev.level.strings
        assert held is not None
        rows = range(*held.parameter_start[row : row + 2].tolist())
        frames = [strings[held.parameter_value[i]] for i in rows if strings[held.parameter_key[i]] == "frame"]
        return [np.array([float(x) for x in frame.strip("()").partition(":")[0].split("/")]) for frame in frames]

    def _thing(self, template: str, place: Array, look: Array, sector: int, number: int | None = None) -> Thing:
        kind = int(self.smithdev.template(template)["type"])
        number = max([10_000, *self.things]) + 1 if number is None else number
        self.things[number] = thing = Thing(number, template, kind, place, look, sector, born=self.now)
        return thing

    def _inside(self, sector: str, aside: float) -> tuple[Array, Array]:
        """The middle of a sector's floor, and the look of who comes in by the chamber's door."""
        points = self.collision.corners(self.smithdev.sector(sector))
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        own, door = set(self.held["sectors"].values()), self.collision.surfaces(self.held["sectors"]["door"])
        ways = [surface for surface in door if self.collision.behind(surface) in own]
        ahead = -np.asarray(self.smithdev.level.surface_normal[ways[0]], np.float64)
        right = np.array([ahead[1], -ahead[0], 0.0])
        place = np.array([*middle[:2], points[:, 2].min() + 0.120114]) + right * aside
        return place, np.column_stack([right, ahead, (0.0, 0.0, 1.0)])

    def _add(self, template: str, place: Array, sector: int, look: Array) -> Thing:
        thing = self._thing(template, place.copy(), look, sector)
        self._embody(thing)
        return thing

    def _moves(self, thing: Thing) -> bool:
        return bool(self.smithdev.template(thing.template)["move"] == PHYSICS)

    def _embody(self, thing: Thing) -> None:
        """Give a thing a body, standing on the floor if one is near below it; a flyer hangs."""
        x, y, z = thing.place.tolist()
        yaw = float(orientation.angles(thing.look)[1])
        body = body_named(self.smithdev.level, thing.template)
        thing.body = Body(self.stage, Start((x, y, z), thing.sector, yaw), body, self.engine)
        thing.body.level_ground.collision = self.collision
        if not body.physflags & PhysicsFlag.FLIES and body.physflags & PhysicsFlag.FLOOR_STICK:
            thing.body.rest_on_ground()
        thing.place = thing.body.position


@cache
def pack_level() -> jktools.Level:
    """What sight past things is asked of: a compiled file has no faces of models."""
    return jktools.load(f"{GOB}!jkl/smithdev.jkl")
