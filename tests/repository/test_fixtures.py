from __future__ import annotations

from fixtures.smithdev import make
from jktools.linter import lint
from tests.support.levels import level_of


def test_smithdev_is_what_its_generator_makes() -> None:
    assert make.TARGET.read_text("ascii") == make.smithdev().text()


def test_smithdev_has_the_one_fault_that_it_is_meant_to_have() -> None:
    found = lint(level_of(make.TARGET.read_bytes()))
    assert [(d.code.id, d.subject and d.subject.index) for d in found] == [("JK301", 6)]


def test_every_room_of_smithdev_is_reached_from_the_hub() -> None:
    level = level_of(make.TARGET.read_bytes())
    reached, pending = {0}, [0]
    while pending:
        for surface in level.sectors[pending.pop()].surfaces:
            beyond = surface.adjoin and surface.adjoin.sector
            if beyond and beyond.index not in reached:
                reached.add(beyond.index)
                pending.append(beyond.index)
    assert reached == set(range(len(level.sectors)))
