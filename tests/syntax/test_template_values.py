"""Values of parameters: what the engine's scan takes, and the patterns against the grammar."""

from __future__ import annotations

import re

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from jktools.syntax.template.records import TEMPLATE, THING
from jktools.syntax.template.values import ValueKind, parses, scan, well_formed
from tests.support.levels import CORPUS, corpus_files

PIECES = st.sampled_from([
    "(", ")", "/", ":", "1", "23", "-", "+", ".", "e", "E5", "0x", "f", "x", "=", "'", "\x1c", "\xa0", "é", "-.5", "1.",
])  # fmt: skip


@settings(max_examples=500, deadline=None)
@given(st.sampled_from(ValueKind), st.lists(PIECES, min_size=1, max_size=14).map("".join))
@example(ValueKind.FRAME, "(1/2/3:4/5/6)")
@example(ValueKind.VECTOR, "(-.5/1./+2e3)")
@example(ValueKind.VECTOR, "(1/2/3")
@example(ValueKind.COLOUR, "(1/2/3)")
@example(ValueKind.COLOUR, "(1/2/.5)")
@example(ValueKind.HEX, "0x")
def test_the_patterns_take_what_the_grammar_takes(kind: ValueKind, text: str) -> None:
    assert well_formed(kind, text) == parses(kind, text)


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
def test_the_patterns_take_what_the_grammar_takes_of_real_values() -> None:
    texts = {v for _, data in corpus_files() for v in re.findall(r"=([^\s,]+)", data.decode("latin-1"))}
    assert len(texts) > 1000
    for text in texts:
        for kind in ValueKind:
            assert well_formed(kind, text) == parses(kind, text), (kind, text)


@pytest.mark.parametrize(("kind", "text", "value"), [
    (ValueKind.FLOAT, ".5", 0.5), (ValueKind.FLOAT, "1.5.5", 1.5), (ValueKind.FLOAT, "1e", 1.0),
    (ValueKind.FLOAT, "x", 0.0), (ValueKind.FLOAT, "1e99", float("inf")), (ValueKind.INT, "0x10", 0),
    (ValueKind.INT, "-7up", -7),
    (ValueKind.INT, "x", 0), (ValueKind.HEX, "400", 0x400), (ValueKind.HEX, "0x400", 0x400), (ValueKind.HEX, "x", None),
    (ValueKind.HEX, "0x", 0), (ValueKind.HEX, "-1", 0xFFFFFFFF), (ValueKind.VECTOR, "(1/2/3", (1.0, 2.0, 3.0)),
    (ValueKind.VECTOR, "(1/2)", None), (ValueKind.COLOUR, "(1/2/3.5)", (1, 2, 3)),
    (ValueKind.FRAME, "(1/2/3:4/5/6)", (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)), (ValueKind.FRAME, "(1/2/3/4/5/6)", None),
    (ValueKind.WORD, "Ky.3DO", "ky.3do"),
])  # fmt: skip
def test_the_engine_takes_the_longest_prefix(kind: ValueKind, text: str, value: object) -> None:
    assert scan(kind, text) == value


def test_the_grammar_parts_lines_into_fields_and_parameters() -> None:
    tokens = TEMPLATE.parse("Crate none,type=cog collide=1 thingflags0x400")
    assert [(t.type, str(t)) for t in tokens] == [
        ("WORD", "Crate"), ("WORD", "none"), ("PARAMETER", "type=cog"), ("PARAMETER", "collide=1"),
        ("WORD", "thingflags0x400"),
    ]  # fmt: skip
    tokens = THING.parse("3: ghost ghost 1 2 3 0 90 0 5 -1 size=.1")
    assert [t.type for t in tokens[-2:]] == ["WORD", "PARAMETER"]
