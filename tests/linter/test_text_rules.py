"""The rules about text, at their limits and with what they point at."""

from __future__ import annotations

import pytest

from tests.support.lint import findings, marked, messages


def template(fields: int) -> tuple[str, str]:
    """A template line of so many fields, two of which are its name and parent."""
    return "World templates 4", "long none " + " ".join("a" * (fields - 2))


@pytest.mark.parametrize(("fields", "game", "told"), [
    (128, "jk", False), (129, "jk", True), (129, "mots", False), (256, "mots", False), (257, "mots", True),
])  # fmt: skip
def test_a_line_has_at_most_128_fields_or_256(fields: int, game: str, told: bool) -> None:
    found = findings("JK011", *template(fields), game=game)
    assert bool(found) is told
    if told:
        assert found[0].message == f"the line has {fields} fields, but the engine takes at most {fields - 1}"


def test_commas_separate_fields_too() -> None:
    assert messages("JK011", "World templates 4", "long none " + "a," * 127)
    assert messages("JK011", "World templates 4", "long none " + "a," * 126) == []


def test_a_name_has_at_most_31_characters() -> None:
    assert messages("JK012", "World materials 2", f"1: {'m' * 27}.mat 1 1") == []
    (message,) = messages("JK012", "World materials 2", f"1: {'m' * 28}.mat 1 1")
    assert message == f'material 1 has the name "{"m" * 28}.mat" of 32 characters, but the engine keeps 31'


@pytest.mark.parametrize(("fragment", "start"), [
    (("World templates 4", f"{'t' * 32} none type=cog"), "template 3"),
    (("World things 3", f"1: ghost {'g' * 32} .5 1.5 .5 0 90 0 1"), "thing 1"),
    (("World cogs 1", f"0: door.cog 3 -1 {'w' * 32}"), "cog 0"),
    (("World cogs 1", f"0: {'d' * 32} 3 -1 wind.wav"), "cog 0"),
    (("Sector 1", f"Sound {'s' * 32} .5"), "sector 1"),
])  # fmt: skip
def test_names_of_every_kind_are_measured(fragment: tuple[str, ...], start: str) -> None:
    (message,) = messages("JK012", *fragment)
    assert message.startswith(f"{start} has the name ")


def test_a_long_value_of_a_cog_is_marked_itself() -> None:
    assert marked("JK012", "World cogs 1", f"0: door.cog 3 -1 {'w' * 32}") == ["w" * 32]


@pytest.mark.parametrize(("flags", "told"), [
    ("7", False), ("9", False), ("10", True), ("0x10", False), ("0X10", False), ("4a4f", False), ("0", False),
])  # fmt: skip
def test_flags_of_two_decimal_digits_look_decimal(flags: str, told: bool) -> None:
    assert bool(messages("JK013", "World adjoins 2", f"0: {flags} 1 1")) is told


def test_both_readings_of_flags_are_offered() -> None:
    (found,) = findings("JK013", "World templates 4", "lamp none type=cog thingflags=1024")
    assert found.message == "the thingflags of template 3 are written 1024, but the engine reads 0x1024"
    assert found.help == "write 0x400 if the number is decimal, 0x1024 if it is not"  # 1024 is 4 * 16^2
    assert found.label.span is not None
    assert found.label.span.text == "1024"


def test_every_kind_of_flags_is_looked_at() -> None:
    surface = ("World surfaces 12", "1: 0 16 17 4 3 1 -1 0 4 4,0 7,1 6,2 5,3 1 1 1 1")
    assert marked("JK013", *surface) == ["16", "17"]
    assert marked("JK013", "Sector 1", "Flags 64") == ["64"]
    assert marked("JK013", "World things 3", "1: ghost ghost .5 1.5 .5 0 90 0 1 typeflags=20") == ["20"]


def test_a_level_with_bare_hexadecimal_flags_means_them_all_so() -> None:
    assert messages("JK013", "World adjoins 2", "0: 1f 1 1", "1: 10 0 1") == []


def test_the_first_wrong_label_is_told_and_the_rest_counted() -> None:
    # A label left out shifts all that follow: 2 is labelled 3, 3 is labelled 4.
    (found,) = findings("JK014", "World texture vertices 4", "- 2: 64 64", "- 3: 0 64", "3: 64 64", "4: 0 64")
    assert found.message == (
        "the texture vertex at position 2 is labelled 3, but the engine counts from 0 and calls it 2; 1 more texture "
        "vertex labels differ"
    )
    assert found.label.span is not None
    assert found.label.span.text == "3"


def test_labels_of_things_are_numbers_and_not_places() -> None:
    assert messages("JK014", "World things 3", "- 1: ghost ghost .5 1.5 .5 0 90 0 1", "2: ghost g 1 1 1 0 0 0 1") == []
