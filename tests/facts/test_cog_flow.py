"""Flow, values and rates of single scripts, with figures worked out by hand."""

from __future__ import annotations

import math

import pytest

from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.rates import Rates
from jktools.facts.cog.repeats import Repeats
from jktools.facts.script import ScriptFacts
from jktools.model.cog.program import Role
from jktools.model.cog.values import Value
from tests.support.scripts import script_of

HEADER = ["symbols", "message startup", "message pulse", "message timer", "message activate", "message user0"]


def facts(*lines: str, symbols: tuple[str, ...] = ()) -> ScriptFacts:
    text = "\n".join([*HEADER, *symbols, "end", "code", *lines, "end", ""])
    script = script_of(text)
    assert not script.rejected, [f.message for f in script.faults]
    return ScriptFacts(script)


def repeats(rates: Rates, verb: str, label: str = "startup") -> Repeats:
    site = next(s for s in rates.sites if s.verb.name == verb)
    return rates.repeats_of(label, site)


# ---- names


def test_the_table_holds_declared_symbols_then_words_of_the_code_in_order() -> None:
    program = facts('startup: x = 1; Print("a"); user1 = x; Print("b"); again: y = x; return;').program
    names = [(slot.name, slot.type) for slot in program.slots[5:]]
    assert names == [("x", "implicit"), ("", "string"), ("", "string"), ("again", "implicit"), ("y", "implicit")]
    assert program.role_of("user1") is Role.MESSAGE
    assert program.role_of("print") is Role.VERB
    assert program.role_of("global3") is Role.SHARED


def test_the_first_of_a_name_owns_it_but_each_takes_a_value() -> None:
    program = facts("startup: return;", symbols=("int a", "thing b local", "flex a=2", "sound c")).program
    assert program.slot_of["a"].type == "int"
    assert [slot.name for slot in program.valued] == ["a", "a", "c"]


def test_the_last_of_two_labels_counts_and_activate_is_activated() -> None:
    each = facts("startup: Print(1);", "return;", "startup: Sleep(1); return;")
    assert [s.verb.name for s in each.rates.sites] == ["sleep"]
    both = ScriptFacts(script_of("symbols\nmessage activated\nmessage activate\nend\ncode\nactivate: ;\nend\n"))
    assert both.program.handlers == ()  # the first declaration owns the id, and has no label


# ---- values


@pytest.mark.parametrize(
    ("code", "low", "high"),
    [
        ("SetPulse(0.5);", 0.5, 0.5),
        ("x = 2; SetPulse(x * 3);", 6, 6),
        ("x = 2; if (Rand() > 0.5) x = 5; SetPulse(x);", 2, 5),
        ("SetPulse(Rand());", 0, 1),
        ("for (i = 0; i < 4; i = i + 1) SetPulse(i);", 0, 4 - 2**-22),  # the flex below 4
        ("x = 1; call change; SetPulse(x);", 0, 9),
        ("x = 1; Sleep(1); SetPulse(x);", 0, 9),
        ("x = 1; Print(1); SetPulse(x);", 1, 1),
        ("x = 1; if (x == 1 && DamageThing(0, 1, 1, 0) >= 0) SetPulse(x);", 0, 9),
        ("if (0.5) SetPulse(1); else SetPulse(2);", 2, 2),
        ("y[1] = 7; y[2] = 8; z = 3; SetPulse(w);", 8, 8),
    ],
)
def test_intervals(code: str, low: float, high: float) -> None:
    each = facts(
        f"startup: {code} return;", "change: x = 9; return;", "user0: x = 9; return;",
        symbols=("int x local", "int i local", "int y local", "int z local", "int w local"),
    )  # fmt: skip
    found = [s.arguments[0] for s in each.rates.sites if s.verb.name == "setpulse"]
    assert len(found) == 1
    # What lies in between is not asked for: the ends must hold the values, and no more than a few others.
    assert found[0].low <= low and high <= found[0].high
    assert (found[0].low, found[0].high) == (low, high) or code.startswith(("for", "y[")) or "x = 1;" in code


def test_what_a_verb_takes_from_the_stack_is_not_compared() -> None:
    """HasLOS with one argument takes x for the other, and an older value is compared in its stead."""

    def least(test: str) -> float:
        each = facts(f"startup: x = Rand() * 4; if ({test}) SetPulse(x); return;", symbols=("flex x local",))
        (site,) = (site for site in each.rates.sites if site.verb.name == "setpulse")
        return site.arguments[0].low

    assert least("x > HasLOS(0, 0) + 3") >= 2
    assert least("x > HasLOS(0) + 3") == 0
    assert least("x > 3 && HasLOS(0, 0)") >= 3
    assert least("x > 3 && HasLOS(0)") == 0


def test_messages_go_where_the_last_arguments_say() -> None:
    """An argument too many stays below on the stack; with one too few all are others."""

    def arms(sent: str) -> frozenset[str]:
        lines = (f"startup: SendMessage({sent}); return;", "user0: return;")
        return facts(*lines, symbols=("cog other",)).rates.arms["startup"]

    assert arms("other, user0") == set()
    assert arms("GetSelfCog(), user0") == {"user0"}
    assert arms("other, GetSelfCog(), user0") == {"user0"}
    assert arms("user0") == {"user0"}


def test_an_instance_gives_its_values() -> None:
    each = facts("startup: SetPulse(rate * 2); return;", symbols=("flex rate=1.0",))
    slot = each.program.slot_of["rate"].index
    bound: dict[int, Value] = {slot: 0.25}
    assert Analysis(each.program).rates.sites[0].arguments[0].number is None
    assert Analysis(each.program, bound).rates.sites[0].arguments[0].number == 0.5
    assert Analysis(each.program, {}).rates.sites[0].arguments[0].number == 2.0


# ---- what runs


def test_dead_code_is_told_once_a_run() -> None:
    each = facts("Print(1);", "startup: return; Print(2); Print(3);", "sub: stop; { Print(4); }", "pulse: goto sub;")
    assert [each.span(s).text for s in each.reach.dead] == ["Print(1);", "Print(2);", "Print(4);"]


def test_labels_lead_into_each_other() -> None:
    each = facts(
        "startup: call sub; if (1) goto pulse;", "timer: if (2) { Print(1); } else return;", "pulse: return;", "sub: ;"
    )
    found = {(p.source, p.target, p.how) for p in each.reach.passages}
    assert found == {
        ("startup", "sub", "call"), ("startup", "pulse", "goto"), ("startup", "timer", "falls"),
        ("timer", "pulse", "falls"),
    }  # fmt: skip
    assert [(label.label.name, each.reach.label_of[ends[-1]]) for label, ends in each.reach.falls] == [
        ("timer", "startup"),
        ("pulse", "timer"),
    ]


def test_a_jump_leads_to_the_label_that_it_names_and_on_through_those_below() -> None:
    each = facts("startup: goto one; pulse: call two; return; one: two: three: Print(1); if (1) stop; timer: return;")
    assert {(p.source, p.target, p.how) for p in each.reach.passages} == {
        ("startup", "one", "goto"), ("pulse", "two", "call"), ("one", "two", "falls"), ("two", "three", "falls"),
        ("three", "timer", "falls"),
    }  # fmt: skip


# ---- how often


@pytest.mark.parametrize(
    ("loop", "per_run", "per_second"),
    [
        ("Print(1);", 1, 0),
        ("for (i = 0; i < 10; i = i + 1) Print(1);", 10, 0),
        ("for (i = 10; i > 0; i = i - 2) Print(1);", 5, 0),
        ("i = 0; while (i <= 4) { Print(1); i = 1 + i; }", 5, 0),
        ("for (i = 0; i < 3; i = i + 1) for (k = 0; k < 3; k = k + 1) Print(1);", 9, 0),
        ("while (Rand() < 0.5) Print(1);", math.inf, 0),
        ("while (1) { Print(1); Sleep(0.25); }", 1, 4),
        ("while (1) { Print(1); Sleep(0); }", 1, 10),
        ("while (1) { Print(1); Sleep(0.001); }", 1, 50),  # a script wakes once a frame
        ("while (1) { Print(1); Sleep(0.5); Sleep(0.5); }", 1, 1),
        ("while (1) { Print(1); call nap; }", 1, 4),
        ("while (1) { Print(1); call maybe; }", math.inf, 0),
        ("while (1) { Print(1); call nap; call maybe; Sleep(0.75); }", 1, 1),
        ("while (1) { Print(1); if (Rand() < 0.5) { call nap; } else Sleep(1); }", 1, 4),
        ("while (1) { Print(1); if (Rand() < 0.5) Sleep(1); }", math.inf, 0),
        ("for (i = 0; i < 10; i = i) Print(1);", math.inf, 0),
        ("for (i = 0; i < 10; i = i + 1) { Print(1); i = 0; }", math.inf, 0),
        ("for (i = 0; i < 10; i = i + 1) { Print(1); if (Rand() < 0.1) i = 99; }", 10, 0),
        ("i = 0; do { Print(1); i = i + 1; } while (i < 3);", 3, 0),
        ("again: Print(1); if (Rand() < 0.5) goto again;", math.inf, 0),
        ("for (i = 0; i < 5 && Rand() < 0.5; i = i + 1) Print(1);", 5, 0),  # goes on only while both hold
        ("for (i = 0; Rand() < 0.5 && (k != 7 && 5 > i); i = i + 1) Print(1);", 5, 0),
        ("for (i = 0; !(i >= 5 || Rand() < 0.5); i = i + 1) Print(1);", 5, 0),
        ("for (i = 0; i < 5 || Rand() < 0.5; i = i + 1) Print(1);", math.inf, 0),  # goes on while one holds
        ("for (i = 0; !(i >= 5 && Rand() < 0.5); i = i + 1) Print(1);", math.inf, 0),
        ("for (i = 0; i < 5 & Rand() < 0.5; i = i + 1) Print(1);", math.inf, 0),
        ("call twice; call twice;", 2, 0),
        ("call deep;", 4, 0),  # no more than 4 calls are open at a time
        ("while (1) { Print(1); Sleep(Rand()); }", 1, 50),
        ("i = 0; while (i < 10) { Print(1); if (Rand() < 0.5) i = i + 1; }", math.inf, 0),
        ("i = 0; while (i < 10) { Print(1); k[Rand()] = i + 1; }", math.inf, 0),
        # A verb without its argument takes what stands before it: not i is compared then, but what was left before.
        ("i = 0; do { Print(1); i = i + 1; 3; } while (i < GetThingType(0));", 32, 0),
        ("i = 0; do { Print(1); i = i + 1; 3; } while (i < GetThingType());", math.inf, 0),
    ],
)
def test_loops(loop: str, per_run: float, per_second: float) -> None:
    each = facts(
        f"startup: {loop} return;",
        "twice: Print(1); return;",
        "deep: Print(1); call deep; return;",
        "nap: if (Rand() < 0.5) Sleep(2); else { Sleep(0.125); call rest; } return;",
        "rest: Sleep(0.125); return;",
        "maybe: if (Rand() < 0.5) return; Sleep(2); return;",
        symbols=("int i local", "int k local"),
    )
    passes = [each.rates.repeats_of("startup", s) for s in each.rates.sites if s.verb.name == "print"]
    assert (sum(p.per_run for p in passes), sum(p.per_second for p in passes)) == (per_run, per_second)


def test_a_loop_that_others_can_turn_back_has_no_proven_end() -> None:
    """The second run of a handler starts the counter anew while the first sleeps."""
    each = facts("activate: for (i = 0; i < 5; i = i + 1) { Print(1); Sleep(1); } return;", symbols=("int i local",))
    found = repeats(each.rates, "print", "activate")
    assert (found.per_run, found.per_second, found.per_interruption) == (1, 1, 1)


def test_what_sends_each_handler_its_message() -> None:
    rates = facts(
        "startup: SetPulse(0.5); SendMessage(GetSelfCog(), user0); return;",
        "activate: SetTimerEx(2, 1, 0, 0); SetTimerEx(0, 2, 0, 0); return;",
        "pulse: SetPulse(0); return;",
        "timer: return;",
        "user0: return;",
    ).rates
    assert [s.kind for s in rates.sources["startup"]] == ["once"]
    assert [(s.kind, s.least, s.off) for s in rates.sources["pulse"]] == [("pulse", 0.5, False), ("pulse", 0.0, True)]
    assert [s.kind for s in rates.sources["user0"]] == ["event", "message"]
    assert rates.arms["startup"] == {"pulse", "user0"}
    assert rates.arms["activate"] == {"timer"}
    most = rates.most_runs(60, {"startup": 1, "activate": 3})
    assert most == {"startup": 1, "activate": 3, "pulse": 121, "timer": 6, "user0": 1}


def test_a_pulse_comes_once_a_frame_at_most() -> None:
    rates = facts("startup: SetPulse(0.001); return;", "pulse: return;").rates
    assert rates.most_runs(10, {"startup": 1})["pulse"] == 501
    assert rates.most_runs(10, {"startup": 1}, frames=30)["pulse"] == pytest.approx(301)


def test_which_handlers_come_to_a_verb_of_sight_and_how_often() -> None:
    each = facts(
        "startup: SetPulse(rate); return;",
        "pulse: for (i = 0; i < 3; i = i + 1) call look; return;",
        "activate: if (IsAITargetInSight(lamp)) Print(1);",
        "look: if (HasLOS(lamp, GetLocalPlayerThing()) == 1) Print(2); return;",
        symbols=("int i local", "flex rate=1.0", "thing lamp"),
    )
    slots = each.program.slot_of
    analysis = Analysis(each.program, {slots["rate"].index: 0.25, slots["lamp"].index: 12})
    found = [(c.label, c.site.verb.name, c.site.verb.sight, c.repeats.per_run) for c in analysis.rates.sight_calls]
    assert found == [
        ("pulse", "haslos", "ray", 3),
        ("activate", "isaitargetinsight", "cached", 1),
        ("activate", "haslos", "ray", 1),
    ]
    assert analysis.rates.sight_calls[0].site.arguments[0].number == 12
    assert analysis.rates.most_runs(1, {"startup": 1})["pulse"] == 5


def test_messages_in_a_circle_have_no_bound() -> None:
    rates = facts("startup: return;", "user0: SendMessage(GetSelfCog(), user0); return;").rates
    assert rates.most_runs(1, {"user0": 1})["user0"] == math.inf


def test_a_deep_tree_is_no_trouble() -> None:
    depth = 60
    nested = "if (1) " * (depth // 2) + "Print(" + "(" * depth + "1" + " + 1)" * depth + ");"
    assert facts(f"startup: {nested} return;").rates.sites[0].arguments[0].number == 1 + depth
    long_sum = " + ".join(["1"] * 5000)
    assert facts(f"startup: Print({long_sum}); return;").rates.sites[0].arguments[0].number == 5000


MANY = 1500


@pytest.mark.parametrize(
    "code",
    [
        "while (1) { Sleep(1); " + "if (x < 5) return; " * MANY + "}",
        "".join(f"v{i} = v{i + 1} + 1; DamageThing(1, 2, 3, 4); " for i in range(MANY)),
        "".join(f"a{i}[Rand() * {i}] = {i}; " for i in range(MANY)),
        "".join(f"call s{i}; " for i in range(MANY)) + "return; " + "".join(f"s{i}: Print(1); " for i in range(MANY)),
        "".join(f"l{i}: x = x + 1; if (x > {i}) goto l{i * 7919 % MANY}; " for i in range(MANY)),
    ],
    ids=["ways out of a loop", "a chain of values", "arrays", "calls that fall through", "jumps"],
)
def test_scripts_made_to_take_long_do_not(code: str) -> None:
    """Seconds for what took minutes when each part looked at all the others; what is let go is let go soundly."""
    each = facts(f"startup: {code} return;")
    assert each.rates.sources["startup"]
    assert each.rates.most_runs(1, {"startup": 1})["startup"] == 1
    assert each.reach.dead == ()
