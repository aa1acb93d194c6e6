"""The document's flags, on things and surfaces of the compiled level; the Thing Flags Chamber prints them in play."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fixtures.smithdev.chambers.thing_flags_chamber import SHOTS
from fixtures.smithdev.pack import GOB
from jktools.engine import attachment
from tests.experiments.play import Play
from tests.experiments.smithdev import GOLDEN, Experiment

CHAMBER = "thing_flags_chamber"
FLAGS: dict[str, Any] = GOLDEN["flags"]
TYPES = 12
"""Thing types of the engine, from free to particle: bit k of a link's mask is type k."""


def jktools(*arguments: object) -> Any:
    """What the command prints as JSON, in a process of its own."""
    command = [str(Path(sys.executable).parent / "jktools"), *map(str, arguments), "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True, timeout=300).stdout)


def test_thing_flags_chamber(smithdev: Experiment) -> None:
    """The script is linked to the adjoin between the rooms, and the mask of -1 to things of every type."""
    level = smithdev.level
    assert level.cogs is not None
    row = int(np.flatnonzero(level.cogs.source == smithdev.cog(f"{CHAMBER}/monitor"))[0])
    gate = int(level.strings[level.cogs.value[level.cogs.value_start[row]]])
    assert smithdev.surfaces(f"{CHAMBER}/near.gate") == [gate]
    adjoin = int(level.surface_adjoin[gate])
    behind = level.surface_sector[level.adjoin_surface[level.adjoin_mirror[adjoin]]]
    assert behind == smithdev.sector(f"{CHAMBER}/far")
    (script,) = jktools("cog", f"{GOB}!cog/sd_thingflags.cog")["scripts"]
    (link,) = (symbol for symbol in script["symbols"] if symbol["name"] == "gate")
    assert all(link["mask"] >> kind & 1 for kind in range(TYPES))
    assert [m["handled"] for m in script["messages"] if m["name"] == "crossed"] == [True]


def test_whatever_crosses_has_its_flags_printed(smithdev: Experiment) -> None:
    """`sd_thingflags.cog`, by a mask of -1: the player on his way in and out, and the shots of `sd_thrower.cog`."""
    play = Play(smithdev, f"{CHAMBER}/near")
    play.run_until(f"{CHAMBER}/far", "walk forward")
    player = smithdev.template("walkplayer")
    own = [int(player[key]) for key in ("thingflags", "physflags", "typeflags")]
    attached = FLAGS["attach"]["datamaster"]["0x1"]
    assert attached == "attached to a surface"
    says = "thing, physics and type flags, attach flags:"
    assert [words for _, words in play.printed("monitor")] == [[says, *own, 0x1]]
    play.run_until(f"{CHAMBER}/near", "walk back")
    assert len(play.printed("monitor")) == 1, "the gate that is linked is the near room's"


def test_a_switch_throws_four_shots_across(smithdev: Experiment) -> None:
    """`sd_thrower.cog`: one shot a press, in turn; each flies over the gate and on to the far wall."""
    play = Play(smithdev, f"{CHAMBER}/near")
    shots = list(smithdev.about(CHAMBER)["shots"].values())
    thrown = []
    for _ in range(5):
        play.press("switch")
        thrown.append(max(play.things.values(), key=lambda thing: thing.number))
        play.run(0.5)
    assert [shot.template for shot in thrown] == [*shots, shots[0]]
    play.run(4)
    far = smithdev.sector(f"{CHAMBER}/far")
    assert {shot.sector for shot in thrown} == {far}
    muzzle = play.things[smithdev.thing(f"{CHAMBER}/muzzle")]
    ways = np.array([shot.place - muzzle.place for shot in thrown])
    # 5 JKU to the wall but for the sphere; nothing pulls a shot down.
    assert ways @ smithdev.look(f"{CHAMBER}/muzzle") == pytest.approx([5 - 0.01] * 5, abs=1e-6)
    assert np.abs(ways[:, 2]).max() == 0
    printed = play.printed("monitor")
    # 2 JKU at 2 JKU/s, then the next half a second later.
    assert [time for time, _ in printed] == pytest.approx([1.02 + 0.5 * i for i in range(5)], abs=0.021)
    held = [
        [int(smithdev.template(name).get(key, 0)) for key in ("thingflags", "physflags", "typeflags")] for name in shots
    ]
    assert [words[1:4] for _, words in printed] == [*held, held[0]]
    assert [words[3] for _, words in printed[:4]] == list(SHOTS.values())


def test_surface_flags(smithdev: Experiment) -> None:
    """A body on foot takes a floor by flag 0x1; the same surface without it, or a wall, it does not take."""
    level, walker = smithdev.level, int(smithdev.template("walkplayer")["physflags"])
    (floor,) = smithdev.surfaces(f"{CHAMBER}/far.floor")
    flags = int(level.surface_flags[floor])
    assert flags & FLAGS["surface"]["floor"]
    assert attachment.takes_floor(walker, flags)
    assert not attachment.takes_floor(walker, flags & ~FLAGS["surface"]["floor"])
    wall = smithdev.surfaces(f"{CHAMBER}/far.wall 1")[0]
    assert not attachment.takes_floor(walker, int(level.surface_flags[wall]), float(level.surface_normal[wall][2]))


def test_physics_flags(smithdev: Experiment) -> None:
    """What the document says that a player's physics flags do: he thrusts, and attaches to floors, not to walls."""
    bits, held = FLAGS["physics"], int(smithdev.template("walkplayer")["physflags"])
    names = {name for name, bit in bits.items() if held & bit}
    assert names == {"uses_thrust", "attach_to_floor", "gravity_while_attached", "blast_force_while_attached"}
    # "Clearing this flag can allow a player to stand still while walking on walls": 0x80 takes any solid surface.
    wall = int(smithdev.level.surface_flags[smithdev.surfaces(f"{CHAMBER}/far.wall 1")[0]])
    assert attachment.takes_floor(held | bits["attach_to_wall"], wall, 0.0)
    shot = int(smithdev.template("+sd_shot_plain")["physflags"])
    assert not shot & (bits["attach_to_floor"] | bits["attach_to_wall"])


def test_weapon_flags(smithdev: Experiment) -> None:
    """0x80 sticks to surfaces, 0x800 to things: the four shots of the chamber have each, both and neither."""
    shots, weapon = smithdev.about(CHAMBER)["shots"], FLAGS["weapon"]
    sticks = {}
    for name, template in shots.items():
        flags = int(smithdev.template(template)["typeflags"])
        assert flags == SHOTS[name]
        sticks[name] = tuple(attachment.weapon_sticks(flags, to_thing=thing) for thing in (False, True))
    assert sticks == {
        "plain": (False, False), "sticky": (True, False), "charge": (False, True), "both": (True, True),
    }  # fmt: skip
    assert (SHOTS["sticky"], SHOTS["charge"]) == (weapon["attach_to_surfaces"], weapon["attach_to_things"])
