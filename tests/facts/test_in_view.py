"""What a frame takes in, in the two rooms and by hand: sectors, translucent surfaces, lights.

The rooms are cubes of one JKU, sector 0 at y 0 to 1 and sector 1 at y 1 to 2. As written the two sides of the adjoin
between them are drawn and opaque, so that nothing is drawn behind them.
"""

from __future__ import annotations

import struct
import sys
from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest

from jktools.facts import LevelFacts
from jktools.facts.camera import Camera, Frame, _around, _before, _inside, _window
from jktools.facts.in_view import Counted
from jktools.linter import find_rule, lint
from jktools.session import load
from tests.support.levels import level_of, level_with_files, two_rooms

MIDDLE, NEXT = (0.5, 0.5, 0.5), (0.5, 1.5, 0.5)
NORTH, SOUTH = 0, 180
OPEN = ("World surfaces 12", "3: -1 0x0 0x4 0 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1")
GLASS = ("World surfaces 12", "3: 0 0x0 0x2 4 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1")
APART = ("World adjoins 2", "0: 0x6 1 1", "1: 0x6 0 1")


def camera(*lines: str) -> Camera:
    return Camera(level_of(two_rooms(*lines)))


@pytest.mark.parametrize(("lines", "yaw", "sectors"), [
    (OPEN, NORTH, 2), (OPEN, SOUTH, 1), (OPEN, 90, 1), (OPEN, 44, 2), (OPEN, 91, 1),
    (GLASS, NORTH, 2), ((), NORTH, 1), ((*OPEN, *APART), NORTH, 1), ((*GLASS, *APART), NORTH, 1),
])  # fmt: skip
def test_an_adjoin_shows_what_lies_behind_when_it_is_visible_and_not_opaque(
    lines: Sequence[str], yaw: int, sectors: int
) -> None:
    assert camera(*lines).frame(0, MIDDLE, yaw).sectors == sectors


def test_each_side_of_an_adjoin_is_a_surface_of_its_own() -> None:
    """Only the side of sector 0 is open."""
    assert camera(*OPEN).frame(1, NEXT, SOUTH).sectors == 1
    assert camera(*OPEN).frame(1, NEXT, NORTH).sectors == 1


@pytest.mark.parametrize("transparent", [True, False])
def test_a_texture_with_holes_shows_what_lies_behind(transparent: bool, tmp_path: Path) -> None:
    header = struct.pack("<4s4I14I", b"MAT ", 0x32, 2, 1, 1, 0, 8, *[0] * 12)
    cel = struct.pack("<10I", 8, *[0] * 9)
    texture = struct.pack("<6I", 8, 8, int(transparent), 0, 0, 1) + bytes(64)
    (tmp_path / "jkl").mkdir()
    (tmp_path / "mat").mkdir()
    place = tmp_path / "jkl/rooms.jkl"
    place.write_text(two_rooms())
    for name in load(str(place)).materials:
        (tmp_path / "mat" / name).write_bytes(header + cel + texture)
    found = Camera(load(str(place))).frame(0, MIDDLE, NORTH)
    assert found == (Frame(2, 1, 0) if transparent else Frame(1, 0, 0))


def test_the_rectangle_around_an_adjoin_lets_more_through_than_the_adjoin() -> None:
    """A triangle one JKU ahead: what is left is the rectangle around its corners, cut to the screen."""
    screen = (-1.0, 1.0, -0.75, 0.75)
    assert _window(_before([(-0.5, 1, -0.5), (0.5, 1, -0.5), (0, 1, 0.5)]), screen) == (-0.5, 0.5, -0.5, 0.5)
    assert _window(_before([(-2, 2, 0), (6, 2, 0), (6, 2, 3)]), screen) == (-1, 1, 0, 0.75)
    assert _window(_before([(-0.5, -1, -0.5), (0.5, -1, -0.5), (0, -1, 0.5)]), screen) is None
    assert _window(_before([(3, 1, 0), (4, 1, 0), (4, 1, 0.5)]), screen) is None
    # A pixel of 640 is 1/320 at the distance 1.
    assert _window(_before([(0, 1, 0), (0.0032, 1, 0), (0, 1, 0.5)]), screen) is not None
    assert _window(_before([(0, 1, 0), (0.0031, 1, 0), (0, 1, 0.5)]), screen) is None


def test_a_window_is_what_clipping_alone_would_leave() -> None:
    random = Random(1997)
    kinds = set()
    for _ in range(2000):
        shape = _before([(random.uniform(-2, 2), random.uniform(-0.2, 2), random.uniform(-2, 2)) for _ in range(3)])
        left, right = sorted((random.uniform(-1, 1), random.uniform(-1, 1)))
        bottom, top = sorted((random.uniform(-0.75, 0.75), random.uniform(-0.75, 0.75)))
        clipped = _inside(shape.corners, (left, right, bottom, top))
        whole = _around(clipped) if len(clipped) >= 3 else None
        found = _window(shape, (left, right, bottom, top))
        if found is None:
            assert whole is None or min(whole[1] - whole[0], whole[3] - whole[2]) < 2 / 640
        else:
            assert found == pytest.approx(whole)
        kinds.add((found is None, clipped == shape.corners))
    assert len(kinds) >= 3


def test_translucent_surfaces_count_where_they_are_adjoined_drawn_and_face_the_camera() -> None:
    both = (*GLASS, "8: 0 0x0 0x2 4 3 1 1 0 4 3,0 7,1 6,2 2,3 1 1 1 1")
    assert camera(*GLASS).frame(0, MIDDLE, NORTH).translucent == 1
    # The other side faces the other way.
    assert camera(*both).frame(0, MIDDLE, NORTH).translucent == 1
    # On the screen or not.
    assert camera(*GLASS).frame(0, MIDDLE, SOUTH).translucent == 1
    assert camera(*OPEN).frame(0, MIDDLE, NORTH).translucent == 0
    undrawn = ("World surfaces 12", "3: 0 0x0 0x2 0 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1")
    assert camera(*undrawn).frame(0, MIDDLE, NORTH) == Frame(2, 0, 0)
    wall = ("World surfaces 12", "9: 0 0x4 0x2 4 3 1 -1 0 4 9,0 8,1 10,2 11,3 1 1 1 1")
    assert camera(*wall).frame(1, NEXT, NORTH).translucent == 0


def lit(template: str, *lines: str) -> int:
    placed = ("World templates 4", f"lamp none {template}", "World things 4", "2: lamp lamp .5 1.5 .5 0 0 0 1")
    return camera(*lines, *placed).frame(0, MIDDLE, SOUTH).lights


@pytest.mark.parametrize(("template", "lights"), [
    ("type=cog light=1", 1), ("type=cog light=0", 0), ("type=cog", 0), ("type=cog light=1 thingflags=0x400", 0),
    ("type=cog light=1 thingflags=0x11", 0), ("type=cog light=1 thingflags=0x80001", 0),
    ("type=cog lightintensity=1", 0), ("type=actor lightintensity=1", 0),
    ("type=actor lightintensity=1 typeflags=0x4", 1), ("type=actor light=1 lightintensity=1 typeflags=0x4", 2),
    ("type=actor light=1 lightintensity=1", 1),
])  # fmt: skip
def test_what_is_a_light(template: str, lights: int) -> None:
    assert lit(template) == lights


def test_lights_beside_a_frame_shine_into_it_through_visible_adjoins() -> None:
    """Seen or not, drawn opaque or not."""
    assert lit("type=cog light=1") == 1
    assert lit("type=cog light=1", *APART) == 0


def lamps(count: int, sector: int = 1) -> Sequence[str]:
    things = (f"{i}: lamp lamp .5 {sector}.5 .5 0 0 0 {sector}" for i in range(5, 5 + count))
    return ("World templates 4", "lamp none type=cog light=1", "World things 90", *things)


@pytest.mark.parametrize(("count", "told"), [(32, False), (33, True)])
def test_the_33rd_light_is_one_too_many(count: int, told: bool) -> None:
    found = lint(level_of(two_rooms(*lamps(count), *APART)), [find_rule("JK832")])
    assert [d.message for d in found] == [
        "a look from (0.5, 1.5, 0.5) in sector 1, north, takes in 33 lights, but the engine takes 32"
    ] * told


@pytest.mark.parametrize(("item", "lines", "held", "sector"), [
    (Counted.SECTORS, OPEN, 2, 0), (Counted.TRANSLUCENT, GLASS, 1, 0), (Counted.LIGHTS, (*lamps(3), *APART), 3, 1),
])  # fmt: skip
def test_the_fullest_frame(item: Counted, lines: Sequence[str], held: int, sector: int) -> None:
    facts = LevelFacts(level_of(two_rooms(*lines)))
    found = facts.fullest_frame(item, held - 1)
    assert found is not None
    assert (found.held, found.sector) == (held, sector)
    assert facts.fullest_frame(item, held) is None


BOTH_GLASS = (*GLASS, "8: 0 0x0 0x2 4 3 1 1 0 4 3,0 7,1 6,2 2,3 1 1 1 1")


@pytest.mark.parametrize(("code", "lines", "message"), [
    ("JK830", OPEN, "takes in 2 sectors, but the engine draws 1"), ("JK830", (), None),
    ("JK831", BOTH_GLASS, None), ("JK831", GLASS, None),
])  # fmt: skip
def test_rules_on_frames(code: str, lines: Sequence[str], message: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    rule = find_rule(code)
    monkeypatch.setattr(sys.modules[rule.check.__module__], "MOST", 1)
    found = [d.message for d in lint(level_of(two_rooms(*lines)), [rule])]
    assert found == ([] if message is None else [f"a look from (0.5, 0.5, 0.5) in sector 0, north, {message}"])


def test_translucent_surfaces_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    rule = find_rule("JK831")
    monkeypatch.setattr(sys.modules[rule.check.__module__], "MOST", 0)
    (found,) = lint(level_of(two_rooms(*GLASS)), [rule])
    assert found.message.endswith("takes in 1 translucent surfaces, but the engine draws 0")


def test_a_file_without_sectors_has_nothing_in_view() -> None:
    level = level_of("SECTION: TEMPLATES\nWorld templates 1\nghost none type=ghost\nend\n")
    codes = [
        each.code.id
        for code in ("JK830", "JK831", "JK832", "JK226", "JK227")
        for each in lint(level, [find_rule(code)])
    ]
    assert codes == []


def test_a_level_with_broken_sectors_is_looked_at_where_it_is_sound() -> None:
    with level_with_files("Sector 1", "Surfaces 6 99", *OPEN, "== cog/none.cog") as level:
        assert Camera(level).frame(0, MIDDLE, NORTH).sectors >= 1
