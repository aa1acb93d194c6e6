"""The rules about who claims, carries and draws what, at their limits and with what they point at."""

from __future__ import annotations

import pytest

from jktools.linter import lint
from tests.support.levels import level_of, two_rooms
from tests.support.lint import findings, marked, messages


def test_a_run_of_unclaimed_surfaces_is_one_finding() -> None:
    assert messages("JK209", "Sector 1", "Surfaces 8 4") == [
        "surfaces 6 to 7 are claimed by no sector, but each surface must belong to one"
    ]
    assert messages("JK209", "Sector 0", "Surfaces 0 5", "Sector 1", "Surfaces 6 5") == [
        "surface 5 is claimed by no sector, but each surface must belong to one",
        "surface 11 is claimed by no sector, but each surface must belong to one",
    ]


def test_surfaces_of_a_sector_that_could_not_be_read_are_not_unclaimed() -> None:
    assert messages("JK209", "Sector 1", "Surfaces six 6") == []


def test_overlapping_claims_name_both_sectors() -> None:
    (message,) = messages("JK210", "Sector 0", "Surfaces 0 7")
    assert message == "sector 1 claims the surfaces 6 to 11, but sector 0 claims 0 to 6"
    assert marked("JK210", "Sector 0", "Surfaces 0 7") == ["Surfaces 6 6"]
    assert messages("JK210", "Sector 0", "Surfaces 6 6", "Sector 1", "Surfaces 0 6") == []


def test_an_adjoin_belongs_to_the_last_surface_that_names_it() -> None:
    (found,) = findings("JK211", "World surfaces 12", "4: 0 0x4 0x4 4 3 1 0 0 4 0,0 3,1 7,2 4,3 1 1 1 1")
    assert found.message == (
        "adjoin 0 is carried by 2 surfaces, but belongs to the last alone, surface 4 (sector 0, surface 4)"
    )
    assert [label.message for label in found.related] == ["surface 3"]


def test_a_mirror_needs_a_surface_only_where_the_adjoin_has_one() -> None:
    solid = [f"{i}: 0 0x4 0x4 4 3 1 -1 0 4 3,0 2,1 6,2 7,3 1 1 1 1" for i in (3, 8)]
    assert len(messages("JK212", "World surfaces 12", solid[1])) == 1
    assert messages("JK212", "World surfaces 12", *solid) == []


def test_an_adjoin_that_is_its_own_mirror() -> None:
    alone = (
        "World adjoins 1", "0: 0x7 0 1", "- 1: 0x7 0 1",
        "World surfaces 12", "8: 0 0x4 0x4 4 3 1 -1 0 4 3,0 7,1 6,2 2,3 1 1 1 1",
    )  # fmt: skip
    (message,) = messages("JK213", *alone)
    assert message == (
        "surface 3 (sector 0, surface 3) has adjoin 0, which leads to itself, but an adjoin must lead into another "
        "sector"
    )


def test_a_pair_that_does_not_name_each_other_is_one_fault() -> None:
    codes = {d.code.id for d in lint(level_of(two_rooms("World adjoins 2", "1: 0x7 1 1")))}
    assert codes == {"JK201"}


@pytest.mark.parametrize(("surfaces", "told"), [("6 3", True), ("6 4", False), ("6 0", True)])
def test_a_sector_has_at_least_four_surfaces(surfaces: str, told: bool) -> None:
    assert bool(messages("JK214", "Sector 1", f"Surfaces {surfaces}")) is told


def test_unlisted_and_stray_vertices() -> None:
    (message,) = messages("JK216", "Sector 1", "Vertices 6", "- 6: 10", "- 7: 6")
    assert message == (
        "surface 7 (sector 1, surface 1) uses vertex 6, but sector 1 does not list it; 1 more vertices are not listed"
    )
    (message,) = messages("JK217", "Sector 1", "- Surfaces 6 6", "Vertices 10", "8: 4", "9: 0", "Surfaces 6 6")
    assert message == "sector 1 lists vertex 4, but none of its surfaces uses it; 1 more are strays"
    assert marked("JK217", "Sector 1", "- Surfaces 6 6", "Vertices 9", "8: 4", "Surfaces 6 6") == ["4"]


def test_differing_flags_are_told_once_a_pair_and_only_on_demand() -> None:
    fragment = ("World adjoins 2", "1: 0x1 0 1")
    (message,) = messages("JK218", *fragment)
    assert message == "adjoin 0 has flags 0x7, but its mirror 1 has 0x1"
    assert lint(level_of(two_rooms(*fragment))) == []


SOLID = "1: {material} {flags} {face} {geometry} 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1"
OPEN = "3: {material} {flags} {face} {geometry} 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1"


def drawn(line: str, material: int = 0, flags: str = "0x4", face: str = "0x4", geometry: int = 4) -> tuple[str, str]:
    return "World surfaces 12", line.format(material=material, flags=flags, face=face, geometry=geometry)


@pytest.mark.parametrize(("code", "fragment", "told"), [
    ("JK219", drawn(SOLID, face="0x2"), True), ("JK219", drawn(SOLID, face="0x5"), False),
    ("JK219", drawn(OPEN, face="0x2"), False),
    ("JK220", drawn(SOLID, flags="0x1"), True), ("JK220", drawn(SOLID, flags="0x5"), False),
    ("JK220", drawn(SOLID, flags="0x0"), False), ("JK220", drawn(OPEN, flags="0x1"), False),
    ("JK221", drawn(SOLID, geometry=0), True), ("JK221", drawn(SOLID, geometry=2), True),
    ("JK221", drawn(SOLID, geometry=3), False), ("JK221", drawn(SOLID, geometry=5), False),
    ("JK221", drawn(OPEN, geometry=0), False), ("JK221", drawn(SOLID, geometry=0, material=-1), False),
    ("JK222", drawn(SOLID, material=-1, geometry=0), True), ("JK222", drawn(OPEN, material=-1, geometry=0), False),
    ("JK224", drawn(SOLID, flags="0x204"), True), ("JK224", drawn(SOLID, flags="0x404"), True),
    ("JK224", drawn(SOLID, flags="0x104"), False),
    ("JK225", drawn(OPEN, material=-1), True), ("JK225", drawn(OPEN, material=-1, geometry=0), False),
    ("JK225", drawn(SOLID, material=-1), False),
])  # fmt: skip
def test_which_surfaces_are_drawn(code: str, fragment: tuple[str, str], told: bool) -> None:
    assert bool(messages(code, *fragment)) is told


@pytest.mark.parametrize(("surface", "adjoin", "told"), [
    (drawn(OPEN, geometry=0), "0x6", True), (drawn(OPEN, face="0x2"), "0x6", True),
    (drawn(OPEN, face="0x4"), "0x6", False), (drawn(OPEN, geometry=0), "0x1", False),
])  # fmt: skip
def test_one_sees_through_only_what_is_visible(surface: tuple[str, str], adjoin: str, told: bool) -> None:
    found = findings("JK223", "World adjoins 2", f"0: {adjoin} 1 1", *surface)
    assert bool(found) is told
    if told:
        assert found[0].help == "set flags 0x7 on the adjoin, or draw the surface opaque"


def test_a_hidden_adjoin_is_told_once_a_pair() -> None:
    near, far = "3: 0 0x0 0x4 0 3 1 0 0 4 3,0 2,1 6,2 7,3 1 1 1 1", "8: 0 0x0 0x6 4 3 1 1 0 4 3,0 7,1 6,2 2,3 1 1 1 1"
    hidden = ("World adjoins 2", "0: 0x6 1 1", "1: 0x2 0 1", "World surfaces 12")
    (both,) = findings("JK223", *hidden, near, far)
    assert both.message == (
        "surface 3 (sector 0, surface 3) is not drawn and surface 8 (sector 1, surface 2) is translucent, but their "
        "adjoins 0 (flags 0x6) and 1 (flags 0x2) are not visible"
    )
    assert both.help == "set flags 0x7 on adjoin 0 and flags 0x3 on adjoin 1, or draw both surfaces opaque"
    assert [label.message for label in both.related] == ["adjoin 0", "adjoin 1", "surface 8"]
    (alike,) = messages("JK223", *hidden, near, far.replace("0x6 4", "0x4 0"))
    assert alike == (
        "surface 3 (sector 0, surface 3) and surface 8 (sector 1, surface 2) are not drawn, but their adjoins 0 (flags "
        "0x6) and 1 (flags 0x2) are not visible"
    )
    # Each side alone.
    assert messages("JK223", *hidden, far) == [
        "surface 8 (sector 1, surface 2) is translucent, but its adjoin 1 is not visible (flags 0x2)"
    ]
    one_way = ("World adjoins 2", "0: 0x1 1 1", "1: 0x2 0 1", "World surfaces 12")
    assert [m.partition(" (")[0] for m in messages("JK223", *one_way, near, far)] == ["surface 8"]
    # An adjoin whose mirror is another's is no pair.
    astray = ("World adjoins 2", "0: 0x6 0 1", "1: 0x2 0 1", "World surfaces 12")
    assert [m.partition(" (")[0] for m in messages("JK223", *astray, near, far)] == ["surface 3", "surface 8"]


def test_a_floor_says_which_flags_to_write() -> None:
    (found,) = findings("JK220", *drawn(SOLID, flags="0x81"))
    assert found.help == "set flags 0x85, or clear the floor flag"
