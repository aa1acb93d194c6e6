from __future__ import annotations

import pytest

from jktools.model import Level
from tests.support.levels import TWO_ROOMS, level_of, two_rooms


@pytest.fixture
def level() -> Level:
    return level_of(TWO_ROOMS)


def test_adjoins_lead_from_surface_to_sector(level: Level) -> None:
    here, there = level.adjoins[0], level.adjoins[1]
    assert (here.surface, there.surface) == (level.surfaces[3], level.surfaces[8])
    assert (here.sector, there.sector) == (level.sectors[1], level.sectors[0])
    assert level.surfaces[3].adjoin == here
    assert level.surfaces[0].adjoin is None


def test_surfaces_are_named_as_editors_name_them(level: Level) -> None:
    assert level.surfaces[8].title == "surface 8 (sector 1, surface 2)"
    assert level_of(two_rooms("Sector 1", "Surfaces 6 0")).surfaces[8].title == "surface 8"


def test_what_points_nowhere_resolves_to_nothing() -> None:
    broken = level_of(two_rooms("World adjoins 2", "0: 0x7 7 1", "World things 3", "1: nothing x .5 1.5 .5 0 0 0 1"))
    assert broken.adjoins[0].sector is None
    assert broken.things[1].template is None
    assert broken.things[1].dropped is None
    assert not level_of(two_rooms("World vertices 12", "3: 0 x 0")).sound_sectors.any()


def test_the_last_surface_and_the_last_sector_win_as_in_the_engine() -> None:
    twice = level_of(two_rooms("World surfaces 12", "9: 0 0x4 0x4 4 3 1 0 0 4 9,0 8,1 10,2 11,3 1 1 1 1"))
    assert twice.adjoins[0].surface == twice.surfaces[9]
    both = level_of(two_rooms("Sector 1", "Surfaces 5 7"))
    assert both.surfaces[5].sector == both.sectors[1]


def test_the_first_template_of_a_name_wins() -> None:
    text = two_rooms("World templates 4", "CRATE none type=item").replace("crate none", "crate none")
    level = level_of(text.replace("CRATE none type=item", "crate none type=cog\nCrate none type=item"))
    dropped = [t.dropped for t in level.templates]
    assert dropped[:3] == [None, None, None]
    assert dropped[3] == "template 2 has the same name and comes first"
    assert level.template_by_name["crate"] == 2


def test_only_a_template_that_stands_before_is_a_parent() -> None:
    level = level_of(two_rooms("World templates 3", "ghost crate type=ghost", "crate ghost type=cog"))
    assert level.templates[1].parent is None
    assert level.templates[2].parent == level.templates[1]


def test_records_are_sequences_of_views(level: Level) -> None:
    assert level.sectors[-1] == level.sectors[1]
    assert [s.index for s in level.surfaces[2:4]] == [2, 3]
    with pytest.raises(IndexError):
        _ = level.sectors[2]
    assert len({level.sectors[0], level.sectors[0], level.sectors[1]}) == 2


def test_a_thing_in_no_sector_is_dropped() -> None:
    level = level_of(two_rooms("World things 3", "1: ghost ghost .5 1.5 .5 0 0 0 -1"))
    assert level.things[1].dropped == "sector -1 does not exist"
