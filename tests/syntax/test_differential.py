"""The native reader and the grammar read every level alike: the same columns, the same findings."""

from __future__ import annotations

import os
import random
from collections.abc import Mapping
from dataclasses import fields, is_dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.source import Source
from jktools.syntax.jkl import Document, read
from tests.support.levels import TWO_ROOMS, corpus_files

CORPUS_FILES = list(corpus_files())
FUZZ = bool(os.environ.get("JKTOOLS_FUZZ"))
"""Set by `make fuzz`: every level, and many more random faults."""

MOST_BYTES = 10**9 if FUZZ else 200_000
"""Larger levels are left to `make fuzz`; the grammar alone reads half a megabyte a second."""


def same(path: str, one: object, other: object) -> None:
    """Assert that two parts of documents are equal to the last bit."""
    assert type(one) is type(other), path
    if isinstance(one, np.ndarray):
        assert isinstance(other, np.ndarray)
        assert one.dtype == other.dtype, path
        assert one.shape == other.shape, path
        assert one.tobytes() == other.tobytes(), path
    elif isinstance(one, Mapping):
        assert isinstance(other, Mapping)
        assert list(one) == list(other), path
        for key in one:
            same(f"{path}[{key}]", one[key], other[key])
    elif is_dataclass(one):
        for f in fields(one):
            if f.name not in ("source", "lines") or path != "document":
                same(f"{path}.{f.name}", getattr(one, f.name), getattr(other, f.name))
    elif isinstance(one, tuple):
        assert isinstance(other, tuple)
        assert len(one) == len(other), path
        for i, (a, b) in enumerate(zip(one, other, strict=True)):
            same(f"{path}[{i}]", a, b)
    else:
        assert one == other or (one != one and other != other), path


def check(data: bytes, game: str = "jk") -> Document:
    source = Source("x.jkl", data)
    fast, strict = read(source, game), read(source, game, strict_grammar=True)
    same("document", fast, strict)
    return fast


@pytest.mark.skipif(not CORPUS_FILES, reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize(("path", "data"), CORPUS_FILES, ids=[path for path, _ in CORPUS_FILES])
def test_real_levels(path: str, data: bytes) -> None:
    if len(data) > MOST_BYTES:
        pytest.skip("compared by make fuzz")
    check(data, "mots" if ".goo!" in path.lower() else "jk")


JUNK = [
    " ", "\t", ",", "+", "-", ".", "x", "0", "9", "e5", "1e39", "#", ";", ":", "=", "\x1c", "\xa0", "\r",
    "99999999999", "0x", "nan", "inf", " end", "world ", "sector 3", "\\",
]  # fmt: skip


def mutate(lines: list[str], random_: random.Random) -> None:
    """Do to one line what hands and tools do to files."""
    at = random_.randrange(len(lines))
    line = lines[at]
    place = random_.randrange(len(line) + 1)
    junk = random_.choice(JUNK)
    lines[at] = random_.choice(
        [
            line[:place] + junk + line[place:],
            line[:place] + line[place + 1 :],
            line[:place],
            " " + line,
            junk,
            line.upper(),
            line.replace(" ", ",", 1),
            line + "\n" + line,
            line + " \\",
            line.replace("0", "\u00b2", 1),
        ]
    )


@pytest.mark.skipif(not CORPUS_FILES, reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize("seed", range(3000 if FUZZ else 30))
def test_real_levels_with_random_faults(seed: int) -> None:
    random_ = random.Random(seed)
    small = [data for _, data in CORPUS_FILES if len(data) < 60_000]
    lines = random_.choice(small).decode("latin-1").split("\n")
    for _ in range(random_.choice([1, 5, 50])):
        mutate(lines, random_)
    check("\n".join(lines).encode("latin-1"), random_.choice(["jk", "mots"]))


@settings(max_examples=5000 if FUZZ else 150, deadline=None)
@given(st.randoms(use_true_random=False), st.integers(1, 12))
def test_the_two_rooms_with_random_faults(random_: random.Random, faults: int) -> None:
    lines = TWO_ROOMS.split("\n")
    for _ in range(faults):
        mutate(lines, random_)
    check("\n".join(lines).encode("latin-1"))


NUMBER = st.one_of(
    st.integers(-(10**11), 10**11).map(str),
    st.floats(allow_nan=False, allow_infinity=False, width=32).map(str),
    st.floats(-1e40, 1e40).map("{:.9g}".format),
    st.from_regex(r"[-+]?[0-9]{0,4}\.?[0-9]{0,4}([eE][-+]?[0-9]{1,3})?", fullmatch=True),
    st.sampled_from(
        ["", "-", ".", "-.", "1.", "+.5", "0x1f", "1e", "--1", "+-1", "nan", "1.#QNAN", "infinity", "\x1c1"]
    ),
)
WORDS = st.lists(NUMBER, max_size=8)


@settings(max_examples=10_000 if FUZZ else 300, deadline=None)
@given(st.lists(WORDS, max_size=8), st.sampled_from(["vertices", "texture vertices", "adjoins", "surfaces"]))
def test_generated_records(rows: list[list[str]], block: str) -> None:
    start = {"vertices": 0, "texture vertices": 1, "adjoins": 2, "surfaces": 3}[block]
    blocks = [["world vertices 0"], ["world texture vertices 0"], ["world adjoins 0"], ["world surfaces 0"]]
    head = " 0 0x4 4 4 3 1 -1 0 2" if block == "surfaces" else ""
    blocks[start] = [f"world {block} {len(rows)}", *(f"{i}:{head} " + " ".join(row) for i, row in enumerate(rows))]
    text = "\n".join(["section: georesource", "world colormaps 0", *(line for b in blocks for line in b)])
    check(text.encode("latin-1"))


def test_a_document_that_differs_is_noticed() -> None:
    one = read(Source("x.jkl", TWO_ROOMS.encode()))
    other = read(Source("x.jkl", TWO_ROOMS.replace("2: 1 1 0", "2: 1 1 -0").encode()))
    with pytest.raises(AssertionError, match=r"document\.vertices\.position"):
        same("document", one, other)
