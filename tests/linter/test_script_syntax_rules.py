"""Rules on the syntax of scripts, where an example of a few lines is not enough."""

from __future__ import annotations

import pytest

from jktools.linter import find_rule, lint
from jktools.model.cog.messages import messages_of
from tests.support.scripts import script_findings, script_of, whole


def messages(code: str, *fragment: str) -> list[str]:
    return [d.message for d in script_findings(code, *fragment)]


def test_messages_past_the_limit() -> None:
    declared = [f"message m{i}" for i in range(34)]
    assert messages("JK512", "symbols", *declared[:32], "end") == []
    assert messages("JK512", "symbols", *declared, "end") == [
        "the script declares 34 messages, but the engine keeps 32: it drops m32, m33"
    ]


def test_references_past_the_limit() -> None:
    local, things = ["int l local", "message startup"], [f"thing t{i}" for i in range(135)]
    assert messages("JK513", "symbols", *local, *things[:128], "end") == []
    assert messages("JK513", "symbols", *local, *things, "end") == [
        "the script declares 135 symbols that a level can set, but the engine keeps 128: it drops t128, t129, t130, "
        "t131, t132, ..."
    ]


def test_symbols_past_the_limit() -> None:
    assert messages("JK514", *(f"x{i} = 1;" for i in range(250)), *('Print("s");' for _ in range(6))) == []
    assert messages("JK514", *(f"x{i} = 1;" for i in range(250)), *('Print("s");' for _ in range(7))) == [
        "the script has 257 symbols, 7 of them strings, but the engine tells only 256 apart"
    ]


def test_symbols_that_are_declared_past_the_limit() -> None:
    """Local numbers count for no other limit: the table is what they fill."""
    declared = ["symbols", "message startup", *(f"int x{i} local" for i in range(257)), "end"]
    assert messages("JK514", *declared[:-2], "end") == [
        "the script has 257 symbols, 0 of them strings, but the engine tells only 256 apart"
    ]
    assert messages("JK514", *declared[:-3], "end") == []
    assert messages("JK513", *declared) == []
    assert messages("JK512", *declared[:-1], "message timer", "end") == []


def test_a_message_that_the_engine_drops_is_not_called_undeclared() -> None:
    names = [name for name in messages_of("jk") if name not in ("trigger", "activate")][:32]
    declared = [f"message {name}" for name in names]
    code = ["code", "x = 1;", "return;", "trigger:", "x = 2;", "return;", "end"]
    assert messages("JK536", "symbols", *declared, "end", *code) != []
    assert messages("JK536", "symbols", *declared, "message trigger", "end", *code) == []
    assert len(messages("JK512", "symbols", *declared, "message trigger", "end", *code)) == 1


def test_a_quote_that_ends_the_game_is_not_told_as_dropped() -> None:
    far = "x = 1; // a comment" + " " * 17_000
    assert messages("JK519", 'Print("a);', "x = 1;") != []
    assert messages("JK519", 'Print("a);', far) == []
    assert messages("JK062", 'Print("a);', far) != []


@pytest.mark.parametrize(
    ("statement", "jumps"),
    [("if (x) ;", 1), ("if (x) ; else ;", 2), ("while (x) ;", 2), ("do ; while (x);", 1), ("for (x; x; x) ;", 3)],
)
def test_jumps_past_the_limit(statement: str, jumps: int) -> None:
    most = 510 // jumps  # beside the one symbol
    spare = 510 - most * jumps
    fits = [statement] * most + ["if (x) ;"] * spare
    assert messages("JK515", *fits) == []
    assert messages("JK515", *fits, "if (x) ;") == [
        "the script has 1 symbols and 511 jumps, 512 together, but the engine has room for 511"
    ]
    assert lint(script_of(whole(*fits, "if (x) ;"), game="mots"), [find_rule("JK515")]) == []


def test_a_comment_over_old_line_ends() -> None:
    text = "symbols\nend\ncode\nx = 1; // one\ry = 2;\rz = 3;\nend\n"
    (found,) = lint(script_of(text), [find_rule("JK516")])
    assert found.label.span is not None
    assert found.label.span.start == text.index("\r")
    for fine in ("x = 1; // one\r\ny = 2;\r\n", 'Print("// a\rb");', "// one\r\n\r\n# two\r \r\n;"):
        assert lint(script_of(f"symbols\nend\ncode\n{fine}\nend\n"), [find_rule("JK516")]) == []


@pytest.mark.parametrize(
    ("header", "marked"),
    [
        ("thing a // local", ["local"]),
        ("thing a // so mask=0x4 nolink", ["mask=0x4", "nolink"]),
        ("thing a local // local", []),
        ("thing a //local", []),
        ("thing a # // local", []),
        ("thing a desc=// local", []),
    ],
)
def test_words_of_a_comment_that_take_effect(header: str, marked: list[str]) -> None:
    found = script_findings("JK501", "symbols", header, "end")
    assert [d.label.span.text for d in found if d.label.span] == marked


@pytest.mark.parametrize(
    ("header", "said"),
    [
        ("int a=0x10", ['int a has the default "0x10", but the engine reads 0']),
        ("int a=0.5", ['int a has the default "0.5", but the engine reads 0']),
        ("thing a=-1", []),
        ("flex a=1e3", []),
        ("flex a=.5", []),
        ("float a=1.5f", ['float a has the default "1.5f", but the engine reads 1.5']),
        ("surface a=door", ['surface a has the default "door", but the engine reads 0']),
        ("sound a=0x10", []),
        ("int a=", ['int a has the default "", but the engine reads 0']),
    ],
)
def test_defaults_that_are_misread(header: str, said: list[str]) -> None:
    assert messages("JK506", "symbols", header, "end") == said


@pytest.mark.parametrize(
    ("number", "said"),
    [
        ("010", ["010 starts with 0, so that the engine reads it as octal: 8"]),
        ("08", ["08 starts with 0, so that the engine reads it as octal: 0"]),
        ("00", []), ("07", []), ("0", []), ("0x10", []), ("0.5", []), ("01e2", []),
    ],
)  # fmt: skip
def test_octal_numbers(number: str, said: list[str]) -> None:
    assert messages("JK517", f"x = {number};") == said


@pytest.mark.parametrize(
    ("vector", "read"),
    [
        ("1 2 3", None), (" 1.5\t-2 +3e1 ", None), ("1,2,3", "1 0 0"), ("1 2", "1 2 0"), ("", "0 0 0"),
        ("1 2 3 4", "1 2 3"), ("1 2 3f", "1 2 3"), ("x 1 2", "0 0 0"),
    ],
)  # fmt: skip
def test_vectors(vector: str, read: str | None) -> None:
    said = [f"the vector is written '{vector}', but the engine reads '{read}'"] if read else []
    assert messages("JK518", f"x = '{vector}';") == said


@pytest.mark.parametrize(
    ("code", "marked"),
    [
        ("if (x = 1) ;", ["x = 1"]),
        ("x = y = 0;", ["y = 0"]),
        ("f(x = 1);", ["x = 1"]),
        ("a[x = 1] = 2;", ["x = 1"]),
        ("while (x = f()) ;", ["x = f()"]),
        ("for (x = 0; x = 1; x = x + 1) ;", ["x = 1"]),
        ("x = 1, y = 2;", []),
        ("for (x = 0, y = 1; x < 5; x = x + 1, y = y + 1) ;", []),
        ("if (x = 1, y) ;", []),
        ("if ((x = 1) == 2) ;", ["x = 1"]),
    ],
)
def test_assignments_whose_value_is_used(code: str, marked: list[str]) -> None:
    assert [d.label.span.text for d in script_findings("JK524", code) if d.label.span] == marked


@pytest.mark.parametrize(
    ("code", "marked"),
    [
        ("x == 1;", ["x == 1"]), ("x;", ["x"]), ("1, f();", ["1"]), ("f() + 1;", []), ("Sleep;", []), ("-(x = 1);", []),
        ("for (x; x; x) ;", []), ("f();", []),
    ],
)  # fmt: skip
def test_statements_without_effect(code: str, marked: list[str]) -> None:
    assert [d.label.span.text for d in script_findings("JK523", code) if d.label.span] == marked


def test_text_behind_the_end_but_not_a_comment() -> None:
    assert messages("JK521", "x: stop;", "end", "// by me", "# and you", "", " ; last") == []
    found = script_findings("JK521", "x: stop;", "end", "// by me", "y: stop;")
    assert [d.label.span.text for d in found if d.label.span] == ["y: stop;"]


def test_bytes_past_ascii_are_told_once() -> None:
    assert messages("JK520", "x = 1; // \xfcber", "// \x93so\x94") == [
        "the byte 0xfc lies outside the 128 characters that the engine's scanner knows, and 2 more bytes do"
    ]
    assert messages("JK520", "symbols", "thing a # \xfcber", "end") == []
    assert messages("JK519", "x\xfc = $1;") == ["$ starts nothing that the engine knows: it drops it and reads on"]
