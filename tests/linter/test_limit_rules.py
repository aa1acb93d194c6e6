"""The rules about limits of the engine, at those limits."""

from __future__ import annotations

import pytest

from jktools.linter import find_rule, lint
from jktools.linter.rules.limits.too_many_things import Limits
from tests.support.levels import level_of, two_rooms
from tests.support.lint import findings, messages


def test_641_things_and_what_the_option_says() -> None:
    assert messages("JK801", "World things 641") == []
    (message,) = messages("JK801", "World things 642")
    assert message == "the heading announces 642 things, but the original engine takes 641"
    rule = find_rule("JK801")
    assert lint(level_of(two_rooms("World things 642")), [rule], options={"JK801": Limits(things=32000)}) == []


def placed(template: str, count: int) -> tuple[str, ...]:
    """So many things of a template, from number 2."""
    return "World things 400", *(f"{i}: {template} x .5 1.5 .5 0 90 0 1" for i in range(2, count + 2))


@pytest.mark.parametrize(("count", "told"), [(256, False), (257, True)])
def test_256_actors(count: int, told: bool) -> None:
    found = findings("JK802", "World templates 5", "a none type=actor", "b a size=1", *placed("b", count))
    assert [d.message for d in found] == (
        ["the level places 257 actors, but the engine has room for 256; thing 258 (b) is the first without"]
        if told else []
    )  # fmt: skip


@pytest.mark.parametrize(("count", "told"), [(31, False), (32, True)])
def test_32_players_of_which_the_rooms_have_one(count: int, told: bool) -> None:
    assert bool(messages("JK803", *placed("walkplayer", count))) is told


@pytest.mark.parametrize(("count", "told"), [(64, False), (65, True)])
def test_64_particle_files(count: int, told: bool) -> None:
    lines = [f"t{i} none type=cog particle=p{i}.par" for i in range(count)]
    again = "again none type=cog particle=P0.par"
    found = messages("JK804", f"World templates {count + 4}", *lines, again)
    assert found == (
        ["the level names 65 particle files, but the engine loads 64; p64.par is the first without"] if told else []
    )


@pytest.mark.parametrize(("line", "told"), [
    ("a none type=particle count=256", False), ("a none type=particle count=257", True),
    ("a none type=cog count=300", False), ("a none type=particle count=-5", False),
])  # fmt: skip
def test_256_particles(line: str, told: bool) -> None:
    assert bool(messages("JK805", "World templates 4", line)) is told
    assert messages("JK805", "World templates 4", f"{line} particle=ball.par") == []


def test_cog_places_are_counted_behind_those_that_are_placed() -> None:
    templates = ("World templates 5", "a none type=cog cog=x.cog", "b none type=cog cog=x.cog")
    assert messages("JK806", "World cogs 3", *templates) == []
    (message,) = messages("JK806", "World cogs 2", *templates)
    assert message == (
        "the heading announces 2 COGs, but the level places 1, and 2 templates and things have one with cog=; "
        "template 4 (b) is the first without room"
    )
