"""What differs between two levels, by edits of which the difference is known."""

from __future__ import annotations

import math

import pytest

from fixtures.rooms import Level as Builder
from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.compiler.comparison import Difference, FieldChange, compare
from jktools.compiler.comparison import _match as match
from jktools.compiler.records import Records
from jktools.emit.difference import text
from jktools.model import Level
from tests.compiler.test_scene_sections import LAMP
from tests.support.levels import TWO_ROOMS, level_of, level_with_files, two_rooms


def compiled(level: Level | str, **settings: object) -> CompiledLevel:
    found = level if isinstance(level, Level) else level_of(level)
    return CompiledLevel(compile_level(found, CompileSettings(**settings)))  # type: ignore[arg-type]


def difference(*fragment: str) -> list[Difference]:
    return compare(compiled(TWO_ROOMS), compiled(two_rooms(*fragment)))


def brief(found: list[Difference]) -> list[tuple[str, str, int | None, int | None, list[str]]]:
    return [(each.kind, each.change, each.before, each.after, [f.field for f in each.fields]) for each in found]


def test_a_level_is_itself() -> None:
    assert compare(compiled(TWO_ROOMS), compiled(TWO_ROOMS)) == []
    assert compare(compiled("# by hand\n" + TWO_ROOMS), compiled(TWO_ROOMS)) == [], "a comment is no content"


def test_a_vertex_that_moves() -> None:
    found = difference("World vertices 12", "0: 0 0 -0.5")
    vertex = found[0]
    assert (vertex.section, vertex.kind, vertex.change, vertex.before, vertex.after) == (
        "geometry", "vertex", "changed", 0, 0,
    )  # fmt: skip
    assert vertex.fields == (("position", (0, 0, 0), (0, 0, -0.5)),)
    assert {each.section for each in found} <= {"geometry", "visibility", "ledges", "basins"}
    assert [each for each in found if each.kind in ("surface", "sector", "adjoin")] == [], "they name the same vertices"


def test_surfaces_adjoins_and_what_follows() -> None:
    alone = ("World cogs 0", "- 0: door.cog 3 -1 wind.wav")  # a script that is not at hand may open the adjoin
    closed = two_rooms(*alone, "World adjoins 2", "0: 0x6 1 1", "1: 0x6 0 1")
    found = compare(compiled(two_rooms(*alone)), compiled(closed))
    assert brief(found)[:2] == [("adjoin", "changed", 0, 0, ["flags"]), ("adjoin", "changed", 1, 1, ["flags"])]
    views = [each for each in found if each.kind == "view"]
    assert [(each.before, each.fields) for each in views] == [
        (0, (("lost", [1], []),)), (1, (("lost", [0], []),)),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("fragment", "kind", "field", "before", "after"),
    [
        (("World surfaces 12", "2: 0 0x5 0 4 3 1 -1 0 4 1,0 2,1 6,2 5,3 1 1 1 1"), "surface", "flags", 4, 5),
        (("Sector 0", "Ambient Light .25"), "sector", "ambient_light", 0.5, 0.25),
        (("World templates 3", "ghost none type=ghost size=.5"), "template", "values", None, None),
        (("World cogs 1", "0: lift.cog 3 -1 wind.wav"), "cog", "script", "door.cog", "lift.cog"),
    ],
)  # fmt: skip
def test_one_field(fragment: tuple[str, ...], kind: str, field: str, before: object, after: object) -> None:
    found = [each for each in difference(*fragment) if each.kind == kind]
    assert len(found) == 1
    changes = {change.field: change for change in found[0].fields}
    assert field in changes
    if before is not None:
        assert (changes[field].before, changes[field].after) == (before, after)


def test_a_header_line() -> None:
    found = compare(compiled(TWO_ROOMS), compiled(TWO_ROOMS.replace("World Gravity 4", "World Gravity 3.5")))
    assert brief(found)[0] == ("header", "changed", 0, 0, ["gravity"])
    assert found[0].fields == (("gravity", 4.0, 3.5),)


def rooms(*corners: float) -> str:
    builder = Builder("rooms")
    for at in corners:
        builder.room((at, 0, 0), (at + 2, 2, 2))
    return builder.text()


def test_where_counts_differ_records_are_found_by_content() -> None:
    found = compare(compiled(rooms(0, 10)), compiled(rooms(5, 0, 10)))
    kinds = [(kind, change) for kind, change, *_ in brief(found)]
    assert kinds.count(("vertex", "added")) == 8
    assert kinds.count(("surface", "added")) == 6
    assert kinds.count(("sector", "added")) == 1
    assert {change for kind, change in kinds if kind in ("vertex", "surface", "sector", "view")} == {"added"}
    back = compare(compiled(rooms(5, 0, 10)), compiled(rooms(0, 10)))
    assert [each.change for each in back if each.kind == "surface"] == ["removed"] * 6
    assert [each.before for each in back if each.kind == "sector"] == [0]


def test_between_equal_neighbours_others_are_taken_for_the_same() -> None:
    found = compare(compiled(rooms(0, 10, 20)), compiled(rooms(0, 11, 20, 30)))
    sectors = [each for each in found if each.kind == "sector"]
    assert [(each.change, each.before, each.after) for each in sectors] == [("changed", 1, 1), ("added", None, 3)]


def test_each_record_is_matched_once_where_records_changed_places() -> None:
    before = ("a", "x1", "x2", "x3", "x4", "b", "c", "y1", "y2", "y3", "y4", "d")
    after = ("a", "c", "q", "r", "s", "b", "d")
    first, second = (Records("resources", "sound", range(len(each)), each, each, {}) for each in (before, after))
    found = match(first, second)
    assert [b for _, b in found.pairs] == [*range(len(after))], "each once"
    assert len({a for a, _ in found.pairs}) == len(after)
    assert len(found.removed) == len(before) - len(after)


def interval(**changes: object) -> dict[str, object]:
    return {"from": 0.0, "to": 1.0, "kind": "wall", "below": 39, "drop": [math.nan, math.nan], "traits": 2} | changes


@pytest.mark.parametrize(
    ("before", "after", "told"),
    [
        (interval(), interval(kind="jump"), "wall 0..1 -> jump 0..1"),
        (interval(), interval(below=43), "wall 0..1: below 39 -> 43"),
        (interval(), interval(to=0.99999994), "wall 0..1: to 1 -> 0.99999994"),
        (interval(drop=[1.0, 2.0]), interval(drop=[1.0, 3.0], traits=0),
         "wall 0..1 (1 JKU): drop (1, 2) -> (1, 3), traits 2 -> 0"),
    ],
)  # fmt: skip
def test_what_differs_in_a_ledge_is_told(before: dict[str, object], after: dict[str, object], told: str) -> None:
    same = interval(kind="step")
    change = FieldChange("intervals", [same, before], [same, after])
    shown = list(text(("a", "b"), [Difference("ledges", "edge", "changed", 7, 7, "corner 1", (change,))]))
    assert shown[-1].removeprefix("  edge of surface 7 (corner 1): ").replace("step 0..1, ", "") == told


def test_an_edge_of_a_thing_is_none_of_a_surface() -> None:
    of_thing = Difference("ledges", "edge", "removed", -1, None, "thing 7, face 2, corner 1")
    assert list(text(("a", "b"), [of_thing]))[-1] == "  edge (thing 7, face 2, corner 1): removed"


def test_a_thing_that_is_added() -> None:
    found = difference("World things 3", "7: ghost third .5 .5 .5 0 0 0 0")
    assert brief(found) == [("thing", "added", None, 2, [])]
    assert found[0].name == "third"


def test_a_motion_is_told_as_one() -> None:
    line = "walkplayer none type=player move=physics size=.065 physflags=0x4a4f mass=150 surfdrag=3 maxthrust="
    slow, quick = (compiled(two_rooms("World templates 3", line + thrust)) for thrust in "23")
    (motion,) = (each for each in compare(slow, quick) if each.section == "motion")
    shown = "\n".join(text(("a", "b"), [motion]))
    assert (motion.kind, "1 motion changed" in shown, "motion of template 0 (walkplayer)" in shown) == (
        "motion", True, True,
    )  # fmt: skip


def test_ledges_and_basins_of_a_step() -> None:
    def steps(height: float) -> str:
        builder = Builder("steps")
        builder.room((0, 0, 0), (4, 4, 4))
        builder.room((0, 4, height), (4, 8, 4))
        builder.window(0, 1, (0, 4, height), (4, 4, 4))
        builder.templates.append(
            "walkplayer none type=player move=physics size=.065 movesize=.065 height=.18 physflags=0x4a4f jumpspeed=1.5"
        )
        builder.thing("walkplayer", (2, 2, 1), 0)
        return builder.text()

    found = compare(compiled(steps(0.0625)), compiled(steps(1.0)))
    edges = [each for each in found if each.kind == "edge"]
    assert edges
    assert {each.section for each in edges} == {"ledges"}
    kinds = {interval["kind"] for each in edges for field in each.fields for interval in field.after}
    assert "fall" in kinds
    assert compare(compiled(steps(1.0)), compiled(steps(1.0))) == []


def test_hotspots_and_what_lamps_light() -> None:
    slower = [line.replace("0.1)", "0.5)") for line in LAMP]
    darker = [line.replace("light=1", "light=.9") for line in LAMP]
    levels = []
    for lines in (LAMP, slower, darker):
        with level_with_files(*lines) as level:
            levels.append(compiled(level))
    found = compare(levels[0], levels[1])
    assert brief(found) == [("hotspot", "changed", -1, -1, ["calls_per_second"])]
    assert {each.kind for each in compare(levels[0], levels[2])} == {"template", "light"}


def test_settings_and_passes() -> None:
    found = compare(compiled(TWO_ROOMS), compiled(TWO_ROOMS, skip=frozenset({"things", "visibility"})))
    assert ("settings", "changed", 0, 0, ["skip"]) in brief(found)
    assert ("visibility", "removed", None, None, []) in brief(found)
    assert [each.name for each in found if each.kind == "pass"] == ["things", "visibility", "lights"]
    exact = compare(compiled(TWO_ROOMS), compiled(TWO_ROOMS, accuracy="exact"))
    assert brief(exact) == [("settings", "changed", 0, 0, ["accuracy"])]
