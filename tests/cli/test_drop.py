"""`jktools drop` on the two rooms."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from jktools.cli.drop import command
from tests.support.levels import two_rooms

WATER = ("Sector 1", "FLAGS 0x2")
NO_FLOOR_FLAG = ("World surfaces 12", "0: 0 0x4 0x4 4 3 1 -1 0 4 0,0 1,1 2,2 3,3 1 1 1 1")


def run(tmp_path: Path, text: str, start: str) -> tuple[int, str]:
    path = tmp_path / "rooms.jkl"
    path.write_text(text, "latin-1")
    result = CliRunner().invoke(command, [str(path), start])
    return result.exit_code, result.output


@pytest.mark.parametrize(
    ("fragment", "start", "last"),
    [
        ((), "0", "floor: surface 0 (sector 0, surface 0), 0.2 JKU below, in sector 0"),
        ((), ".5,.5,.75", "floor: surface 0 (sector 0, surface 0), 0.75 JKU below, in sector 0"),
        (WATER, "1", "no floor: sector 1 is under water"),
        (NO_FLOOR_FLAG, "0", "no floor: surface 0 (sector 0, surface 0) is solid, but has no floor flag (0x1), 0.2 JKU "
                             "below, in sector 0"),
    ],
)  # fmt: skip
def test_what_is_below(tmp_path: Path, fragment: tuple[str, ...], start: str, last: str) -> None:
    status, output = run(tmp_path, two_rooms(*fragment), start)
    assert status == 0
    assert output.splitlines()[-1] == last


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ("9", "the level has no thing with number 9"),
        ("x", "x is neither the number of a thing nor x,y,z"),
        ("9,9,9", "(9, 9, 9) lies in no sector"),
    ],
)
def test_starts_that_are_nowhere(tmp_path: Path, start: str, message: str) -> None:
    status, output = run(tmp_path, two_rooms(), start)
    assert status == 2
    assert message in output


def test_things_carry_unless_told_not_to(tmp_path: Path) -> None:
    """A bridge whose model is not at hand."""
    text = two_rooms("World templates 4", "bridge none type=cog collide=3 size=.3 thingflags=0x40",
                     "World things 4", "2: bridge bridge .5 .5 .4 0 0 0 0")  # fmt: skip
    status, output = run(tmp_path, text, ".5,.5,.75")
    assert status == 0
    assert output.splitlines()[-1] == "unknown: thing 2 (bridge) may be a floor here, but its model is not at hand"
    surfaces = CliRunner().invoke(command, [str(tmp_path / "rooms.jkl"), ".5,.5,.75", "--no-things"])
    assert surfaces.output.splitlines()[-1] == "floor: surface 0 (sector 0, surface 0), 0.75 JKU below, in sector 0"
    assert run(tmp_path, text, "2")[1].splitlines()[-1].startswith("floor: surface 0"), "its own body does not count"
