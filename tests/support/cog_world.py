"""A small game that runs all scripts of a level as the engine does, and what they do against what is said of them.

Its clock counts whole milliseconds, 20 a frame. It knows nothing of networks, clocks or bounds: only which messages the
engine sends to which script (sithCog.c, sithCogExec.c, sithCogFunction.c, sithEvent.c of the decompiled engine).
"""

from __future__ import annotations

import random
from collections import Counter
from typing import Any

from jktools.facts.hotspots.pace import Paces
from jktools.facts.hotspots.runners import Runner
from jktools.model.cog import values
from jktools.model.cog.values import Value
from jktools.model.cog.verbs import Verb
from jktools.syntax.cog import nodes as n
from tests.support.cog_machine import SLEEPING, WAITING, HungError, Machine

FRAME = 20
"""Milliseconds."""
MOST_DELAYED = 256
MOST_SEEN = 32
MOST_DEPTH = 60
MOST_STEPS = 60_000
"""Instructions before a level is left."""


def milliseconds(seconds: Value | None) -> int:
    """As the engine cuts seconds."""
    return int(values.to_flex(seconds) * 1000.0)


class Actor(Machine):
    """One running script, which lives in a world."""

    def __init__(self, world: World, runner: Runner, seed: int) -> None:
        super().__init__(runner.analysis.program, runner.analysis.bound or {}, seed)
        self.world, self.runner = world, runner
        self.sender = self.source = -1
        self.next_pulse: tuple[int, int] | None = None
        self.next_timer: int | None = None
        self.budget: Counter[str] = Counter()
        flags = runner.analysis.program.header.flags
        if flags & 0x4:
            self.next_pulse = (0, 0)
        if flags & 0x8:
            self.next_timer = 0

    def receive(self, message: int, sender: int, source: int = -1) -> None:
        for handler in self.program.handlers:
            if handler.message.id == message:
                self.world.enter()
                self.sender, self.source = sender, source
                self.start(handler.label)
                self.world.depth -= 1

    def turn(self, now: int) -> None:
        if self.next_pulse is not None and now >= self.next_pulse[0]:
            self.next_pulse = (now + self.next_pulse[1], self.next_pulse[1])
            self.receive(13, 0)
        if self.next_timer is not None and now >= self.next_timer:
            self.next_timer = None
            self.receive(4, 0)
        if (self.state == SLEEPING and self.wake < now) or (self.state == WAITING and self.wake <= now):
            self.state = 1
            self.execute()

    # ---- verbs

    def do_verb(self, name: str, node: n.Call) -> None:
        if name == "damagething":
            self.log.calls[node.start] += 1
            for _ in range(4):
                self.pop()
            self.interrupt(self.world.happen)
            self.push(0.0)
            return
        super().do_verb(name, node)

    def answer(self, verb: Verb) -> Value:
        if verb.name == "getsenderref":
            return self.sender
        if verb.name == "getsourceref":
            return self.source
        if verb.name == "getlocalplayerthing":
            return 0
        if verb.name == "getselfcog":
            return self.runner.number if self.runner.cog is not None else 1000 + self.world.actors.index(self)
        if verb.name == "firstthinginview":
            self.world.view = list(range(self.random.randint(0, MOST_SEEN)))
            return self.world.next_seen()
        if verb.name == "nextthinginview":
            return self.world.next_seen()
        if verb.name == "getthingclasscog":
            return self.world.class_number(self.given)
        return super().answer(verb)

    given = -1

    def verb_getthingclasscog(self, thing: Value | None) -> None:
        self.given = values.to_int(thing)

    def verb_sleep(self, seconds: Value | None) -> None:
        time = values.to_flex(seconds)
        self.wake = self.world.now + milliseconds(time if time > 0 else 0.1)
        self.state = SLEEPING

    def verb_setpulse(self, seconds: Value | None) -> None:
        every = milliseconds(seconds)
        self.next_pulse = (self.world.now + every, every) if values.to_flex(seconds) > 0 else None

    def verb_settimer(self, seconds: Value | None) -> None:
        self.next_timer = self.world.now + milliseconds(seconds) if values.to_flex(seconds) > 0 else None

    def verb_settimerex(self, seconds: Value | None, number: Any, a: Any, b: Any) -> None:
        after = milliseconds(seconds)
        if after >= 0 and len(self.world.delayed) < MOST_DELAYED:
            self.world.delayed.append((self.world.now + after, self))

    def verb_setthingpulse(self, thing: Value | None, seconds: Value | None) -> None:
        which = values.to_int(thing)
        if which in self.world.things:
            self.world.pulses.pop(which, None)
            if values.to_flex(seconds) != 0:
                self.world.pulses[which] = (self.world.now + milliseconds(seconds), milliseconds(seconds))

    def verb_setthingtimer(self, thing: Value | None, seconds: Value | None) -> None:
        which = values.to_int(thing)
        if which in self.world.things:
            self.world.timers.pop(which, None)
            if values.to_flex(seconds) != 0:
                self.world.timers[which] = self.world.now + milliseconds(seconds)

    def verb_capturething(self, thing: Value | None) -> None:
        if values.to_int(thing) in self.world.things:
            self.world.captured[values.to_int(thing)] = self

    def verb_sendmessage(self, cog: Value | None, number: Value | None) -> None:
        target, message = self.world.cog(values.to_int(cog)), values.to_int(number)
        if target is not None and 0 <= message <= 40:
            self.interrupt(lambda: target.receive(message, self.number, self.source))

    def verb_sendmessageex(self, cog: Value | None, number: Value | None, *rest: Any) -> None:
        self.verb_sendmessage(cog, number)

    def verb_sendtrigger(self, *rest: Any) -> None:
        def send() -> None:
            for each in self.world.actors:
                each.receive(40, 0)

        self.interrupt(send)

    @property
    def number(self) -> int:
        return self.world.number_of(self)


class World:
    """All scripts of a level, with the clocks of its things."""

    def __init__(self, runners: tuple[Runner, ...], seed: int) -> None:
        self.random = random.Random(seed)
        self.now = 0
        self.depth = 0
        self.view: list[int] = []
        self.actors = [Actor(self, runner, seed + i) for i, runner in enumerate(runners)]
        self.things = {0} | {t.number for r in runners for t in r.things} | {10, 11, 12, 13}
        self.pulses: dict[int, tuple[int, int]] = {}
        self.timers: dict[int, int] = {}
        self.captured: dict[int, Actor] = {}
        self.delayed: list[tuple[int, Actor]] = []
        self.class_of = {t.number: a for a in self.actors if a.runner.cog is None for t in a.runner.things}
        self.links = [
            (int(value), actor)
            for actor in self.actors if actor.runner.cog is not None
            for slot, value in zip(actor.program.valued, actor.runner.cog.values, strict=False)
            if slot.declared is not None and slot.type == "thing" and slot.declared.link >= 0 and slot.declared.mask & 1
        ]  # fmt: skip

    def number_of(self, actor: Actor) -> int:
        return actor.runner.number if actor.runner.cog is not None else 2 + self.actors.index(actor)

    def cog(self, number: int) -> Actor | None:
        return next((a for a in self.actors if self.number_of(a) == number), None)

    def class_number(self, thing: int) -> int:
        return self.number_of(self.class_of[thing]) if thing in self.class_of else -1

    def next_seen(self) -> int:
        return self.view.pop() if self.view else -1

    def enter(self) -> None:
        self.depth += 1
        if self.depth > MOST_DEPTH:
            raise HungError

    def from_thing(self, thing: int, message: int) -> None:
        if thing in self.class_of:
            self.class_of[thing].receive(message, thing)
        if thing in self.captured:
            self.captured[thing].receive(message, thing)
        for number, actor in self.links:
            if number == thing:
                actor.receive(message, thing)

    def happen(self) -> None:
        """One thing that the player or the world does, as long as any is left."""
        left = [(actor, label) for actor in self.actors for label, count in sorted(actor.budget.items()) if count]
        if left and self.random.random() < 0.3:
            actor, label = self.random.choice(left)
            actor.budget[label] -= 1
            sender = self.random.choice([t.number for t in actor.runner.things] or [13])
            actor.receive(actor.program.handler_of[label].message.id, sender, self.random.choice([0, 10, 12, 13]))

    def run(self, seconds: float) -> float:
        """Start the level and let time pass; the seconds until too much happened, 0 where it hangs."""
        for actor in self.actors:
            for handler in actor.program.handlers:
                if handler.message.name in ("activated", "touched", "user0", "user1", "trigger", "created"):
                    carriers = len(actor.runner.things) if actor.runner.cog is None else 1
                    actor.budget[handler.label] = max(carriers, 1)
        try:
            for actor in self.actors:
                actor.receive(3, -1)
            for thing, actor in sorted(self.class_of.items()):
                if actor.budget["created"]:
                    actor.budget["created"] -= 1
                    actor.receive(15, thing)
            for self.now in range(0, round(seconds * 1000), FRAME):
                self.frame()
                if sum(actor.steps for actor in self.actors) > MOST_STEPS:
                    break
        except HungError:
            return 0.0
        return (self.now + FRAME) / 1000

    def frame(self) -> None:
        if self.random.random() < 0.05:
            self.happen()
        due = [each for each in self.delayed if each[0] < self.now]
        self.delayed = [each for each in self.delayed if each[0] >= self.now]
        for _, actor in due:
            actor.receive(4, actor.number)
        for thing in sorted(self.things):
            if thing in self.pulses and self.pulses[thing][0] <= self.now:
                every = self.pulses[thing][1]
                self.pulses[thing] = (self.now + every, every)
                self.from_thing(thing, 13)
            if thing in self.timers and self.timers[thing] <= self.now:
                del self.timers[thing]
                self.from_thing(thing, 4)
        for actor in self.actors:
            actor.turn(self.now)


def told(runners: tuple[Runner, ...], seed: int, most: float) -> tuple[list[str], Counter[str]]:
    """Each way in which a simulated level is not what `Paces` allows, and how much of it was checked."""
    paces = Paces(runners, 1000.0 / FRAME)
    world = World(runners, seed)
    seen: Counter[str] = Counter()
    seconds = world.run(most)
    if not seconds:
        return [], Counter(hung=1)
    faults = []
    for actor in world.actors:
        runner = actor.runner
        for label, runs in actor.log.runs.items():
            node = next((v for v in paces.network.live if v.runner is runner and v.label == label), None)
            if node is None:
                faults.append(f"{runner.title}: {label} ran {runs} times, but is held for dead")
            elif not paces.network.inputs[node].open:
                bound = paces.bounds[node]
                limit = bound.once + bound.rate * seconds
                seen["runs that are bounded"] += limit < float("inf")
                seen["runs that are met"] += runs > 0.5 * limit
                if runs > limit:
                    faults.append(f"{runner.title}: {label} ran {runs} times, at most {bound} are allowed")
        for site in runner.analysis.rates.sites:
            labels = paces.labels(runner, site)
            count = actor.log.calls[site.call.start]
            if any(paces.is_open(runner, label, site) for label in labels):
                seen["calls that are open"] += site.verb.sight == "ray"
                continue
            bounds = [paces.calls(runner, label, site) for label in labels]
            limit = sum(bound.once + bound.rate * seconds for bound in bounds)
            if site.verb.sight == "ray" and count:
                seen["looks"] += 1
                seen["looks without a bound"] += limit == float("inf")
                seen["looks that last"] += 0 < sum(bound.rate for bound in bounds) < float("inf")
                seen["looks that are met"] += count > 0.5 * limit
            if count > limit:
                faults.append(
                    f"{runner.title}: {site.verb.name} was called {count} times, at most {bounds} are allowed"
                )
    return faults, seen
