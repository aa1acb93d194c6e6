"""Texts by symbols: each comes back, on its own, and takes fewer bytes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.compiler.text import ESCAPE, FIRST, LONGEST_READ, MOST, coded, decoded, symbols_of, written
from tests.support.levels import level_of, two_rooms

NAMES = [
    f"{stem}{number:02}.{kind}".encode()
    for stem in ("force", "saber")
    for number in range(40)
    for kind in ("wav", "mat")
]


def test_parts_that_repeat_become_symbols() -> None:
    symbols = symbols_of(NAMES)
    short = coded(NAMES, symbols)
    assert [decoded(each, symbols) for each in short] == NAMES
    told = sum(map(len, short)) + sum(len(each) + 1 for each in symbols)
    assert told < 0.6 * sum(map(len, NAMES))
    assert all(len(each) <= 4 for each in short), "a stem, two digits and an ending"
    uses = b"".join(short)
    for place, part in enumerate(symbols):
        assert uses.count(FIRST + place) * (len(part) - 1) > len(part) + 1, "it spares more than it takes"


def test_the_codes_are_those_of_the_schema() -> None:
    symbols = [b".wav", b"\xe9\x80"]
    assert decoded(b"a\x80", symbols) == b"a.wav"
    assert decoded(b"\x81\xff\xff\xff\x80\xffz", symbols) == b"\xe9\x80\xff\x80z"
    assert coded([b"door.wav", b"\xe9\x80\xe9", b""], symbols) == [b"door\x80", b"\x81\xff\xe9", b""]
    assert (FIRST, ESCAPE, MOST) == (128, 255, 127)


def test_the_shortest_way_is_taken_where_the_longest_first_misses_it() -> None:
    assert coded([b"abcde"], [b"abc", b"ab", b"cde"]) == [b"\x81\x82"]


@pytest.mark.parametrize("wrong", [b"a\x81", b"a\xff"])
def test_a_code_without_a_symbol_is_refused(wrong: bytes) -> None:
    with pytest.raises(IndexError):
        decoded(wrong, [b"x"])


@given(st.lists(st.one_of(st.binary(max_size=12), st.text("abc.\xe9\u20ac", max_size=12).map(str.encode)), max_size=40))
def test_every_text_comes_back(texts: list[bytes]) -> None:
    symbols = symbols_of(texts * 3)
    assert len(symbols) <= MOST
    assert all(1 < len(each) <= LONGEST_READ and 0 not in each for each in symbols)
    assert [decoded(each, symbols) for each in coded(texts, symbols)] == texts


def test_symbols_depend_on_the_texts_alone() -> None:
    assert symbols_of(NAMES) == symbols_of(list(NAMES))
    assert symbols_of([b"once"]) == []
    assert written([b"once", b"\xc3\xa9"]) == ([b"once\0", b"\xc3\xa9\0"], [])
    assert written(NAMES) == (coded(NAMES, symbols_of(NAMES)), symbols_of(NAMES))


def test_a_level_of_many_names_is_coded_unless_it_is_to_be_plain() -> None:
    names = [f"plänkel_{i:03}.wav" for i in range(120)]
    many = CompiledLevel(compile_level(level_of(two_rooms(f"World sounds {len(names)}", *names))))
    assert set(names) <= set(many.strings)
    assert many._texts.symbols.size
    plain = CompiledLevel(compile_level(level_of(two_rooms()), CompileSettings(plain=True)))
    assert not plain._texts.symbols.size
