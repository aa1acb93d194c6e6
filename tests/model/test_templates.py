"""Templates are resolved as the engine resolves them: against a literal interpreter, and point by point."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from jktools.model import Level
from jktools.model.resolved import Reason, Resolved
from jktools.source import Source
from jktools.syntax.jkl import read_library
from jktools.syntax.template.parameters import MOST_FRAMES, PARAMETERS, TYPES
from tests.support.levels import CORPUS, corpus_files, level_of, two_rooms
from tests.support.template_oracle import FAMILY, GENERAL, MOTS, OTHERS, Engine

CORPUS_FILES = list(corpus_files())
NAMES = ["a", "b", "c", "d", "+e", "F", "none"]
VALUES = [
    "0", "1", "2", "3", "-1", "4", ".5", "-.5", "1e2", "1e99", "x", "0x10", "0x", "0xfffffffff", "12abc", "(1/2/3)",
    "(1/2", "99999999999", "(1/2/3:4/5/6)", "(1/2/3:4/5/6", "(1/2/3/4)", "(a/b/c)", "physics", "path", "none", "x.3do",
    "y.cog", "1.5.5", "+2", "-0",
    *TYPES, *NAMES,
]  # fmt: skip
KEYS = [
    *PARAMETERS,
    *("type", "move", "numframes", "frame", "debris", "typeflags") * 3,
    "pup",
    "thingflags0x400",
    "Size",
]

parameters = st.lists(st.tuples(st.sampled_from(KEYS), st.sampled_from(VALUES)), max_size=8)
lines = st.lists(st.tuples(st.sampled_from(NAMES), st.sampled_from(NAMES), parameters), max_size=8)


def words(values: list[tuple[str, str]]) -> str:
    return " ".join(f"{key}={value}" for key, value in values)


def held(resolved: Resolved) -> dict[str, Any]:
    """What a template holds, and who wrote each value first."""
    found = {}
    for key, setting in resolved.values.items():
        first = setting.origins[0]
        found[key] = (setting.value, (f"{first.owner.kind} {first.owner.index}", first.place))
    return found


def compare(level: Level, game: str) -> None:
    heading = level.document.templates.heading
    engine = Engine(game, None if heading is None else heading.count)
    for template in level.templates:
        if template.broken:
            continue
        record, kept = engine.template(
            template.name, template.parent_name, template.parameters, f"template {template.index}"
        )
        resolved = template.resolved
        unsure = resolved.leaves_level and record.type == "free"
        assert (resolved.dropped is None) == kept or unsure, template
        if unsure and resolved.dropped is None:
            engine.known[template.name.lower()] = record
        assert (resolved.type, resolved.move) == (record.type, record.move), template
        assert held(resolved) == record.fields(), template
    for thing in level.things:
        if not thing.broken:
            record = engine.thing(
                thing.template_name, tuple(thing.angles.tolist()), thing.parameters, f"thing {thing.index}"
            )
            assert held(thing.resolved) == record.fields(), thing


@settings(max_examples=600, deadline=None)
@given(lines, lines, st.sampled_from([100, 3]), st.sampled_from(["jk", "mots"]))
@example([("a", "none", [("type", "weapon"), ("damage", "1")]), ("b", "a", [("type", "cog")]),
          ("c", "b", [("type", "weapon")]), ("d", "b", [("type", "explosion")])], [], 100, "jk")  # fmt: skip
def test_templates_resolve_as_the_literal_interpreter_has_it(
    templates: list[Any], things: list[Any], most: int, game: str
) -> None:
    text = two_rooms(
        "Section: TEMPLATES", f"World templates {most}", "Section: THINGS", f"World things {len(things) + 3}"
    )
    made = "\n".join(f"{name} {parent} {words(values)}" for name, parent, values in templates)
    placed = "\n".join(f"{i + 5}: {name} x 0 0 0 1 2 3 0 {words(values)}" for i, (name, _, values) in enumerate(things))
    text = text.replace("crate none", made + "\ncrate none").replace("1: ghost", placed + "\n1: ghost")
    compare(level_of(text, game=game), game)


@pytest.mark.skipif(not CORPUS_FILES, reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize(("path", "data"), CORPUS_FILES, ids=[path for path, _ in CORPUS_FILES])
def test_real_levels_resolve(path: str, data: bytes) -> None:
    game = "mots" if ".goo!" in path.lower() else "jk"
    level = level_of(data, path, game)
    compare(level, game)
    assert not any(entry.leaves_level for entry in level.resolved_templates.entries)


@pytest.mark.skipif(not CORPUS_FILES, reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize(("name", "game", "count"), [("master.tpl", "jk", 656), ("mots.tpl", "mots", 774)])
def test_template_libraries_resolve(name: str, game: str, count: int) -> None:
    level = Level(read_library(Source(name, (CORPUS / "tpl" / name).read_bytes()), game))
    assert len(level.templates) == count
    compare(level, game)


def test_the_table_and_the_interpreter_know_the_same_keys() -> None:
    assert set(PARAMETERS) == {*GENERAL, *OTHERS, *MOTS}
    assert {p.key for p in PARAMETERS.values() if p.game == "mots"} == set(MOTS)
    assert set(FAMILY) <= set(TYPES)


def resolve(*templates: str, game: str = "jk") -> list[Resolved]:
    level = Level(read_library(Source("x.tpl", "\n".join(templates).encode()), game))
    assert not level.diagnostics
    return level.resolved_templates.entries


def test_every_value_knows_its_ancestor_and_its_place() -> None:
    base, _, grandchild = resolve(
        "base none type=actor move=physics size=.1", "child base health=20,maxhealth=30", "last child physflags=0x10"
    )
    assert [entry.owner.name for entry in grandchild.chain] == ["last", "child", "base"]
    size = grandchild.values["size"]
    assert (size.value, size.origins[0].owner.name, size.origins[0].span.text) == (
        pytest.approx(0.1),
        "base",
        "size=.1",
    )
    assert size.origins[0].span.first.line == 1
    assert grandchild.values["health"].origins[0].span.text == "maxhealth=30"
    assert grandchild.values["health"].origins[0].span.first.line == 2
    assert (base.has_ai, grandchild.has_ai) == (True, True)


def test_flags_are_replaced_and_setters_switch_them_on_in_turn() -> None:
    before, after, child = resolve(
        "a none type=explosion damage=5 typeflags=0x1", "b none type=explosion typeflags=0x1 damage=5",
        "c b typeflags=0x80",
    )  # fmt: skip
    assert before.flags("typeflags") == 0x1
    assert after.flags("typeflags") == 0x7
    assert [o.span.text for o in after.values["typeflags"].origins] == ["typeflags=0x1", "damage=5"]
    assert child.flags("typeflags") == 0x80


@pytest.mark.parametrize(("line", "reason", "key"), [
    ("a none type=weapon pup=x.pup", Reason.UNKNOWN, "pup"),
    ("a none type=weapon thingflags0x400", Reason.UNKNOWN, "thingflags0x400"),
    ("a none type=weapon treesize=1", Reason.OTHER_GAME, "treesize"),
    ("a none type=weapon attach=1", Reason.NO_HANDLER, "attach"),
    ("a none type=weapon health=25", Reason.NOT_FOR_THIS, "health"),
    ("a none damage=5 type=weapon", Reason.NOT_FOR_THIS, "damage"),
    ("a none type=weapon size=-1", Reason.REJECTED, "size"),
    ("a none type=weapon collide=4", Reason.REJECTED, "collide"),
    ("a none type=weapon orient=0/0/0", Reason.REJECTED, "orient"),
    ("a none type=weapon thingflags=none", Reason.REJECTED, "thingflags"),
    ("a none type=weapon move=fast", Reason.REJECTED, "move"),
    ("a none type=player movesize=1", Reason.FIXED_SIZE, "movesize"),
    ("a none type=cog move=path frame=(0/0/0:0/0/0)", Reason.FULL, "frame"),
    ("a none type=weapon explode=a", Reason.UNRESOLVED, "explode"),
    ("a none type=actor numframes=1", Reason.BEFORE_BIRTH, "numframes"),
])  # fmt: skip
def test_what_is_ignored_says_why(line: str, reason: Reason, key: str) -> None:
    (entry,) = resolve(line)
    assert [(i.key, i.reason) for i in entry.ignored] == [(key, reason)]
    assert entry.ignored[0].origin.span.text.startswith(key)


def test_what_the_engine_drops_gives_its_name_free() -> None:
    entries = resolve("a none size=1", "a none type=cog", "a none type=item", "b a", "c x", "d c type=cog")
    assert [entry.dropped for entry in entries] == [
        "its type is free", None, "template 1 has the same name and comes first", None, None, None,
    ]  # fmt: skip
    assert (entries[3].type, entries[3].leaves_level) == ("cog", False)
    # c may get a type from a template that is not at hand, and so may d anything else.
    assert [entry.leaves_level for entry in entries[4:]] == [True, True]
    assert [entry.knows_type for entry in entries[4:]] == [False, True]


def test_a_change_of_type_gives_the_memory_away() -> None:
    *_, revived, taken = resolve(
        "w none type=weapon damage=3", "c w type=cog", "r c type=weapon", "e c type=explosion force=1"
    )
    assert revived.number("damage") == 3
    assert "damage" not in taken.values
    assert [(lost.key, lost.setting.text) for lost in taken.lost] == [("damage", "3")]


def test_debris_joins_what_is_inherited_up_to_four() -> None:
    *_, child = resolve(
        *(f"d{i} none type=debris" for i in range(5)), "a none type=explosion debris=d0 debris=d1 debris=d2",
        "b a debris=none debris=d3 debris=d4",
    )  # fmt: skip
    assert child.values["debris"].value == ("d0", "d1", "d2", "d3")
    assert [(i.text, i.reason) for i in child.ignored] == [("d4", Reason.FULL)]
    assert {name for _, name, _ in child.templates} == {"d0", "d1", "d2", "d3"}


def test_the_fields_of_a_thing_turn_it_unless_orient_does() -> None:
    level = level_of(two_rooms(
        "World templates 4", "lamp none type=cog orient=(1/2/3)", "World things 4",
        "2: lamp lamp .5 .5 .5 10 20 30 0", "3: lamp lamp .5 .5 .5 10 20 30 0 orient=(4/5/6)",
    ))  # fmt: skip
    plain, turned = (thing.resolved for thing in level.things[2:])
    assert plain.values["orient"].value == (10, 20, 30)
    assert plain.values["orient"].origins[0].span.text == "10"
    assert turned.values["orient"].value == (4, 5, 6)


def test_health_raises_maxhealth_but_does_not_lower_it() -> None:
    up, down, both = resolve(
        "a none type=actor maxhealth=20 health=30", "b none type=actor maxhealth=20 health=10",
        "c none type=actor health=10 maxhealth=20",
    )  # fmt: skip
    assert (up.number("health"), up.number("maxhealth")) == (30, 30)
    assert (down.number("health"), down.number("maxhealth")) == (10, 20)
    assert (both.number("health"), both.number("maxhealth")) == (20, 20)


def test_what_a_path_rejects_a_patrol_may_take() -> None:
    level = level_of(two_rooms(
        "World templates 4", "guard none type=actor", "World things 6",
        "2: guard guard .5 .5 .5 0 0 0 0 numframes=0 frame=(1/2/3)",
        "3: guard guard .5 .5 .5 0 0 0 0 numframes=2 move=path frame=(1/2/3)",
        "4: guard guard .5 .5 .5 0 0 0 0 numframes=1 frame=(1/2/3) frame=(4/5/6)",
        "5: guard guard .5 .5 .5 0 0 0 0 numframes=2 frame=(1/2/3) move=path numframes=1 frame=(4/5/6)",
    ))  # fmt: skip
    none, mixed, patrol, both = (thing.resolved for thing in level.things[2:])
    assert "numframes" not in none.values
    assert "frame" not in none.values
    # The path has no frames of its own: it takes no frame, and nobody asks the AI.
    assert [i.reason for i in mixed.ignored] == [Reason.FULL]
    assert (both.values["numframes"].value, both.values["frame"].value) == (1, ((1, 2, 3), (4, 5, 6)))
    assert both.ignored == ()
    assert patrol.values["frame"].value == ((1, 2, 3),)
    assert [(i.text, i.reason) for i in patrol.ignored] == [("(4/5/6)", Reason.FULL)]


def test_frames_handed_down_forever_do_not_grow_without_bound() -> None:
    frames = " ".join(["frame=(0/0/0:0/0/0)"] * 20)
    first = "t0 none type=cog move=path numframes=2000000000"
    entries = resolve(first, *(f"t{i} t{i - 1} {frames}" for i in range(1, 200)))
    frames_held = entries[-1].values["frame"].value
    assert isinstance(frames_held, tuple)
    assert len(frames_held) == MOST_FRAMES
    assert len(list(entries[-1].chain)) == 200
    assert entries[-1].ignored[-1].reason is Reason.FULL
