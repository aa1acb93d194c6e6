"""smithdev.gob: what is checked in is what its generator makes, the engine would load it, and its faults are meant."""

from __future__ import annotations

import json
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

import jktools
from fixtures.smithdev.pack import EXPECTED, GOB, HANDLES, HERE, JKL, made_files
from jktools.source import Container, resolve
from tests.support.levels import ROOT

OURS = ("level/", "smithdev.gob", "handles.json", "expected.json")


def kept_files() -> dict[str, bytes]:
    files = {path.relative_to(HERE).as_posix(): path.read_bytes() for path in HERE.rglob("*") if path.is_file()}
    return {name: data for name, data in files.items() if name.startswith(OURS)}


def test_what_is_checked_in_is_what_the_generator_makes() -> None:
    made, kept = made_files(), kept_files()
    assert sorted(made) == sorted(kept)
    assert [name for name in made if made[name] != kept[name]] == [], "run python -m fixtures.smithdev"


@pytest.mark.parametrize("seed", ["1", "2"])
def test_the_same_bytes_whatever_the_hash_seed(tmp_path: Path, seed: str) -> None:
    command = [sys.executable, "-m", "fixtures.smithdev", str(tmp_path)]
    subprocess.run(command, cwd=ROOT, check=True, env={"PYTHONHASHSEED": seed}, timeout=300)
    made = {path.relative_to(tmp_path).as_posix(): path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    assert made == kept_files()


def test_the_pack_holds_the_loose_files() -> None:
    pack = resolve(str(GOB))
    assert isinstance(pack, Container)
    packed = {member.name: bytes(member.read().data) for member in pack.members}
    assert packed == {n.removeprefix("level/"): d for n, d in kept_files().items() if n.startswith("level/")}
    assert GOB.stat().st_size < 1_500_000


def found(*options: str) -> list[dict[str, Any]]:
    words = ["lint", str(GOB), "--format", "json", "--config", "none", *options]
    command = [str(Path(sys.executable).parent / "jktools"), *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode in (0, 1), done.stderr
    rows: list[dict[str, Any]] = json.loads(done.stdout)["diagnostics"]
    return rows


def of(code: str, held: dict[str, int | str | None] | None) -> tuple[str, str, int | str | None]:
    held = held or {}
    kind = str(held.get("kind", ""))
    return code, kind, held.get("name") if kind in ("template", "") else held.get("index")


def test_lint_finds_what_is_meant_and_nothing_else() -> None:
    rows = json.loads(EXPECTED.read_text("ascii"))
    assert all(row["reason"] for row in rows)
    expected = Counter(of(row["code"], row["object"]) for row in rows)
    lines = found()
    actual = Counter(of(row["code"], row["object"]) for row in lines)
    assert (sorted((expected - actual).elements()), sorted((actual - expected).elements())) == ([], [])
    # Four rims lie on one walkway, a dozen calls in one script: what each message says tells them apart.
    for row in sorted(rows, key=lambda row: -len(row.get("says", ""))):
        like = (line for line in lines if of(line["code"], line["object"]) == of(row["code"], row["object"]))
        line = next((line for line in like if row.get("says", "") in line["message"]), None)
        assert line is not None, row
        assert not row.get("script") or line["path"].endswith(f"!cog/{row['script']}"), row
        lines.remove(line)
    assert lines == []


@pytest.mark.parametrize("game", ["jk", "mots"])
def test_every_rule_there_is_finds_no_more_than_the_page_says(game: str) -> None:
    """With the rules that are off by default: nooks that nobody walks into, rises, and the flag without effect."""
    handles = json.loads(HANDLES.read_text("ascii"))
    usual = {row["code"] for row in json.loads(EXPECTED.read_text("ascii"))}
    more = [row for row in found("--select", "JK", "--game", game) if row["code"] not in usual]
    tunnels = handles["light_test_bed"]["about"]["tunnels"]
    assert Counter(row["code"] for row in more if row["code"] != "JK704") == {
        "JK227": sum(map(len, tunnels.values())), "JK742": 2,
    }  # fmt: skip
    nooks = {number for name, number in handles["light_test_bed"]["sectors"].items() if name.startswith("tunnel")}
    assert {row["object"]["index"] for row in more if row["code"] == "JK227"} < nooks
    flags = {handles["particle_room"]["about"]["variants"][name] for name in ("flag_0x02", "all_flags")}
    assert {row["object"]["name"] for row in more if row["code"] == "JK742"} == flags
    uneven = [handles[name]["surfaces"].values() for name in ("pit_rows", "insert_offset", "walkway")]
    known = {surface for chamber in uneven for surfaces in chamber for surface in surfaces}
    assert {row["object"]["index"] for row in more if row["code"] == "JK704"} <= known


def test_every_sector_is_reached_from_the_hub() -> None:
    level = jktools.load(str(JKL))
    reached, pending = {0}, [0]
    while pending:
        for surface in level.sectors[pending.pop()].surfaces:
            beyond = surface.adjoin and surface.adjoin.sector
            if beyond and beyond.index not in reached:
                reached.add(beyond.index)
                pending.append(beyond.index)
    assert reached == set(range(len(level.sectors)))


def test_seams_are_closed_vertex_by_vertex() -> None:
    """In each sector every edge is run back along by exactly one other surface, by the numbers of its vertices."""
    level = jktools.load(str(JKL))
    for sector in level.sectors:
        edges: Counter[tuple[int, int]] = Counter()
        for surface in sector.surfaces:
            ring = [int(v) for v in surface.vertices]
            edges.update(zip(ring, (*ring[1:], ring[0]), strict=True))
        assert set(edges.values()) == {1}, sector
        assert all((b, a) in edges for a, b in edges), sector
