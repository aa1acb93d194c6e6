"""The reader of COG code: tokens, grammar, limits, and the way on behind a fault."""

from __future__ import annotations

import random
import time
from collections.abc import Sequence
from importlib.resources import files
from typing import Any

import lark
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.syntax.cog import nodes as n
from jktools.syntax.cog.parser import BUILD
from jktools.syntax.cog.printer import print_expression, print_script
from jktools.syntax.cog.scanner import LONGEST_TOKEN, scan
from jktools.syntax.cog.tables import START_RULES, tables
from jktools.syntax.cog.walk import expressions, operands, postorder, same_tree, statements
from tests.support.scripts import PIECES, corpus_scripts, mutated, script_of, whole

SCRIPTS = list(corpus_scripts())
CODE_START = len("symbols\nend\ncode\n")


def body(*code: str) -> Sequence[n.Statement]:
    script = script_of(whole(*code))
    assert script.faults == ()
    return script.code.body


def expression(text: str) -> n.Expression:
    (statement,) = body(f"{text};")
    assert isinstance(statement, n.ExprStatement)
    return statement.expression


def told(*code: str) -> list[tuple[str, int, str]]:
    """Code, line of the fragment and text of the places that are told."""
    script = script_of(whole(*code))
    found = []
    for fault in script.faults:
        span = fault.label.span
        assert span is not None
        found.append((fault.code.id, span.first.line - 3, span.text))
    assert found[0][0] == "JK050"
    return found[1:]


# ---- what Lark makes of the grammar by itself


def reference() -> lark.Lark:
    grammar = files("jktools").joinpath("grammars", "cog.lark").read_text("utf-8")
    return lark.Lark(
        grammar, parser="lalr", lexer="basic", start=list(START_RULES), maybe_placeholders=False, keep_all_tokens=True,
        propagate_positions=True,
    )  # fmt: skip


LARK = reference()


def lark_tokens(text: str) -> list[tuple[str, int, int]]:
    return [(t.type, t.start_pos or 0, t.end_pos or 0) for t in LARK.lex(text)]


def own_tokens(text: str) -> list[tuple[str, int, int]]:
    names = {column: name for name, column in tables().columns.items()}
    return [(names[t.column], t.start, t.end) for t in scan(text, 0, tables()).tokens[:-1]]


def from_lark(tree: Any, leaves: dict[int, Any]) -> Any:
    """Nodes from Lark's tree; recursion is enough for the scripts of people."""
    if isinstance(tree, lark.Token):
        return leaves[tree.start_pos or 0]
    name, parts = str(tree.data), [from_lark(part, leaves) for part in tree.children]
    return BUILD[name](tree.meta.start_pos, tree.meta.end_pos, parts) if name in BUILD else parts[0]


def without_end(text: str) -> str:
    """Code up to its final `end`, which Lark's grammar does not know."""
    stop = scan(text, 0, tables()).tokens[-1]
    return text[: stop.start]


@pytest.mark.skipif(not SCRIPTS, reason="the corpus of real mods is not at hand")
def test_the_scanner_and_the_loop_do_what_lark_does_with_the_grammar() -> None:
    for path, data in SCRIPTS:
        script = script_of(data)
        code = without_end(script.source.text[script.code.start :])
        assert own_tokens(code) == lark_tokens(code), path
        leaves = {t.start: t.value for t in scan(code, 0, tables()).tokens}
        assert same_tree(from_lark(LARK.parse(code, start="body"), leaves), script.code.body), path


@pytest.mark.parametrize("seed", range(20))
def test_random_text_is_cut_as_lark_cuts_it(seed: int) -> None:
    rng = random.Random(seed)
    for _ in range(100):
        glue = rng.choice(("", " "))
        text = without_end(glue.join(rng.choices([*PIECES, "e5", ".", "0", "7", "\\\n", "\xe4", "_"], k=12)))
        assert own_tokens(text) == lark_tokens(text), text


# ---- tokens


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("10", 10), ("010", 8), ("08", 0), ("0178", 15), ("0", 0), ("0x1f", 31), ("0XFFFFFFFF", -1), ("4294967297", 1),
        ("2147483648", -(2**31)), ("9" * 5000, None), ("1e3", 1000.0), (".5", 0.5), ("1.", 1.0),
        ("1.5E-1", 0.15000000596046448), ("1e99", float("inf")),
    ],
)  # fmt: skip
def test_numbers_are_read_as_the_engine_reads_them(text: str, value: float | None) -> None:
    number = expression(text)
    assert isinstance(number, n.Number)
    assert number.text == text
    if value is not None:
        assert (number.value, number.is_flex) == (value, isinstance(value, float))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("'1 2 3'", (1, 2, 3)), ("'1,2,3'", (1, 0, 0)), ("'-1.5e1 +2'", (-15, 2, 0)), ("'1 2 3 4'", (1, 2, 3)),
        ("''", (0, 0, 0)), ("'\n1 \n2'", (1, 2, 0)), ("'x'", (0, 0, 0)),
    ],
)  # fmt: skip
def test_vectors_are_read_as_scanf_reads_them(text: str, value: tuple[float, ...]) -> None:
    vector = expression(text)
    assert isinstance(vector, n.Vector)
    assert vector.value == value


def test_what_no_token_starts_with_is_dropped_and_kept_apart() -> None:
    script = script_of(whole('print("abc);', "x $= @1 ?;"))
    assert script.faults == ()
    assert [print_expression(s.expression) for s in script.code.body if isinstance(s, n.ExprStatement)] == [
        "print(abc)", "x = 1",
    ]  # fmt: skip
    assert [s.text for s in script.strays] == ['"', "$", "@", "?"]


def test_keywords_and_names_fold_case_and_strings_do_not() -> None:
    (statement,) = body('IF (Foo) PRINT("Bar \\"Baz");')
    assert isinstance(statement, n.If)
    assert print_script(script_of(whole('IF (Foo) PRINT("Bar");'))).split("code\n")[1] == (
        'if (foo)\n    print("Bar");\nend\n'
    )


def test_words_come_in_the_order_of_the_scanner() -> None:
    script = script_of(whole('a: b = c("s", a); goto a;'))
    assert [w.name if isinstance(w, n.Name) else w.value for w in script.code.words] == ["a", "b", "c", "s", "a", "a"]


def test_text_behind_the_final_end_is_no_code() -> None:
    script = script_of(whole("x: stop;", "END ) killed: y"))
    assert script.faults == ()
    assert script.code.closed
    assert len(script.code.body) == 1
    assert not script_of("symbols\nend\ncode\nstop;").code.closed


@pytest.mark.parametrize(("before", "token", "behind"), [
    ("print(", '"{}"', ");"), ("", "# {}", ""), ("", "// {}", ""), ("", "x{}", " = 1;"), ("x = ", "'{}'", ";"),
    ("print(", '"{}', ""),
])  # fmt: skip
def test_the_scanner_holds_so_many_bytes_and_no_more(before: str, token: str, behind: str) -> None:
    fill = "_" if token.startswith("x") else "1 "
    for size, codes in ((LONGEST_TOKEN, []), (LONGEST_TOKEN + 1, ["JK050", "JK062"])):
        text = token.format((fill * size)[: size - len(token) + 2])
        if behind or "/" in text or "#" in text:
            assert [d.code.id for d in script_of(whole(before + text + behind, ";")).faults] == codes
        else:  # a quote that nothing closes: the scanner looks to the end of the file
            script = script_of("symbols\nend\ncode\n;" + text[:1] + ";" * (size - 1))
            assert [d.code.id for d in script.faults] == codes


# ---- spans


def test_nodes_know_their_bytes() -> None:
    code = "a: if ((x + 1) * 2) { f(1, (y))[0] = -z; } else do stop; while (1);"
    script = script_of(whole(code))
    text = script.source.text
    seen = {}
    for statement in statements(script.code.body):
        seen[type(statement).__name__] = text[statement.start : statement.end]
        for top in expressions(statement):
            for part in postorder(top):
                seen[type(part).__name__] = text[part.start : part.end]
    assert seen["Labeled"] == code
    assert seen["If"] == code[3:]
    assert seen["Block"] == "{ f(1, (y))[0] = -z; }"
    assert seen["DoWhile"] == "do stop; while (1);"
    assert seen["Return"] == "stop;"
    assert seen["Binary"] == "(x + 1) * 2"
    assert seen["Call"] == "f(1, (y))"
    assert seen["Index"] == "f(1, (y))[0]"
    assert seen["Assign"] == "f(1, (y))[0] = -z"
    assert seen["Unary"] == "-z"


# ---- grammar


@pytest.mark.parametrize(
    ("text", "canonical"),
    [
        ("a = b = c", "a = b = c"), ("1=2", "1 = 2"), ("-x=1", "-x = 1"), ("f(1)=2", "f(1) = 2"),
        ("a & b == c", "a & b == c"), ("(a & b) == c", "(a & b) == c"), ("a | b ^ c & d", "a | b ^ c & d"),
        ("a - (b - c)", "a - (b - c)"), ("(a - b) - c", "a - b - c"), ("(a, b)", "a, b"),
        ("f((a, b), c)", "f((a, b), c)"),
        ("(a = b) + 1", "(a = b) + 1"), ("!(-x)", "!-x"), ("-(a * b)", "-(a * b)"), ("(f)(1)[2]", "f(1)[2]"),
        ("a < b < c", "a < b < c"), ("a || b && c", "a || b && c"), ("(a || b) && c", "(a || b) && c"),
    ],
)  # fmt: skip
def test_precedence(text: str, canonical: str) -> None:
    assert print_expression(expression(text)) == canonical


def test_an_else_belongs_to_the_nearest_if() -> None:
    (outer,) = body("if (a) if (b) c; else d;")
    assert isinstance(outer, n.If)
    assert outer.otherwise is None
    assert isinstance(outer.then, n.If)
    assert outer.then.otherwise is not None


@pytest.mark.parametrize(
    ("most", "make"),
    [
        (48, lambda k: "s: if (a) { x = 1; }" + " else if (a) { x = 1; }" * k),
        (58, lambda k: "s: " + "if (a) { " * k + "x = 1;" + " }" * k),
        (293, lambda k: "s: x = " + "(" * k + "1" + ")" * k + ";"),
        (148, lambda k: "".join(f"l{i}: " for i in range(k)) + "x = 1;"),
    ],
)
def test_nesting_ends_where_the_engines_parser_ends(most: int, make: Any) -> None:
    assert script_of(whole(make(most))).faults == ()
    script = script_of(whole(make(most + 1), "y = 1"))
    assert [d.code.id for d in script.faults] == ["JK050", "JK061", "JK052"]


def test_what_nests_without_limit_needs_no_recursion() -> None:
    count = 40_000
    for text in ("+ 1", ", x", "[0]", "()"):
        script = script_of(whole(f"x {text * count};"))
        assert script.faults == ()
        (statement,) = script.code.body
        assert isinstance(statement, n.ExprStatement)
        assert len(postorder(statement.expression)) >= count
        assert same_tree(script_of(print_script(script)).code.body, script.code.body)
    del script, statement
    for text in ("(", "-", "if (x) ", "{", "x: ", "x = ", "f("):
        assert {d.code.id for d in script_of(whole(text * 20_000)).faults} >= {"JK050", "JK061"}


# ---- behind a fault


@pytest.mark.parametrize(
    ("code", "faults"),
    [
        (["x = 1", "y = 2;", "z = 3", "w = 4;"], [("JK052", 1, "1"), ("JK052", 3, "3")]),
        (["s:", "  x = 1;", "killed:"], [("JK054", 3, "killed:")]),
        (["if (a) { x: }", "y;"], [("JK054", 1, "x:")]),
        (["while (1) { break; }", "y;"], [("JK055", 1, "break")]),
        (["x = ~1;", "y;"], [("JK055", 1, "~")]),
        (["x = 1.5f;", "y;"], [("JK057", 1, "1.5f")]),
        (["/* one", "two */", "y;"], [("JK058", 1, "/*")]),
        (["return 1;", "y;"], [("JK059", 1, "1")]),
        (["stop (x);", "y;"], [("JK059", 1, "(")]),
        (["return", "y;"], [("JK052", 1, "return")]),
        (["x; }", "y;"], [("JK060", 1, "}")]),
        (["x = f(1));", "y;"], [("JK060", 1, ")")]),
        (["if (x == 1 {", "y;", "}"], [("JK053", 1, "(")]),
        (["f(1, 2;", "y;"], [("JK053", 1, "(")]),
        (["x = a[1;", "y;"], [("JK053", 1, "[")]),
        (["if (x) {", "while (y) {", "z;"], [("JK053", 2, "{"), ("JK053", 1, "{")]),
        (["for (i = 0; i < 5;) { x; }", "y;"], [("JK051", 1, ")")]),
        (["x = +1;", "y;"], [("JK051", 1, "+")]),
        (["x++;", "y;"], [("JK051", 1, "+")]),
        (["x += 1;", "y;"], [("JK051", 1, "=")]),
        (["if x == 1) y;", "y;"], [("JK051", 1, "x")]),
        (["x = ;", "y;"], [("JK051", 1, ";")]),
        (["goto 5;", "y;"], [("JK051", 1, "5")]),
        (["call f();", "y;"], [("JK051", 1, "(")]),
        (["if (x) y; z; else w;", "y;"], [("JK051", 1, "else")]),
        (["do x; y;", "z;"], [("JK051", 1, "y")]),
        (["while x < 5 { x; }", "y;"], [("JK051", 1, "x")]),
        (["x; }", "call f();", "y;"], [("JK060", 1, "}"), ("JK051", 2, "(")]),
    ],
)  # fmt: skip
def test_one_mistake_is_one_fault_and_the_rest_is_read(code: list[str], faults: list[tuple[str, int, str]]) -> None:
    assert told(*code) == sorted(faults, key=lambda f: f[1])
    last = script_of(whole(*code)).code.body[-1]
    assert isinstance(last, (n.ExprStatement, n.If, n.Labeled)), last


def test_what_stands_before_a_fault_is_kept() -> None:
    script = script_of(whole("a;", "if (b) { c; }", "}", "call d();", "e;"))
    kept = [type(s).__name__ for s in script.code.body]
    assert kept[:2] == ["ExprStatement", "If"]
    assert kept[-1] == "ExprStatement"


def test_a_statement_that_is_given_up_is_marked() -> None:
    script = script_of(whole("x = ;", "y;"))
    first, second = script.code.body
    assert isinstance(first, n.Unreadable)
    assert script.source.text[first.start : first.end] == "x = ;"
    assert isinstance(second, n.ExprStatement)


def test_a_file_of_faults_tells_a_hundred_and_ends() -> None:
    begun = time.perf_counter()
    script = script_of(whole(*["x = ; y = 1 z = 2;"] * 50_000))
    assert [d.code.id for d in script.faults].count("JK065") == 1
    assert len(script.faults) == 102
    assert time.perf_counter() - begun < 20  # seconds; quadratic time would be minutes


@settings(max_examples=300, deadline=None)
@given(st.lists(st.sampled_from(PIECES), max_size=60), st.sampled_from(("", " ", "\n")))
def test_random_tokens_never_crash(words: list[str], glue: str) -> None:
    script = script_of(whole(glue.join(words)))
    for statement in statements(script.code.body):
        assert 0 <= statement.start <= statement.end <= len(script.source.data)
    if not script.faults:
        again = script_of(print_script(script))
        assert again.faults == ()
        assert same_tree(again.code.body, script.code.body)


@pytest.mark.skipif(not SCRIPTS, reason="the corpus of real mods is not at hand")
def test_mutated_scripts_never_crash_and_printing_keeps_the_tree() -> None:
    rng = random.Random(1)
    for path, data in SCRIPTS:
        for text in (
            data.decode("latin-1"),
            mutated(data.decode("latin-1"), rng),
            mutated(data.decode("latin-1"), rng),
        ):
            script = script_of(text, path)
            assert all(operands(e) is not None for s in statements(script.code.body) for e in expressions(s))
            if not script.faults:
                again = script_of(print_script(script), path)
                assert again.faults == ()
                assert same_tree(again.code.body, script.code.body)
                assert [(s.type, s.name.key, s.default) for s in again.header.symbols] == [
                    (s.type, s.name.key, s.default) for s in script.header.symbols
                ]
