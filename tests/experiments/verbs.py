"""A placed script that runs in a `Play`: what its verbs do there. A verb that is not here fails the test that calls it.

Times are whole milliseconds, as the engine cuts them. What a verb asks or changes is the play's; how it computes is
`jktools.engine`'s.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from jktools.engine.orientation import Creation
from jktools.model.cog import values
from jktools.model.cog.values import String, Value, Vector
from jktools.syntax.cog import nodes as n
from tests.experiments.scripts import Placed
from tests.support.cog_machine import RUNNING, SLEEPING, Machine

if TYPE_CHECKING:
    from tests.experiments.play import Play, Thing

PULSE, TIMER = 13, 4
NOWHERE = -9999.0
"""What GetParam gives that no message carries."""
PATH_SPEED = 0.1
"""JKU/s of a path's thing for a speed of 1."""


def vector(array: Any) -> Vector:
    x, y, z = (values.flex(float(part)) for part in array)
    return Vector(x, y, z)


def milliseconds(seconds: float) -> int:
    return int(seconds * 1000.0)


class Running(Machine):
    """One placed script in play."""

    def __init__(self, play: Play, placed: Placed) -> None:
        super().__init__(placed.program, placed.bound, seed=0)
        self.play, self.placed = play, placed
        self.sender = self.source = -1
        self.params: tuple[float, ...] = ()
        self.next_pulse: tuple[int, int] | None = None
        self.thing_pulses_due: dict[int, tuple[int, int]] = {}
        self.delayed: list[tuple[int, int, tuple[float, ...]]] = []

    def receive(self, message: int, sender: int, source: int, params: tuple[float, ...] = ()) -> None:
        """Run the handler of a message, if the script has one."""
        for handler in self.program.handlers:
            if handler.message.id == message:
                self.sender, self.source, self.params = sender, source, params
                self.start(handler.label)

    def turn(self, now: int) -> None:
        """What has waited for this moment: pulse, timers, then a sleep that ends."""
        if self.next_pulse is not None and now >= self.next_pulse[0]:
            self.next_pulse = (now + self.next_pulse[1], self.next_pulse[1])
            self.receive(PULSE, 0, -1)
        for number, (due_at, every) in list(self.thing_pulses_due.items()):
            if now >= due_at:
                self.thing_pulses_due[number] = (now + every, every)
                self.receive(PULSE, number, -1)
        due = [each for each in self.delayed if each[0] <= now]
        self.delayed = [each for each in self.delayed if each[0] > now]
        for _, number, params in due:
            self.receive(TIMER, number, -1, params)
        if self.state == SLEEPING and self.wake <= now:
            self.state = RUNNING
            self.execute()

    def do_verb(self, name: str, node: n.Call) -> None:
        verb = self.program.vocabulary.verbs[name]
        given = list(reversed([self.pop() for _ in verb.args]))
        # Its filters are ints to the engine, and yet the document saw -0.5 turn one on.
        kinds = ["flex" if name == "newcoloreffect" else str(arg.kind) for arg in verb.args]
        taken = [self._argument(kind, value) for kind, value in zip(kinds, given, strict=True)]
        answer = getattr(self, f"verb_{name}")(*taken)
        if verb.returns != "void":
            self.push(answer)

    def _argument(self, kind: str, value: Value | None) -> Any:
        if kind == "thing":
            return self.play.things.get(values.to_int(value))
        if kind == "template":
            templates = self.play.smithdev.level.templates
            assert templates is not None
            return self.play.smithdev.level.strings[templates.name[values.to_int(value)]]
        if kind == "vector":
            return np.array(values.to_vector(value))
        if kind == "flex":
            return values.to_flex(value)
        if kind == "string":
            assert isinstance(value, String)
            return value.text
        return values.to_int(value)

    # ---- the script itself

    def verb_sleep(self, seconds: float) -> None:  # type: ignore[override]
        self.wake = self.play.now + milliseconds(seconds if seconds > 0 else 0.1)
        self.state = SLEEPING

    def verb_setpulse(self, seconds: float) -> None:  # type: ignore[override]
        every = milliseconds(seconds)
        self.next_pulse = (self.play.now + every, every) if seconds > 0 else None

    def verb_setthingpulse(self, thing: Thing, seconds: float) -> None:  # type: ignore[override]
        every = milliseconds(seconds)
        self.thing_pulses_due[thing.number] = (self.play.now + every, every)

    def verb_settimerex(self, seconds: float, number: int, a: float, b: float) -> None:  # type: ignore[override]
        self.delayed.append((self.play.now + milliseconds(seconds), number, (a, b)))

    def verb_getparam(self, index: int) -> float:
        return self.params[index] if 0 <= index < len(self.params) else NOWHERE

    def verb_getsenderref(self) -> int:
        return self.sender

    def verb_getsourceref(self) -> int:
        return self.source

    def verb_getleveltime(self) -> float:
        return self.play.now / 1000

    def verb_print(self, text: str) -> None:
        self._say(text)

    def verb_printint(self, number: int) -> None:
        self._say(number)

    def verb_printflex(self, number: float) -> None:
        self._say(number)

    def _say(self, what: str | float) -> None:
        self.play.say(self.placed.name, what)

    # ---- vectors

    def verb_vectorset(self, x: float, y: float, z: float) -> Vector:
        return Vector(x, y, z)

    def verb_vectorlen(self, v: Any) -> float:
        return values.flex(float(np.linalg.norm(v)))

    def verb_vectorx(self, v: Any) -> float:
        return float(v[0])

    def verb_vectory(self, v: Any) -> float:
        return float(v[1])

    def verb_vectorz(self, v: Any) -> float:
        return float(v[2])

    # ---- things

    def verb_creatething(self, template: str, at: Thing) -> int:
        return self.play.create(template, at, Creation.CREATE_THING).number

    def verb_createthingnr(self, template: str, at: Thing) -> int:
        return self.play.create(template, at, Creation.CREATE_THING_NR).number

    def verb_destroything(self, thing: Thing | None) -> None:
        if thing is not None:
            self.play.destroy(thing)

    def verb_getthingpos(self, thing: Thing) -> Vector:
        return vector(thing.place)

    def verb_getthingvel(self, thing: Thing) -> Vector:
        return vector(self.play.velocity(thing))

    def verb_getthingthrust(self, thing: Thing) -> Vector:
        return vector(thing.thrust)

    def verb_setthingvel(self, thing: Thing, velocity: Any) -> None:
        assert thing.body is not None
        thing.body.velocity = velocity

    def verb_applyforce(self, thing: Thing, force: Any) -> None:
        assert thing.body is not None
        thing.body.push((float(force[0]), float(force[1]), float(force[2])))

    def verb_detachthing(self, thing: Thing) -> None:
        if thing.body is not None:
            thing.body.floor = None
        thing.carrier = None

    def verb_attachthingtothing(self, thing: Thing, carrier: Thing) -> None:
        thing.carrier, thing.hold = carrier, carrier.look.T @ (thing.place - carrier.place)

    def verb_movetoframe(self, thing: Thing, frame: int, speed: float) -> None:
        thing.heading = (frame, speed * PATH_SPEED)

    def verb_getcurframe(self, thing: Thing) -> int:
        return thing.frame

    def verb_getthingflags(self, thing: Thing) -> int:
        return self._flags(thing, "thingflags")

    def verb_getphysicsflags(self, thing: Thing) -> int:
        return self._flags(thing, "physflags")

    def verb_gettypeflags(self, thing: Thing) -> int:
        return self._flags(thing, "typeflags")

    def verb_getattachflags(self, thing: Thing) -> int:
        return int(thing.body is not None and thing.body.floor is not None)

    def _flags(self, thing: Thing, name: str) -> int:
        return int(self.play.smithdev.template(thing.template).get(name, 0))

    def verb_getlocalplayerthing(self) -> int:
        return self.play.player.number

    def verb_haslos(self, looker: Thing, target: Thing) -> int:
        return int(self.play.sees(looker, target))

    def verb_setthinglight(self, thing: Thing, light: float, fade: float) -> None:
        self.play.lights[thing.number] = light

    # ---- actors

    def verb_aisetmovespeed(self, actor: Thing, speed: float) -> None:
        assert actor.body is not None
        actor.body.ai_speed = speed

    def verb_aisetmovepos(self, actor: Thing, place: Any) -> None:
        assert actor.body is not None
        actor.body.goal = place

    def verb_aisetlookpos(self, actor: Thing, place: Any) -> None:
        actor.looks_at = place

    # ---- the screen

    def verb_newcoloreffect(self, *arguments: float) -> int:
        self.play.effects.append(arguments)
        self.play.effect = len(self.play.effects) - 1
        return self.play.effect

    def verb_freecoloreffect(self, handle: int) -> None:
        assert self.play.effect == handle
        self.play.effect = None

    def verb_enableirmode(self, surfaces: float, things: float) -> None:
        self.play.infrared = surfaces

    def verb_disableirmode(self) -> None:
        self.play.infrared = None

    # ---- sectors and surfaces

    def verb_setsectorthrust(self, sector: int, direction: Any, speed: float) -> None:
        self.play.sector_thrust[sector] = direction * speed

    def verb_getsurfaceflags(self, surface: int) -> int:
        return int(self.play.collision.surface_flags[surface])

    def verb_setsurfaceflags(self, surface: int, flags: int) -> None:
        self.play.collision.change(surface, flags=(flags, 0))

    def verb_clearsurfaceflags(self, surface: int, flags: int) -> None:
        self.play.collision.change(surface, flags=(0, flags))

    def verb_getadjoinflags(self, surface: int) -> int:
        return int(self.play.collision.adjoin_flags[self.play.smithdev.level.surface_adjoin[surface]])

    def verb_setadjoinflags(self, surface: int, flags: int) -> None:
        self.play.collision.change(surface, adjoin=(flags, 0))

    def verb_clearadjoinflags(self, surface: int, flags: int) -> None:
        self.play.collision.change(surface, adjoin=(0, flags))

    def verb_setfacegeomode(self, surface: int, mode: int) -> None:
        self.play.geo_modes[surface] = mode
