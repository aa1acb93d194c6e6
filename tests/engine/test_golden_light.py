"""Every value of golden.toml on colour, light, particles and sight is held by a check or stated as open."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.engine import golden_colour, golden_dynamic_light, golden_particles
from tests.engine.test_mutation_light import MUTATIONS

SECTIONS = ("color", "ir_mode", "dynamic_light", "particles", "sight")
CHECKS = {**golden_colour.CHECKS, **golden_dynamic_light.CHECKS, **golden_particles.CHECKS}
OPEN = golden_dynamic_light.OPEN
GIVEN = golden_dynamic_light.GIVEN
DOCS = Path(__file__).parents[2] / "docs/engine.md"


def leaves(value: Any, key: str) -> Iterator[str]:
    """The keys of all values, lists of tables and of pixels by index."""
    if isinstance(value, dict):
        for name, below in value.items():
            yield from leaves(below, f"{key}.{name}")
    elif isinstance(value, list) and (isinstance(value[0], dict) or key.endswith((".pixel", ".predicted"))):
        for i, below in enumerate(value):
            yield from leaves(below, f"{key}[{i}]")
    else:
        yield key


def holds(key: str, leaf: str) -> bool:
    return leaf == key or leaf.startswith((key + ".", key + "["))


@pytest.mark.parametrize("key", [*CHECKS, *OPEN])
def test_value(key: str, golden: dict[str, Any]) -> None:
    {**CHECKS, **OPEN}[key](golden)


def test_each_value_is_held_or_open(golden: dict[str, Any]) -> None:
    known = {*CHECKS, *OPEN, *GIVEN, *golden_particles.STATEMENTS}
    found = [leaf for section in SECTIONS for leaf in leaves(golden[section], section)]
    assert len(found) > 100
    assert [leaf for leaf in found if not any(holds(key, leaf) for key in known)] == []
    assert [key for key in known if not any(holds(key, leaf) for leaf in found)] == []
    assert set(GIVEN.values()) <= set(CHECKS)


def test_each_check_is_mutated() -> None:
    assert {key for mutation in MUTATIONS for key in mutation.keys} == {*CHECKS, *OPEN}


@pytest.mark.parametrize("key", [*OPEN, *golden_particles.STATEMENTS])
def test_the_docs_tell_what_is_open(key: str) -> None:
    assert f"`{key}`" in DOCS.read_text()


def test_290_is_the_maximum_but_not_the_slope(golden: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the document contradicts itself: with 290 as the slope its own samples miss by one 565 step."""
    monkeypatch.setattr("jktools.engine.colour.FULL_ADD", float(golden["color"]["max_add"]))
    missed = {}
    for i, case in enumerate(golden["color"]["sample"]):
        effect = golden_colour.ColourEffect.from_call(case["effect"])
        got = golden_colour.drawn(effect, case["input"], golden_colour.Depth.RGB565)
        if got != case["output"]:
            missed[i] = [a - b for a, b in zip(got, case["output"], strict=True)]
    assert missed == {1: [0, -4, 0], 2: [0, 0, 9], 3: [-9, -4, 0]}


@pytest.mark.parametrize(("full", "meets"), [(280.0, False), (280.1, True), (285.7, True), (285.8, False)])
def test_the_interval_of_the_add(
    full: float, meets: bool, golden: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("jktools.engine.colour.FULL_ADD", full)
    samples = [golden_colour.sample(i) for i in (1, 2, 3)]
    assert all(passes(check, golden) for check in samples) is meets


def passes(check: golden_colour.Check, golden: dict[str, Any]) -> bool:
    try:
        check(golden)
    except AssertionError:
        return False
    return True
