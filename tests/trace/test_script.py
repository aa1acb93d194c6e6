"""The script language: what each line does, and what is said about a line that makes no sense."""

from __future__ import annotations

import pytest

from jktools.engine.ground import SURFACES, Steps, Tread
from jktools.engine.simulation import Phase
from jktools.engine.thrust import Keys
from jktools.trace import script
from jktools.trace.script import ScriptError, parse


def test_every_line() -> None:
    read = parse(
        """
        floor -1 0             # a kerb
        floor 2 0.05 icy
        0    walk forward
        1    run back left
        1.5  crouch
        2    jump
        2.5  stand
        3    surface non-floor
        4    release
        5    slow right
        5.5  velocity 0 -1 .5
        6    sector-thrust 0 0 8
        6    extra-speed -0.5
        6.25 end
        """
    )
    assert read.ground == Steps((Tread(-1, 0), Tread(2, 0.05, SURFACES["icy"])))
    assert read.seconds == 6.25
    away = Keys(-1, -1, run=True)
    sliding = Steps((Tread(-1, 0, SURFACES["non-floor"]), Tread(2, 0.05, SURFACES["non-floor"])))
    assert read.phases == (
        Phase(0, Keys(1)),
        Phase(1, away),
        Phase(1.5, Keys(-1, -1, run=True, crouch=True)),
        Phase(2, Keys(-1, -1, run=True, crouch=True, jump=True)),
        Phase(2.5, away),
        Phase(3, away, sliding),
        Phase(4, Keys()),
        Phase(5, (slow := Keys(strafe=1, slow=True))),
        Phase(5.5, slow, velocity=(0, -1, 0.5)),
        Phase(6, slow, sector_thrust=(0, 0, 8)),
        Phase(6, slow, extra_speed=-0.5),
    )


def test_the_page_names_every_surface() -> None:
    listed = " ".join((script.__doc__ or "").split()).split("Surfaces: ")[1].rstrip(".").split(", ")
    assert listed == list(SURFACES)


def test_flat_ground_without_floor_lines() -> None:
    read = parse("0 surface icy\n1 surface floor\n2 end")
    assert read.ground == Steps.flat()
    assert [phase.ground for phase in read.phases] == [Steps.flat(SURFACES["icy"]), Steps.flat()]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0 walk", "line 1: walk takes one or two of forward, back, left, right"),
        ("0 walk up\n1 end", "line 1: walk takes one or two of forward, back, left, right"),
        ("\n0 fly", "line 2: fly is no action: walk, run, slow, release, crouch, stand, jump, surface, velocity, "),
        ("0 velocity 1", "line 1: velocity takes three numbers"),
        ("0 sector-thrust 0 0 up", "line 1: up is no number"),
        ("0 extra-speed", "line 1: extra-speed takes one number"),
        ("0 surface lava", "line 1: lava is no surface: floor, non-floor, icy, very-icy"),
        ("0 surface", "line 1: surface takes one name"),
        ("0 jump high", "line 1: jump takes no high"),
        ("soon jump", "line 1: soon is no number"),
        ("nan jump", "line 1: nan is no number"),
        ("-1 jump", "line 1: time -1 is before the start"),
        ("1 jump\n0.5 jump", "line 2: time 0.5 comes before 1"),
        ("1", "line 1: a time needs an action"),
        ("floor 0 0\nfloor 0 1", "line 2: floor at 0 does not come after 0"),
        ("floor 0", "line 1: a floor needs its start and height, and may have a surface"),
        ("0 jump\nfloor 0 0", "line 2: floors come before the first time"),
        ("1 end\n2 jump", "line 2: nothing may follow the end"),
        ("0 jump", "no line says where the trace ends, such as: 10 end"),
        ("", "no line says where the trace ends, such as: 10 end"),
    ],
)
def test_what_is_said(text: str, said: str) -> None:
    with pytest.raises(ScriptError) as caught:
        parse(text)
    assert str(caught.value).startswith(said)
