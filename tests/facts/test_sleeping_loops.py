"""Loops that sleep, with runs of one script that wait on top of each other: each figure is worked out by hand.

Where a script is made to do its worst, the interpreter shows that it does: 50 frames a second, messages at set times.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping

import pytest

from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.repeats import Repeats
from jktools.model.cog.program import Program, Vocabulary
from jktools.model.cog.values import Value
from tests.support.cog_bounds import violations
from tests.support.cog_machine import Machine
from tests.support.scripts import script_of

FRAMES_PER_SECOND = 50
TURN = "GetThingType(0); i = i + step;"
LOOP = f"do {{ {TURN} call nap; }} while (i < 100);"
"""100 turns; but the level gives the step, so that the analysis can only count on the sleep."""


def program_of(*lines: str) -> Program:
    messages = ("loading", "startup", "activated", "touched", "user0", "pulse")
    head = ["symbols", *(f"message {name}" for name in messages), "int step=1", "int i local", "end", "code"]
    script = script_of("\n".join([*head, *lines, "end", ""]))
    assert not script.rejected, [fault.message for fault in script.faults]
    return Program(script.header, script.code, Vocabulary("jk"))


def said(program: Program, label: str, verb: str = "getthingtype") -> Repeats:
    """How often a handler comes to a call, whatever the level's values."""
    rates = Analysis(program).rates
    (site,) = (site for site in rates.sites if site.verb.name == verb)
    return rates.repeats_of(label, site)


class Play:
    """A script that runs, with messages when the test says so."""

    def __init__(self, program: Program) -> None:
        bound: Mapping[int, Value] = {program.slot_of["step"].index: 1}
        self.program = program
        self.machine = Machine(program, bound, 0)
        self.frame = 0

    def send(self, label: str, times: int = 1) -> None:
        for _ in range(times):
            self.machine.event(label)

    def until(self, seconds: float) -> None:
        """Let the frames before this time pass."""
        while self.frame < seconds * FRAMES_PER_SECOND:
            self.machine.now = self.frame / FRAMES_PER_SECOND
            self.machine.tick()
            self.frame += 1

    @property
    def turns(self) -> int:
        (call,) = (call for call, verb in self.program.calls if verb.name == "getthingtype")
        return self.machine.log.calls[call.start]


# ---- what a label sleeps that the loop calls


def test_with_two_runs_asleep_in_a_label_the_third_turns_without_a_sleep() -> None:
    program = program_of(f"activated: {LOOP} return;", "nap: Sleep(1); return;")
    play = Play(program)
    play.send("activated", 2)
    assert play.turns == 2
    # Each of the two has taken a place for its `call`, and each but the last one more for where it sleeps: 2 + 1, and
    # the third message takes the fourth. Its `call` is passed over 98 times, until i is 100.
    play.send("activated")
    assert (play.turns, play.machine.now) == (100, 0.0)
    assert said(program, "activated").per_run == math.inf


def test_startup_finds_all_places_free() -> None:
    program = program_of(f"startup: {LOOP} return;", "nap: Sleep(1); return;")
    assert said(program, "startup") == Repeats(1, 1, 1, 1)
    play = Play(program)
    play.send("startup")
    play.until(60)
    # At 0 s and then each second, or a frame later where the clock is cut: the bound is 1 + 60.
    assert 59 <= play.turns <= 60


def test_what_sleeps_on_top_of_startup_delays_its_loop_and_no_more() -> None:
    program = program_of(f"startup: {LOOP} return;", "nap: Sleep(1); return;", "activated: Sleep(10); return;")
    assert said(program, "startup") == Repeats(1, 1, 1, 1)
    play = Play(program)
    play.send("startup")
    play.send("activated", 5)  # three more than there are places for
    play.until(10)
    assert play.turns == 1
    play.until(12)
    assert 2 <= play.turns <= 3


@pytest.mark.parametrize(("lines", "why"), [
    (["loading: Sleep(9); return;"], "it may sleep still"),
    (["loading: SendMessage(GetSelfCog(), user0); return;", "user0: Sleep(9); return;"], "so may what it sends"),
    (["user0: SendMessage(GetSelfCog(), startup); return;"], "it may come twice"),
])  # fmt: skip
def test_startup_that_may_find_places_taken(lines: list[str], why: str) -> None:
    assert said(program_of(f"startup: {LOOP} return;", *lines, "nap: Sleep(1); return;"), "startup").per_run == math.inf


def test_loading_that_leaves_nothing_behind_takes_no_place() -> None:
    lines = (f"startup: {LOOP} return;", 'loading: Print("x"); return;', "nap: Sleep(1); return;")
    assert said(program_of(*lines), "startup") == Repeats(1, 1, 1, 1)


def test_a_label_that_has_the_last_place_does_not_sleep_undisturbed() -> None:
    chain = ["nap: call two; return;", "two: call three; return;", "three: Sleep(1); return;"]
    message = "activated: return;"
    three = program_of(f"startup: {LOOP} return;", *chain, message)
    assert said(three, "startup") == Repeats(1, 1, 1, 1)
    play = Play(three)
    play.send("startup")
    play.send("activated", 10)
    assert play.turns == 1
    # One label more has the fourth place: each message comes in its stead, and leads back to its caller at once.
    chain[2:] = ["three: call four; return;", "four: Sleep(1); return;"]
    four = program_of(f"startup: {LOOP} return;", *chain, message)
    assert said(four, "startup").per_run == math.inf
    play = Play(four)
    play.send("startup")
    play.send("activated", 10)
    assert (play.turns, play.machine.now) == (1 + 10, 0.0)


def test_of_a_loop_that_sleeps_itself_and_in_a_label_only_its_own_sleep_counts() -> None:
    loop = LOOP.replace("call nap;", "call nap; Sleep(0.5);")
    each = {
        label: program_of(f"{label}: {loop} return;", "nap: Sleep(2); return;") for label in ("activated", "startup")
    }
    assert said(each["startup"], "startup") == Repeats(1, 0.4, 1, 2.5)
    bound = said(each["activated"], "activated")
    assert bound == Repeats(1, 2, 1, 2.5)
    play = Play(each["activated"])
    play.send("activated", 3)
    play.until(10)
    # One turn each at 0 s; the third goes on at 0.5, 1 ... 9.5 s, since it has no place for its `call`.
    assert play.turns == 3 + 19
    assert play.turns <= bound.most(3, 10, 3) == 3 + 20 + 3


# ---- runs that sleep in one loop


def test_a_message_that_finds_the_loop_asleep_adds_one_turn_beside_its_own() -> None:
    """The bound is met: 2 runs, 1 second, and 1 message that came while the loop slept."""
    loop = f"do {{ {TURN} if (i == 3) return; Sleep(1); }} while (i < 100);"
    program = program_of(f"activated: {loop} return;")
    assert said(program, "activated") == Repeats(1, 1, 1, 1)
    play = Play(program)
    play.send("activated")
    play.until(0.02)
    play.send("activated")
    # The second turns at 0 and at 1 s, where it ends; a frame later the first goes on, whose second is over too.
    play.until(1.1)
    assert play.turns == 4 == said(program, "activated").most(2, 1, 1)


def test_runs_that_find_no_place_are_lost_and_hasten_nothing() -> None:
    loop = f"do {{ {TURN} Sleep(1); }} while (i < 100);"
    program = program_of(f"activated: {loop} return;", "touched: return;")
    play = Play(program)
    play.send("activated", 8)
    play.send("touched", 8)
    assert play.turns == 8
    play.until(10)
    # Four found a place to be kept, those behind them were lost, each to the next message: the fourth goes on.
    assert 8 + 8 <= play.turns <= 8 + 9
    assert said(program, "activated") == Repeats(1, 1, 1, 1)


# ---- at random


def napping(seed: int) -> Program:
    """Loops that call labels, which call labels that sleep, under handlers that sleep or send each other messages."""
    pick = random.Random(seed)
    sleeps = ["Sleep(0.1);", "Sleep(0.5);", "Sleep(3);", "WaitForStop(0);"]

    def loop(label: str) -> str:
        own = pick.choice(["", "", "Sleep(0.25);", "if (Rand() < 0.5) Sleep(1);"])
        body = f"{TURN} call {label}; {own}"
        return pick.choice([f"while (Rand() < 0.95) {{ {body} }}", f"do {{ {body} }} while (i < 40);"])

    chain = ["nap", "two", "three", "four", "five"][: pick.randint(1, 5)]
    labels = [
        f"{label}: {pick.choice(['', 'Print(1);', *sleeps]) if below else pick.choice(sleeps)}"
        f"{f'call {below};' if below else ''} return;"
        for label, below in zip(chain, [*chain[1:], ""], strict=True)
    ]
    others = ["return;", "call nap; return;", *(f"{sleep} return;" for sleep in sleeps), "i = 0; return;"]
    handlers = [f"startup: {loop('nap')} {pick.choice(['', loop('nap')])} return;"]
    for label in ("activated", "touched", "user0", "pulse", "loading"):
        if pick.random() < (0.15 if label == "loading" else 0.5):
            sent = pick.choice(["", "", "SendMessage(GetSelfCog(), user0);", "SetPulse(0.4);"])
            handlers.append(f"{label}: {sent} {pick.choice([*others, f'{loop(chain[-1])} return;'])}")
    return program_of(*handlers, *labels)


@pytest.mark.parametrize("part", range(4))
def test_loops_of_labels_that_sleep_turn_no_more_often_than_is_said(part: int) -> None:
    found = {seed: violations(napping(seed), seed) for seed in range(part * 50, (part + 1) * 50)}
    assert {seed: each for seed, each in found.items() if each} == {}


def test_a_fair_part_of_them_has_bounds() -> None:
    """Or the test above proves nothing."""
    counts = []
    for seed in range(100):
        rates = Analysis(napping(seed)).rates
        first = next(site for site in rates.sites if site.verb.name == "getthingtype")
        counts.append(rates.repeats_of("startup", first).per_run < math.inf)
    assert 25 < sum(counts) < 90
