"""The rules about what names something, with what they point at."""

from __future__ import annotations

import pytest

from tests.support.lint import findings, marked, messages


@pytest.mark.parametrize(("material", "told"), [("0", False), ("1", True), ("-1", False), ("-7", False)])
def test_a_material_must_be_in_the_list_or_below_0(material: str, told: bool) -> None:
    surface = ("World surfaces 12", f"1: {material} 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1")
    assert marked("JK101", *surface) == ([material] if told else [])


def test_what_there_is_is_told() -> None:
    (message,) = messages("JK101", "World surfaces 12", "1: 3 0x4 0x4 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1")
    assert message == "surface 1 (sector 0, surface 1) has material 3, but the level has material 0 alone"
    none = messages("JK101", "World materials 1", "- 0: wall.mat 1 1")
    assert len(none) == 12
    assert none[0].endswith("has material 0, but the level has no materials")


def test_a_surface_that_could_not_be_read_has_no_material() -> None:
    broken = ("World materials 1", "- 0: wall.mat 1 1", "World surfaces 12", "1: 0 0x4 0x4 4 3 1 -1")
    assert not any(m.startswith("surface 1 ") for m in messages("JK101", *broken))


def test_a_colormap_must_exist() -> None:
    (message,) = messages("JK102", "Sector 1", "Colormap 1")
    assert message == "sector 1 has colormap 1, but the level has colormap 0 alone"
    assert marked("JK102", "Sector 0", "Colormap -1") == ["-1"]


def test_a_misspelt_template_is_named() -> None:
    (found,) = findings("JK103", "World things 3", "1: Gohst ghost .5 1.5 .5 0 90 0 1")
    assert found.message == 'thing 1 (Gohst) names template "Gohst", but the level defines none of that name'
    assert found.help == 'did you mean "ghost"?'
    (found,) = findings("JK103", "World things 3", "1: +flash ghost .5 1.5 .5 0 90 0 1")
    assert found.help == "define the template, unless the game's static.jkl has it"


def test_a_parent_is_unknown_later_or_itself() -> None:
    assert messages("JK104", "World templates 4", "a b type=cog") == [
        'template 3 (a) has the parent "b", but the level defines no such template'
    ]
    later = ("World templates 5", "a b size=1", "b none type=cog")
    assert messages("JK105", *later) == ["template 3 (a) has the parent b, but that stands below, as template 4"]
    assert messages("JK104", *later) == []
    itself = ("World templates 4", "a A type=cog")
    assert messages("JK105", *itself) == ["template 3 (a) is its own parent, but a parent must stand above"]
    assert messages("JK104", *itself) == []


@pytest.mark.parametrize("key", ["creatething", "explode", "weapon", "weapon2", "debris", "trailthing", "fleshhit"])
def test_parameters_name_templates_above(key: str) -> None:
    later = ("World templates 5", f"a none type=weapon {key}=b", "b none type=explosion")
    assert messages("JK106", *later) == [f"template 3 (a) has {key}=b, but b stands below, as template 4"]
    assert messages("JK107", *later) == []
    (message,) = messages("JK107", "World templates 4", f"a none type=weapon {key}=c")
    assert message == f"template 3 (a) has {key}=c, but the level defines no template of that name"
    assert messages("JK106", "World templates 5", "b none type=explosion", f"a none type=weapon {key}=b") == []


def test_things_may_name_any_template_of_the_level() -> None:
    line = "1: ghost ghost .5 1.5 .5 0 90 0 1 creatething="
    assert messages("JK107", "World things 3", line + "crate") == []
    assert messages("JK107", "World things 3", line + "none") == []
    assert len(messages("JK107", "World things 3", line + "crates_of_gold")) == 1
