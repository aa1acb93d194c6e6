"""A small machine that runs a script as the engine does, with verbs that answer at random.

It shares `jktools.model.cog.values` with the analysis (one truth of how values compute) and nothing else: it compiles
the tree itself, and knows nothing of blocks, ranges or rates.
"""

from __future__ import annotations

import math
import random
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from jktools.model.cog import values
from jktools.model.cog.program import Program
from jktools.model.cog.values import Value
from jktools.model.cog.verbs import Verb
from jktools.syntax.cog import nodes as n

STACK = 64
FRAMES = 4
MOST_STEPS = 4000
"""Instructions in one go before a run counts as hung."""

MOST_NESTED = 30
"""Handlers inside verbs inside handlers before a run counts as hung."""

OWN_NUMBER = 2
"""Of the placed script; what the level gives its cog symbols is another."""

NOT_FROM_OUTSIDE = ("pulse", "timer", "loading", "startup", "shutdown")
"""Messages that come of clocks, or once in the life of a level."""

NEVER_DUE = (math.inf, 0.0, "")
"""For a pulse or timer that another handler has turned off in the same frame."""

IDLE, RUNNING, SLEEPING, WAITING, INTERRUPTED = range(5)


class HungError(Exception):
    """The game would hang here."""


class Compiler:
    """From the tree to a list of (operation, argument, node)."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.code: list[list[Any]] = []
        self.labels: dict[str, int] = {}

    def compile(self) -> list[list[Any]]:
        for statement in self.program.code.body:
            self.statement(statement)
        self.emit("ret")
        return self.code

    def emit(self, op: str, arg: Any = None, node: Any = None) -> list[Any]:
        self.code.append([op, arg, node])
        return self.code[-1]

    def here(self) -> int:
        return len(self.code)

    def statement(self, s: n.Statement) -> None:
        if isinstance(s, n.ExprStatement):
            self.expression(s.expression)
        elif isinstance(s, n.Block):
            for each in s.body:
                self.statement(each)
        elif isinstance(s, n.If):
            self.expression(s.condition)
            over = self.emit("unless")
            self.statement(s.then)
            if s.otherwise is None:
                over[1] = self.here()
            else:
                end = self.emit("jump")
                over[1] = self.here()
                self.statement(s.otherwise)
                end[1] = self.here()
        elif isinstance(s, n.While | n.For):
            if isinstance(s, n.For) and s.first is not None:
                self.expression(s.first)
            top = self.here()
            if s.condition is not None:
                self.expression(s.condition)
            out = self.emit("unless")
            self.statement(s.body)
            if isinstance(s, n.For):
                self.expression(s.step)
            self.emit("jump", top)
            out[1] = self.here()
        elif isinstance(s, n.DoWhile):
            top = self.here()
            self.statement(s.body)
            self.expression(s.condition)
            self.emit("when", top)
        elif isinstance(s, n.Goto):
            self.emit("goto", s.label.name)
        elif isinstance(s, n.CallLabel):
            self.emit("gosub", s.label.name)
        elif isinstance(s, n.Return):
            self.emit("ret")
        elif isinstance(s, n.Labeled):
            self.labels[s.label.name] = self.here()
            self.emit("label", s.label.name)
            self.statement(s.statement)

    def expression(self, e: n.Expression) -> None:
        if isinstance(e, n.Number):
            self.emit("push", e.value)
        elif isinstance(e, n.Vector):
            self.emit("push", values.Vector(*e.value))
        elif isinstance(e, n.String):
            self.emit("push", values.String(e.value))
        elif isinstance(e, n.Name):
            self.emit("load", e.name)
        elif isinstance(e, n.Unary):
            self.expression(e.operand)
            self.emit("unary", e.op)
        elif isinstance(e, n.Binary):
            self.expression(e.left)
            self.expression(e.right)
            if e.op != ",":
                self.emit("binary", e.op)
        elif isinstance(e, n.Index):
            self.expression(e.index)
            self.emit("load_at", e.base.name if isinstance(e.base, n.Name) else "")
        elif isinstance(e, n.Assign):
            if isinstance(e.target, n.Index):
                self.expression(e.target.index)
                self.expression(e.value)
                self.emit("store_at", e.target.base.name if isinstance(e.target.base, n.Name) else "")
            elif isinstance(e.target, n.Name):
                self.expression(e.value)
                self.emit("store", e.target.name)
            else:
                self.expression(e.target)
                self.expression(e.value)
                self.emit("drop", 2)
        elif isinstance(e, n.Call):
            if not isinstance(e.callee, n.Name):
                self.expression(e.callee)
            for each in e.arguments:
                self.expression(each)
            if isinstance(e.callee, n.Name):
                self.emit("verb", e.callee.name, e)


@dataclass
class Log:
    """What happened."""

    runs: Counter[str] = field(default_factory=Counter)
    """Of each handler, by its label."""
    events: Counter[str] = field(default_factory=Counter)
    """Messages from outside, by the label that they ran."""
    calls: Counter[int] = field(default_factory=Counter)
    """Of each call, by where it stands."""
    arguments: dict[int, list[tuple[Value | None, ...]]] = field(default_factory=dict)
    causes: set[tuple[str, str]] = field(default_factory=set)
    """(handler whose code caused a message, handler that it ran)."""
    passages: set[tuple[str, str]] = field(default_factory=set)
    """(label whose code was running, label that it came to)."""
    things: set[int] = field(default_factory=set)
    """Things that were given a pulse or timer."""
    hung: bool = False


class Machine:
    """One placed script."""

    def __init__(self, program: Program, bound: Mapping[int, Value], seed: int, fps: int = 50) -> None:
        self.program = program
        self.random = random.Random(seed)
        compiler = Compiler(program)
        self.code = compiler.compile()
        self.labels = compiler.labels
        self.fps = fps
        self.log = Log()
        self.now = 0.0
        self.state = IDLE
        self.pc = 0
        self.stack: list[Value] = []
        self.frames: list[tuple[int, int, float, str]] = []
        self.wake = 0.0
        self.handler = ""
        self.at_label = ""
        self.pulse: tuple[float, float, str] | None = None
        self.timer: tuple[float, str] | None = None
        self.queue: list[tuple[float, str]] = []
        self.thing_pulses: dict[int, tuple[float, float, str]] = {}
        self.thing_timers: dict[int, tuple[float, float, str]] = {}
        self.steps = 0
        self.values: list[Value] = []
        for slot in program.slots:
            if slot.index in bound:
                self.values.append(bound[slot.index])
            elif slot.text is not None:
                self.values.append(values.String(slot.text))
            elif slot.type == "message" and slot.declared is not None:
                message = program.vocabulary.messages.get(slot.declared.default or slot.name)
                self.values.append(0 if message is None else message.id)
            elif slot.type == "vector":
                self.values.append(values.ZERO_VECTOR)
            elif slot.type in ("flex", "float"):
                self.values.append(values.flex(float((slot.declared and slot.declared.default) or 0)))
            elif slot.declared is None:
                self.values.append(0.0)
            else:
                text = slot.declared.default or "0"
                self.values.append(int(text) if text.lstrip("+-").isdigit() else (0 if slot.type == "int" else 7))

    # ---- the world

    def run(self, seconds: float, events_per_second: float = 2.0) -> Log:
        """Start the level and let time pass."""
        try:
            for name in ("loading", "startup"):
                for handler in self.program.handlers:
                    if handler.message.name == name:
                        self.event(handler.label)
            outside = [h.label for h in self.program.handlers if h.message.name not in NOT_FROM_OUTSIDE]
            for frame in range(int(seconds * self.fps)):
                self.now = frame / self.fps
                self.tick()
                if self.random.random() < events_per_second / self.fps and outside:
                    self.event(self.random.choice(outside))
        except HungError:
            self.log.hung = True
        return self.log

    def tick(self) -> None:
        if self.pulse is not None and self.pulse[0] <= self.now:
            self.pulse = (self.now + self.pulse[1], *self.pulse[1:])
            self.message(13, self.pulse[2])
        if self.timer is not None and self.timer[0] <= self.now:
            cause, self.timer = self.timer[1], None
            self.message(4, cause)
        for thing in list(self.thing_pulses):
            due, every, cause = self.thing_pulses.get(thing, NEVER_DUE)
            if due <= self.now:
                self.thing_pulses[thing] = (self.now + every, every, cause)
                self.message(13, cause)
        for thing in list(self.thing_timers):
            due, _, cause = self.thing_timers.get(thing, NEVER_DUE)
            if due <= self.now:
                del self.thing_timers[thing]
                self.message(4, cause)
        due_now = [each for each in self.queue if each[0] <= self.now]
        self.queue = [each for each in self.queue if each[0] > self.now]
        for _, cause in due_now:
            self.message(4, cause)
        if self.state in (SLEEPING, WAITING) and self.wake <= self.now:
            self.state = RUNNING
            self.execute()

    def event(self, label: str) -> None:
        self.log.events[label] += 1
        self.start(label)

    def message(self, number: int, cause: str) -> None:
        for handler in self.program.handlers:
            if handler.message.id == number:
                self.log.causes.add((cause, handler.label))
                self.start(handler.label)

    def start(self, label: str) -> None:
        self.log.runs[label] += 1
        if self.state == IDLE:
            self.stack.clear()
        else:
            state = INTERRUPTED if self.state == RUNNING else self.state
            if len(self.frames) < FRAMES:
                self.frames.append((self.pc, state, self.wake, self.handler))
        self.state, self.pc, self.handler = RUNNING, self.labels[label], label
        self.at_label = label
        self.execute()
        if self.state == INTERRUPTED:
            self.state = RUNNING

    # ---- the machine

    def execute(self) -> None:
        depth = self.steps
        while self.state == RUNNING:
            self.steps += 1
            if self.steps - depth > MOST_STEPS or self.steps > 100 * MOST_STEPS:
                raise HungError
            op, arg, node = self.code[self.pc]
            self.pc += 1
            getattr(self, f"do_{op}")(arg, node)

    nested = 0
    displaced = False
    """Whether a handler found no place to keep what it interrupted, and older code went on in its stead: with what lies
    on the stack by then, of which nothing is said."""

    def pop(self) -> Value | None:
        return self.stack.pop() if self.stack else None

    def push(self, value: Value) -> None:
        self.stack.append(value)
        if len(self.stack) > STACK:
            del self.stack[0]

    def do_push(self, arg: Any, node: Any) -> None:
        self.push(arg)

    def do_label(self, arg: str, node: Any) -> None:
        if self.at_label and self.at_label != arg:
            self.log.passages.add((self.at_label, arg))
        self.at_label = arg

    def do_load(self, arg: str, node: Any) -> None:
        slot = self.program.slot_of.get(arg)
        if slot is not None:
            self.push(self.values[slot.index])
        elif arg in self.program.vocabulary.messages and arg not in self.program.vocabulary.verbs:
            self.push(self.program.vocabulary.messages[arg].id)
        else:
            self.push(self.random.choice([1, 77, 0.5]))

    def do_load_at(self, arg: str, node: Any) -> None:
        index = values.to_int(self.pop())
        slot = self.program.slot_of.get(arg)
        at = slot.index + index if slot is not None else -1
        self.push(self.values[at] if 0 <= at < len(self.values) else 0)

    def do_store(self, arg: str, node: Any) -> None:
        slot = self.program.slot_of.get(arg)
        value = self.pop()
        if slot is not None:
            self.values[slot.index] = -1 if value is None else value

    def do_store_at(self, arg: str, node: Any) -> None:
        value = self.pop()
        index = values.to_int(self.pop())
        slot = self.program.slot_of.get(arg)
        at = slot.index + index if slot is not None else -1
        if 0 <= at < len(self.values):
            self.values[at] = -1 if value is None else value

    def do_drop(self, arg: int, node: Any) -> None:
        for _ in range(arg):
            self.pop()

    def do_unary(self, arg: str, node: Any) -> None:
        self.push(values.unary(arg, self.pop()))

    def do_binary(self, arg: str, node: Any) -> None:
        right = self.pop()
        left = self.pop()
        self.push(values.binary(arg, left, right))

    def do_jump(self, arg: int, node: Any) -> None:
        self.pc = arg

    def do_unless(self, arg: int, node: Any) -> None:
        if not values.is_true(self.pop()):
            self.pc = arg

    def do_when(self, arg: int, node: Any) -> None:
        if values.is_true(self.pop()):
            self.pc = arg

    def do_goto(self, arg: str, node: Any) -> None:
        if arg in self.labels:
            self.pc = self.labels[arg]
        else:
            self.do_ret(None, None)

    def do_gosub(self, arg: str, node: Any) -> None:
        if arg in self.labels and len(self.frames) < FRAMES:
            self.frames.append((self.pc, RUNNING, self.wake, self.handler))
            self.pc = self.labels[arg]

    def do_ret(self, arg: Any, node: Any) -> None:
        if self.frames:
            self.pc, self.state, self.wake, self.handler = self.frames.pop()
            self.at_label = ""
        else:
            self.state = IDLE

    # ---- verbs

    def do_verb(self, name: str, node: n.Call) -> None:
        if name in self.program.slot_of:
            return
        verb = self.program.vocabulary.verbs.get(name)
        if verb is None:
            return
        given = tuple(reversed([self.pop() for _ in verb.args]))
        self.log.calls[node.start] += 1
        if not self.displaced:
            self.log.arguments.setdefault(node.start, []).append(given)
        special = getattr(self, f"verb_{name}", None)
        if special is not None:
            special(*given)
        elif verb.delivers and self.random.random() < 0.05:
            handler = self.random.choice(self.program.handlers)
            if handler.message.name not in NOT_FROM_OUTSIDE:
                self.interrupt(lambda: self.event(handler.label))
        if verb.returns != "void" and not (verb.pushes == "maybe" and self.random.random() < 0.3):
            self.push(self.answer(verb))
            if verb.pushes == "twice" and self.random.random() < 0.3:
                self.push(self.answer(verb))

    def interrupt(self, action: Any) -> None:
        """Run handlers in the middle of a verb, and come back."""
        if self.nested > MOST_NESTED:
            raise HungError
        before = (self.pc, len(self.frames))
        self.nested += 1
        action()
        self.nested -= 1
        if self.state == RUNNING and (self.pc, len(self.frames)) != before:
            self.displaced = True

    def answer(self, verb: Verb) -> Value:
        pick = self.random
        if verb.name == "haslos":
            return pick.choice([-1, 0, 1])
        if verb.name == "getselfcog":
            return OWN_NUMBER
        if verb.name in ("getlocalplayerthing", "jkgetlocalplayer"):
            return pick.randint(0, 9)
        if verb.name in ("isserver", "ismulti", "bittest"):
            return pick.randint(0, 1)
        if verb.name in ("ismoving", "isthingmoving"):
            return pick.randint(-1, 1)
        if verb.name == "getdifficulty":
            return pick.randint(0, 2)
        if verb.name == "getthingtype":
            return pick.randint(-1, 12)
        if verb.name == "rand":
            return values.flex(pick.random())
        if verb.name in ("getgametime",):
            return int(self.now * 1000)
        if verb.name in ("getflexgametime", "getleveltime", "vectorlen", "vectordist"):
            return values.flex(pick.random() * 100)
        if verb.name == "setmaterialcel":
            return -1
        if verb.returns == "vector":
            return values.Vector(pick.uniform(-1, 1), 0.0, 1.0)
        if verb.returns == "flex":
            return values.flex(pick.choice([0.0, 1.0, -1.0, 0.5, 100.25, pick.uniform(-9999, 9999)]))
        if verb.returns == "int":
            return pick.choice([-1, 0, 1, 2, 3, 16, 1000, -(2**31), 2**31 - 1, pick.randint(0, 40)])
        return pick.choice([-1, -1, 0, 1, pick.randint(0, 500)])

    def verb_sleep(self, seconds: Value | None) -> None:
        time = values.to_flex(seconds)
        self.wake = self.now + (time if time > 0 else 0.1)
        self.state = SLEEPING

    def verb_waitforstop(self, thing: Value | None) -> None:
        if self.random.random() < 0.5:
            self.wake = self.now + self.random.uniform(0, 2)
            self.state = WAITING

    def verb_setpulse(self, seconds: Value | None) -> None:
        every = values.to_flex(seconds)
        self.pulse = (self.now + every, every, self.handler) if every > 0 else None

    def verb_settimer(self, seconds: Value | None) -> None:
        after = values.to_flex(seconds)
        self.timer = (self.now + after, self.handler) if after > 0 else None

    def verb_settimerex(self, seconds: Value | None, number: Any, a: Any, b: Any) -> None:
        after = values.to_flex(seconds)
        if after >= 0:
            self.queue.append((self.now + after, self.handler))

    def verb_setthingpulse(self, thing: Value | None, seconds: Value | None) -> None:
        which, every = values.to_int(thing), values.to_flex(seconds)
        self.thing_pulses.pop(which, None)
        if which >= 0 and every != 0:
            self.log.things.add(which)
            self.thing_pulses[which] = (self.now + every, every, self.handler)

    def verb_setthingtimer(self, thing: Value | None, seconds: Value | None) -> None:
        which, after = values.to_int(thing), values.to_flex(seconds)
        self.thing_timers.pop(which, None)
        if which >= 0 and after != 0:
            self.log.things.add(which)
            self.thing_timers[which] = (self.now + after, after, self.handler)

    def verb_sendmessage(self, cog: Any, number: Value | None) -> None:
        cause = self.handler
        if values.to_int(cog) == OWN_NUMBER:
            self.interrupt(lambda: self.message(values.to_int(number), cause))

    def verb_sendmessageex(self, cog: Any, number: Value | None, *rest: Any) -> None:
        self.verb_sendmessage(cog, number)

    def verb_sendtrigger(self, *rest: Any) -> None:
        cause = self.handler
        self.interrupt(lambda: self.message(40, cause))
