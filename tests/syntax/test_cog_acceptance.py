"""The front end takes and refuses the scripts that the engine does, at the same place, as another reading tells it."""

from __future__ import annotations

import random

import pytest

from tests.support.cog_twin import read
from tests.support.scripts import PIECES, corpus_scripts, mutated, script_of, whole

SCRIPTS = list(corpus_scripts())
needs_corpus = pytest.mark.skipif(not SCRIPTS, reason="the corpus of real mods is not at hand")


def stop(text: str) -> int | None:
    script = script_of(text)
    refused = [d for d in script.faults if d.code.id == "JK050"]
    assert len(refused) == (1 if script.faults else 0)
    assert len(script.faults) != 1, "a refused script tells at least one place"
    if not refused:
        return None
    assert refused[0].label.span is not None
    return refused[0].label.span.start


@needs_corpus
@pytest.mark.parametrize(("path", "data"), SCRIPTS, ids=[path for path, _ in SCRIPTS])
def test_every_script_of_the_corpus_is_taken(path: str, data: bytes) -> None:
    text = data.decode("latin-1")
    assert read(text).stop is None
    assert stop(text) is None


@needs_corpus
@pytest.mark.parametrize("seed", range(12))
def test_mutated_scripts_are_judged_alike(seed: int) -> None:
    rng = random.Random(seed)
    refused = 0
    for path, data in SCRIPTS:
        for _ in range(4):
            text = mutated(data.decode("latin-1"), rng)
            expected = read(text).stop
            assert stop(text) == expected, (path, text)
            refused += expected is not None
    assert refused > len(SCRIPTS)  # the mutations do break scripts


def test_random_tokens_are_judged_alike() -> None:
    rng = random.Random(0)
    taken = 0
    for _ in range(3000):
        text = whole(" ".join(rng.choices(PIECES, k=rng.randint(1, 12))))
        expected = read(text).stop
        assert stop(text) == expected, text
        taken += expected is None
    assert taken > 20


OPERANDS = ["x", "1", "-x", "!x", "f(x, 1)", "f()", "a[1]", "(x + 1)", "(x, y)", "f(x)(1)[2]", "(f)(x)", "- -x"]
OPERATORS = ["=", "=", ",", "+", "-", "*", "%", "&&", "||", "==", "!=", "<", "|", "^", "&"]
STATEMENTS = ["{};", "if ({}) x;", "while ({}) {{ }}", "for ({}; x; {}) x;", "do x; while ({});", "l: {};"]


def test_random_expressions_are_judged_alike() -> None:
    rng = random.Random(0)
    taken = 0
    for _ in range(4000):
        words = [rng.choice(OPERANDS)]
        for _ in range(rng.randint(0, 4)):
            words += [rng.choice(OPERATORS), rng.choice(OPERANDS)]
        if rng.random() < 0.3:
            words[rng.randrange(len(words))] = rng.choice([*OPERATORS, ")", "(", "]", "", "!", ";", "1"])
        shape = rng.choice(STATEMENTS)
        text = whole(shape.format(*[" ".join(words)] * shape.count("{}")))
        expected = read(text).stop
        assert stop(text) == expected, text
        taken += expected is None
    assert 1000 < taken < 3000
