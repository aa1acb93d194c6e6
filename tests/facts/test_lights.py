"""Lights on vertices: the engine's slope of 0.8 a JKU, worked out by hand in the two rooms."""

from __future__ import annotations

import pytest

from jktools.facts.lights import still_lights
from tests.support.levels import level_of, two_rooms


def lit(*lines: str) -> dict[int, float]:
    lights = still_lights(level_of(two_rooms("World templates 4", lines[0], "World things 4", *lines[1:])))
    return {int(v): float(a) for light in lights for v, a in zip(light.vertices, light.amounts, strict=True)}


def test_light_falls_by_its_slope_through_walls_and_rooms() -> None:
    # At vertex 0, (0, 0, 0): a light of 1 reaches 1.25 JKU, to its neighbours and not to the far corners.
    found = lit("lamp none type=cog light=1", "2: lamp lamp 0 0 0 0 0 0 0")
    assert found == pytest.approx({0: 1.0, 1: 0.2, 3: 0.2, 4: 0.2})


def test_a_light_ends_at_its_reach() -> None:
    assert lit("lamp none type=cog light=.79", "2: lamp lamp 0 0 0 0 0 0 0") == pytest.approx({0: 0.79})
    assert set(lit("lamp none type=cog light=.81", "2: lamp lamp 0 0 0 0 0 0 0")) == {0, 1, 3, 4}
    assert lit("lamp none type=cog light=.3", "2: lamp lamp .5 .5 .5 0 0 0 0") == {}


def test_what_moves_or_does_not_shine_is_no_still_light() -> None:
    line = "2: lamp lamp 0 0 0 0 0 0 0"
    assert lit("lamp none type=cog", line) == {}
    assert lit("lamp none type=cog light=1 move=physics", line) == {}
    assert lit("lamp none type=cog light=1 move=path", line) == {}


@pytest.mark.parametrize(("flags", "shines"), [
    ("thingflags=0x401", True), ("thingflags=0x400", False), ("thingflags=0x11", False), ("thingflags=0x80001", False),
])  # fmt: skip
def test_flags_can_put_a_light_out(flags: str, shines: bool) -> None:
    assert bool(lit(f"lamp none type=cog light=1 {flags}", "2: lamp lamp 0 0 0 0 0 0 0")) is shines


def test_a_thing_can_have_its_own_light() -> None:
    assert len(lit("lamp none type=cog light=1", "2: lamp lamp 0 0 0 0 0 0 0 light=.5")) == 1


def test_the_nearest_vertex_is_told() -> None:
    (light,) = still_lights(
        level_of(
            two_rooms(
                "World templates 4", "lamp none type=cog light=.1", "World things 4", "2: lamp lamp .3 0 .4 0 0 0 0"
            )
        )
    )
    assert (light.nearest, light.reach) == (pytest.approx(0.5), pytest.approx(0.125))
