"""One mistake in a script is told once, with its cure: what follows from it is left out."""

from __future__ import annotations

import pytest

from jktools.linter import lint
from jktools.linter.registry import rules
from jktools.syntax.cog import Script
from tests.support.scripts import script_of

HEADER = "symbols\nmessage startup\nint i local\nflex f local\nend\ncode\n"

CASES = [
    ("startup: while (i < 3) { i = i + 1; if (i == 2) break; } return;", "JK055", "set a variable"),
    ("startup: switch (i) { Print(\"x\"); } return;", "JK052", "there is no switch"),
    ("startup: return(1);", "JK059", "ReturnEx"),
    ("startup: call sub(); return; sub: return;", "JK051", "without parentheses"),
    ("startup: goto sub(); sub: return;", "JK051", "without parentheses"),
    ("startup: return; stop: return;", "JK051", "stop is a keyword"),
    ("startup: i = 0x; return;", "JK057", "remove the letters"),
    ("startup: int j = 3; return;", "JK052", "declared in the symbols"),
    ("startup: if (i) Print(\"a\"); else Print(\"b\") return;", "JK052", "end the statement with a ;"),
    ("", "JK056", "write a semicolon"),
]  # fmt: skip


@pytest.mark.parametrize(("code", "expected", "cure"), CASES)
def test_a_fault_is_told_once(code: str, expected: str, cure: str) -> None:
    found = lint(script_of(f"{HEADER}{code}\nend\n"))
    assert sorted(d.code.id for d in found) == ["JK050", expected]
    assert cure in str(next(d.help for d in found if d.code.id == expected))


def test_else_if_in_one_word_is_told_as_such() -> None:
    found = lint(script_of(f'{HEADER}startup: if (i) Print("a"); elseif (f) Print("b"); return;\nend\n'))
    assert ("JK052", 'write "else if"') in {(d.code.id, d.help) for d in found}


def test_an_unpaired_quote_is_told_without_what_follows_from_it() -> None:
    found = lint(script_of(f'{HEADER}startup: Print("abc);\nreturn;\nend\n'))
    assert [d.code.id for d in found] == ["JK519"]


def test_symbols_without_end_are_told_at_once() -> None:
    found = lint(script_of("symbols\nmessage startup\ncode\nstartup:\n return;\nend\n"))
    assert [d.code.id for d in found] == ["JK050", "JK064"]
    assert found[1].help == 'add a line "end" before line 3'


def test_a_file_of_one_line_for_the_engine_is_told_so() -> None:
    found = lint(script_of("symbols\rmessage startup\rend\rcode\rstartup:\r return;\rend\r"))
    assert [d.code.id for d in found] == ["JK050", "JK064"]
    assert "line ends" in str(found[1].help)


def codes_of(script: Script) -> set[str]:
    return {d.code.id for d in lint(script)}


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("i & 4 == 4", {"JK563"}),
        ("4 == i & 4", {"JK563"}),
        ("(i & 4) == 4", set()),
        ("i & (4 == i)", set()),
        ("i | 1 && 2 < i", set()),
        ("1 < i < 5", {"JK564"}),
        ("(1 < i) < 5", set()),
        ("1 < (i < 5)", set()),
        ("!i == 3", {"JK564"}),
        ("!i == !f", set()),
        ("!i == 1", set()),
        ("!(i == 3)", set()),
    ],
)
def test_what_binds_tighter_counts_with_its_parentheses(condition: str, expected: set[str]) -> None:
    code = f'startup: i = GetParam(0); f = GetParam(1); if ({condition}) Print("x"); return;'
    chosen = [r for r in rules() if r.code.id in ("JK563", "JK564")]
    assert {d.code.id for d in lint(script_of(f"{HEADER}{code}\nend\n"), chosen)} == expected


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("startup: return; sub: return;", True),
        ("startup: return; sub: call other; return; other: return;", True),
        ("startup: goto sub; sub: return;", False),
        ("startup: i = 1; sub: return;", False),
        ("startup: return; pulse: return;", False),  # a rule of its own
    ],
)
def test_a_label_that_nothing_leads_to(code: str, expected: bool) -> None:
    assert ("JK566" in codes_of(script_of(f"{HEADER}{code}\nend\n"))) is expected
