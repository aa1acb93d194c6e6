"""`jktools sight` on a level of two rooms."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from jktools.cli.sight import command
from jktools.geometry.mesh import SectorMesh
from jktools.model import Level as RealLevel
from jktools.source.container import file_member
from jktools.syntax.jkl import read
from tests.geometry.portal_levels import Level
from tests.geometry.test_mesh import TWO_ROOMS

THINGS = """\
World things 4
0: walkplayer walkplayer 1 1 1 0 0 0 0
1: ghost ghost 3 1 1 0 0 0 1
2: ghost ghost 3 1 1 0 0 0 7
end
"""


def jkl(level: Level, adjoin_flags: int = 7) -> str:
    """Spell a level of portal_levels whose adjoins come in pairs of surfaces, and three things."""
    shown = [s for s, lead in enumerate(level.leads_to) if lead >= 0]
    lines = [
        "SECTION: JK",
        "SECTION: COPYRIGHT",
        *["(c)"] * 34,
        "SECTION: GEORESOURCE",
        "World colormaps 1",
        "0: dflt.cmp",
    ]
    lines += [f"World vertices {len(level.positions)}"]
    lines += [f"{i}: {x} {y} {z}" for i, (x, y, z) in enumerate(level.positions.tolist())]
    lines += ["World texture vertices 1", "0: 0 0", f"World adjoins {len(shown)}"]
    lines += [f"{i}: 0x{adjoin_flags:x} {i ^ 1} 1.0" for i in range(len(shown))]
    lines += [f"World surfaces {len(level.leads_to)}"]
    for s in range(len(level.leads_to)):
        ring = level.surface_vertex[level.surface_start[s] : level.surface_start[s + 1]]
        adjoin = shown.index(s) if s in shown else -1
        corners = " ".join(f"{v},0" for v in ring)
        lines.append(f"{s}: -1 0x4 0x4 4 3 1 {adjoin} 0 {len(ring)} {corners} " + " ".join("1" for _ in ring))
    lines += [f"{s}: 0 0 1" for s in range(len(level.leads_to))]
    lines += ["SECTION: SECTORS", f"World sectors {len(level.sector_first)}"]
    for i, (first, count) in enumerate(zip(level.sector_first, level.sector_count, strict=True)):
        lines += [f"SECTOR {i}", "FLAGS 0x0", "AMBIENT LIGHT 0", "EXTRA LIGHT 0", "COLORMAP 0", "TINT 0 0 0"]
        lines += [
            "BOUNDBOX 0 0 0 4 4 4",
            "CENTER 2 2 2",
            "RADIUS 4",
            "VERTICES 1",
            "0: 0",
            f"SURFACES {first} {count}",
        ]
    return "\n".join([*lines, "SECTION: THINGS", THINGS])


def run(tmp_path: Path, text: str, *words: str) -> tuple[int, str]:
    path = tmp_path / "rooms.jkl"
    path.write_text(text, "latin-1")
    result = CliRunner().invoke(command, [str(path), *words])
    return result.exit_code, result.output


def test_things_that_see_each_other(tmp_path: Path) -> None:
    way = TWO_ROOMS.leads_to.index(1)
    expected = f"""\
from thing 0 (walkplayer) in sector 0 to thing 1 (ghost) in sector 1
  sector 0: through surface {way}, adjoin 0, at 50.0000%
  sector 1: ends here
visible
"""
    assert run(tmp_path, jkl(TWO_ROOMS), "0", "1") == (0, expected)


def test_an_adjoin_that_is_not_see_through(tmp_path: Path) -> None:
    way = TWO_ROOMS.leads_to.index(1)
    expected = f"""\
from (1, 1, 1) in sector 0 to (3, 1, 1) in sector 1
  sector 0: blocked by surface {way} (sector 0, surface {way}), whose adjoin 0 is not see-through (flag 0x1) at 50.0000%
not visible
"""
    assert run(tmp_path, jkl(TWO_ROOMS, adjoin_flags=6), "1,1,1", "3,1,1") == (0, expected)


def test_by_the_decompiled_engine(tmp_path: Path) -> None:
    words = (jkl(TWO_ROOMS, adjoin_flags=6), "0", "2", "--engine", "openjkdf2")
    assert run(tmp_path, *words) == (
        0,
        """\
thing 2 (ghost) is not in the level: sector 7 does not exist
null thing: HasLOS answers -1, which scripts take for true
""",
    )
    status, output = run(tmp_path, jkl(TWO_ROOMS), "0", "4,1,1", "--engine", "openjkdf2")
    assert status == 0
    wall = output.splitlines()[-3:]
    assert wall[0].startswith("  sector 1: blocked by surface ")
    assert wall[0].endswith("which has no adjoin at 100.0000%")
    assert wall[1].startswith("  (4, 1, 1) touches surface ")
    assert wall[2] == "not visible"
    assert run(tmp_path, jkl(TWO_ROOMS), "0", "4,1,1")[1].splitlines()[-1] == "visible"
    assert run(tmp_path, jkl(TWO_ROOMS), "0", "1", "--engine", "quake")[0] == 2


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("5", "0"), "the level has no thing with number 5"),
        (("2", "0"), "thing 2 (ghost) is not in the level: sector 7 does not exist"),
        (("9,9,9", "0"), "(9, 9, 9) lies in no sector"),
        (("1,2", "0"), "1,2 is not a point x,y,z: expected three numbers"),
        (("1,2,nan", "0"), "1,2,nan is not a point x,y,z: a number is not finite"),
    ],
)
def test_ends_that_are_nowhere(tmp_path: Path, words: tuple[str, str], message: str) -> None:
    status, output = run(tmp_path, jkl(TWO_ROOMS), *words)
    assert status == 2
    assert message in output


def test_a_sector_that_could_not_be_read_is_left_out(tmp_path: Path) -> None:
    """An adjoin into it blocks, and what starts in it is unknown: crossed 0."""
    vertices = list(TWO_ROOMS.surface_vertex)
    vertices[-1] = 99
    path = tmp_path / "broken.jkl"
    path.write_text(jkl(TWO_ROOMS._replace(surface_vertex=vertices)), "latin-1")
    level = RealLevel(read(file_member(path, str(path), path.name).read()))
    assert level.sound_sectors.tolist() == [True, False]
    found = SectorMesh.from_level(level).sight([[1, 1, 1], [3, 1, 1]], [0, 1], [[3, 1, 1], [3, 2, 1]])
    assert found.visible.tolist() == [False, False]
    assert found.crossed.tolist() == [1, 0]
    assert found.blocker.tolist() == [TWO_ROOMS.leads_to.index(1), -1]
    assert run(tmp_path, path.read_text("latin-1"), "1", "0")[0] == 2
