"""Hotspots of scripts that wake each other by messages, against figures worked out by hand."""

from __future__ import annotations

import math

import pytest

from jktools.facts.hotspots.network import Network
from tests.support.hotspots import (
    ASKED,
    LOOK,
    PLAYER,
    hotspots,
    looking,
    placed_cog,
    things,
    two_scripts,
)


def test_messages_are_followed_to_the_cog_that_a_value_names() -> None:
    tick = ["startup: SetPulse(0.1); return;", "pulse: SendMessage(other, user0); return;"]
    (found,) = two_scripts(tick, ASKED)
    assert (found.calls_per_second, found.more) == (pytest.approx(10), False)
    # To itself, which does not answer; to nobody; another message.
    assert [h.calls_per_second for h in two_scripts(tick, ASKED, "0")] == [0]
    assert [h.calls_per_second for h in two_scripts(tick, ASKED, "-1")] == [0]
    wrong = [line.replace("user0", "user1") for line in tick]
    assert [(h.calls_per_second, h.more) for h in two_scripts(wrong, ASKED)] == [(0, False)]


@pytest.mark.parametrize(("others", "more"), [
    ([], False), (["activated: return;"], False), (["activated: i = 0; return;"], True),
    (["activated: k[Rand()] = 0; return;"], True), (["timer: i = 0; return;"], False),
])  # fmt: skip
def test_a_counter_that_a_handler_in_between_can_set_back_is_told(others: list[str], more: bool) -> None:
    tick = ["startup: SetPulse(1); SetTimer(1); return;",
            "pulse: for (i = 0; i < 3; i = i + 1) SendMessage(other, user0); return;"]  # fmt: skip
    (found,) = two_scripts([*tick, *others], ASKED)
    assert (found.calls_per_second, found.more) == (3, more)


def test_messages_of_one_script_wake_loops_of_another() -> None:
    tick = ["startup: SetPulse(0.5); return;", "pulse: SendMessage(other, user1); return;"]
    loop = ["startup: call watch; return;", "user1: call watch; return;"]
    watch = ["watch: while (1) {", LOOK, "Sleep(0.25);", "} return;"]
    # 4 turns a second in either run, one more for each run, and one for each message that finds the other asleep.
    assert [h.calls_per_second for h in two_scripts(tick, [*loop, *watch])] == pytest.approx([4 + (4 + 2) + 2 * 2])
    # A handler from which the loop cannot be reached leaves its sleep as it is.
    beside = ["startup: call watch; return;", "user1: Sleep(1); return;", *watch]
    assert [h.calls_per_second for h in two_scripts(tick, beside)] == pytest.approx([4])


@pytest.mark.parametrize(("asks", "answers", "calls"), [
    ("startup: return;", "user0: Sleep(1); return;", 5),
    # The first script sends it in its own startup, and the second may be asleep when startup comes to it.
    ("startup: SendMessage(other, user0); return;", "user0: Sleep(1); return;", math.inf),
    ("startup: SendMessage(other, user0); return;", "user0: return;", 5),
    ("startup: SendMessage(other, user0); return;", "user0: call nap; return;", math.inf),
    ("startup: DamageThing(20, 1, 1, 20); return;", "activated: Sleep(1); return;", math.inf),
    ("startup: SendMessage(other, startup); return;", "user0: return;", math.inf),
    ("startup: SendMessage(GetSenderRef(), user0); return;", "user0: Sleep(1); return;", math.inf),
    ("startup: SendMessage(GetSenderRef(), user0); return;", "user0: return;", 5),
    # Later: on top of the loop.
    ("activated: SendMessage(other, user0); return;", "user0: Sleep(1); return;", 5),
    ("startup: SetPulse(1); return; pulse: SendMessage(other, user0); return;", "user0: Sleep(1); return;", 5),
    ("startup: SetPulse(1); return; pulse: SendMessage(other, startup); return;", "user0: return;", math.inf),
])  # fmt: skip
def test_a_label_that_the_loop_of_startup_calls(asks: str, answers: str, calls: float) -> None:
    loop = ["startup: while (1) {", LOOK, "call nap; } return;", answers, "nap: Sleep(0.2); return;"]
    assert [h.calls_per_second for h in two_scripts([asks], loop)] == pytest.approx([calls])


@pytest.mark.parametrize("target", ["GetSenderRef()", "GetMasterCog()", "GetThingClassCog(20)"])
def test_messages_to_a_cog_that_is_not_known_are_told(target: str) -> None:
    tick = ["startup: SetPulse(0.1); return;", f"pulse: SendMessage({target}, user0); return;"]
    (found,) = two_scripts(tick, ASKED)
    assert found.more
    assert [h.more for h in two_scripts([line.replace("user0", "user1") for line in tick], ASKED)] == [False]


@pytest.mark.parametrize("verb", ["SetThingClassCog(20, other)", "SetThingCaptureCog(20, other)"])
def test_a_script_that_a_thing_is_given_to_gets_messages_that_are_not_known(verb: str) -> None:
    for given, told in ((verb, True), (verb.replace("other", "-1"), False)):
        (found,) = two_scripts([f"activated: {given}; return;"], [f"pulse: {LOOK} return;"])
        assert found.more is told


@pytest.mark.parametrize(("answer", "more"), [("", False), ("call watch;", True)])
def test_a_message_that_is_not_known_wakes_what_its_handler_comes_to(answer: str, more: bool) -> None:
    start = ["startup: SendMessage(GetMasterCog(), user1); return;"]
    loop = ["startup: call watch; return;", f"user1: {answer} return;", "watch: while (1) {"]
    sleep = ["Sleep(0.25);", "} return;"]
    assert [h.more for h in two_scripts(start, [*loop, LOOK, *sleep])] == [more]
    # And what the loop sends on.
    asked = ["user0: if (HasLOS(i, i) == 1) return; return;"]
    assert [h.more for h in two_scripts([*start, *asked], [*loop, "SendMessage(back, user0);", *sleep])] == [more]


def test_what_is_not_known_is_passed_on() -> None:
    """The first script is woken by a message to nobody knows whom, and what it asks of the second is open too."""
    open_ = ["startup: SetPulse(1); return;", "pulse: SendMessage(GetMasterCog(), user1); return;"]
    ask = ["user1: SendMessage(other, user0); return;"]
    (found,) = two_scripts([*open_, *ask], ASKED)
    assert found.more
    # A pulse that it sets comes once an interval all the same.
    paced = ["user1: SetPulse(0.5); return;", "pulse: SendMessage(other, user0); SendMessage(GetMasterCog(), user1);",
             "return;"]  # fmt: skip
    (bounded,) = two_scripts(paced, ASKED)
    assert (bounded.more, bounded.calls_per_second) == (False, 2)


def test_what_the_player_causes_is_named() -> None:
    ask = ["activated: SendMessage(other, user0); return;"]
    (found,) = two_scripts(ask, ASKED)
    assert (found.calls_per_second, found.causes) == (0, ("activated of cog 0 (first.cog)", "user0"))
    (alone,) = hotspots(*placed_cog("20 21", *looking(f"activated: {LOOK} return;")))
    assert alone.causes == ("activated",)
    # A pulse that it starts lasts: more of the same starts no more of it.
    (pulse,) = hotspots(*placed_cog("20 21", *looking("activated: SetPulse(1); return;", f"pulse: {LOOK} return;")))
    assert (pulse.causes, pulse.calls_per_second) == ((), 1)


@pytest.mark.parametrize(("captured", "calls"), [(0, 10), (11, 0)])
def test_a_class_cog_hears_the_player_that_it_captured(captured: int, calls: float) -> None:
    """The player carries no script here; its timer comes to whoever captured it, and is set anew for its sender.

    That may be the player or the lamp, by all that is said: 5 a second each.
    """
    lamp = looking(
        f"startup: CaptureThing({captured}); return;", "timer: SetThingTimer(GetSenderRef(), 0.2);", LOOK, "return;"
    )
    box = [
        "symbols",
        "message startup",
        "end",
        "code",
        "startup:",
        "SetThingTimer(GetLocalPlayerThing(), 1);",
        "return;",
    ]
    (found,) = hotspots(
        "World templates 5", "lamp none type=cog cog=lamp.cog", "box none type=cog cog=box.cog", "mark none type=ghost",
        "World things 90", PLAYER, *things(1), *things(1, "mark", first=11), *things(1, "box", first=12),
        "== cog/lamp.cog", *lamp, "== cog/box.cog", *box, "end",
    )  # fmt: skip
    assert (found.calls_per_second, found.more) == (pytest.approx(calls), False)


def test_what_wakes_a_loop_is_looked_for_only_where_one_sleeps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Among scripts that all send to all, each way between two of them would else look at every script again."""
    asked = []
    wakers = Network.wakers
    monkeypatch.setattr(Network, "wakers", lambda *given: asked.append(given) or wakers(*given))
    (found,) = two_scripts(["startup: SetPulse(0.1); return;", "pulse: SendMessage(other, user0); return;"], ASKED)
    assert (found.calls_per_second, len(asked)) == (pytest.approx(10), 0)
    (found,) = two_scripts(["startup: while (1) { SendMessage(other, user0); Sleep(0.1); } return;"], ASKED)
    assert (found.calls_per_second, len(asked) > 0) == (pytest.approx(10), True)
