"""Broken files of every kind: nothing raises, and memory stays in proportion to the file."""

from __future__ import annotations

import random
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jktools.source import Source
from jktools.syntax.assets.reading import ASSET_EXTENSIONS, read_asset
from tests.support.assets import BLOCK, corpus_assets
from tests.support.levels import ROOT
from tests.syntax.assets.test_binary import cmp, mat, wav
from tests.syntax.assets.test_small import ALL

SEEDS: dict[str, bytes] = {
    **{extension: text.encode() for extension, text in ALL.items()},
    "3do": BLOCK.encode(),
    "mat": mat([(8, 3, 0), (0, 5)], [(16, 8, 1, 4)]),
    "cmp": cmp(1, True)[:2000],
    "wav": wav(samples=bytes(100)),
}


def test_every_kind_is_tried() -> None:
    assert set(SEEDS) == ASSET_EXTENSIONS


def mutated(data: bytes, chance: random.Random) -> bytes:
    out = bytearray(data)
    for _ in range(chance.randint(1, 6)):
        at = chance.randrange(len(out) + 1)
        kind = chance.randrange(5)
        if kind == 0:
            del out[at : at + chance.randint(1, 40)]
        elif kind == 1:
            out[at:at] = bytes(chance.choices(range(256), k=chance.randint(1, 8)))
        elif kind == 2:
            out[at : at + 4] = chance.choice(
                [b"\xff\xff\xff\xff", b"\0\0\0\0", b"\xff\xff\xff\x7f", b"-1 \n", b"999 ", b"1e99"]
            )
        elif kind == 3 and out:
            out[at % len(out)] ^= 1 << chance.randrange(8)
        else:
            first = chance.randrange(len(out) + 1)
            out[at:at] = out[first : first + chance.randint(1, 60)]
    return bytes(out)


@pytest.mark.parametrize("extension", sorted(SEEDS))
def test_nothing_raises(extension: str) -> None:
    chance = random.Random(extension)
    for _ in range(400):
        asset = read_asset(Source(f"x.{extension}", mutated(SEEDS[extension], chance)), extension)
        assert all(d.message for d in asset.diagnostics)


@given(st.binary(max_size=300), st.sampled_from(sorted(SEEDS)))
@settings(max_examples=300, deadline=None)
def test_nothing_raises_on_noise(data: bytes, extension: str) -> None:
    read_asset(Source(f"x.{extension}", data), extension)
    read_asset(Source(f"x.{extension}", SEEDS[extension][:40] + data), extension)


MEASURE = """
import random, sys, tracemalloc
sys.path.insert(0, {root!r})
from jktools.source import Source
from jktools.syntax.assets.reading import read_asset
from tests.syntax.assets.test_fuzz import LARGE, SEEDS, mutated
for extension in sorted(SEEDS):  # grammars are loaded once, whatever is read
    read_asset(Source("x", SEEDS[extension]), extension)
chance = random.Random(7)
for extension, make in sorted(LARGE.items()):
    for _ in range(4):
        data = make(chance)
        tracemalloc.start()
        read_asset(Source("x." + extension, data), extension)
        print(extension, len(data), tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
"""


def _lines(extension: str, line: str, count: int):  # type: ignore[no-untyped-def]
    """A large file: the small one with a line many times at a place of chance, then broken."""

    def make(chance: random.Random) -> bytes:
        lines = SEEDS[extension].decode().split("\n")
        at = chance.randrange(len(lines))
        return mutated("\n".join([*lines[:at], *[line] * count, *lines[at:]]).encode(), chance)

    return make


LARGE = {
    "3do": _lines("3do", "0: 0 0x0 4 3 1 0 4 0, 0 1, 1 2, 2 3, 3", 10_000),
    "key": _lines("key", "0: 0 0x1 0 0 0 0 0 0", 8_000),
    "par": _lines("par", "0: 0 0 .1 0", 15_000),
    "snd": _lines("snd", "create dooropen.wav 0x1 0.5 2.5 1.0", 8_000),
    "uni": _lines("uni", '"ONE" 0 "first of many"', 8_000),
    "mat": lambda chance: mutated(mat([(8, 3, 0)], [(1024, 1024, 1, 4)]), chance),
    "cmp": lambda chance: mutated(cmp(1, True, 900_000), chance),
    "wav": lambda chance: mutated(wav(samples=bytes(1_000_000)), chance),
}


def test_memory_stays_in_proportion() -> None:
    """No file of some hundred kilobytes takes more than ten times its size, whatever it claims to hold."""
    run = subprocess.run(
        [sys.executable, "-c", MEASURE.format(root=str(ROOT))], capture_output=True, text=True, check=False, cwd=ROOT
    )
    assert run.returncode == 0, run.stderr
    rows = [line.split() for line in run.stdout.splitlines()]
    assert len(rows) == 4 * len(LARGE)
    over = [(kind, int(size), int(peak)) for kind, size, peak in rows if int(peak) > 10 * int(size)]
    assert over == []


@pytest.mark.skipif(not list(corpus_assets("3do")), reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize("extension", ["3do", "mat"])
def test_broken_real_files(extension: str) -> None:
    chance = random.Random(extension)
    for path, data in corpus_assets(extension):
        if len(data) < 60_000:
            read_asset(Source(path, mutated(data, chance)), extension)
