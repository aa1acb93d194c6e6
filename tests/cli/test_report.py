"""`jktools report`: pages that need nothing else, and show what the level holds."""

from __future__ import annotations

import base64
import json
import re
import shutil
import subprocess
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import jktools
from jktools.cli import main
from jktools.facts import LevelFacts
from tests.support.levels import ROOT, TWO_ROOMS, gob_of, two_rooms

ENGINE = "fixtures/broken/engine/jkl/engine.jkl"
MISMATCH = two_rooms("World adjoins 2", "1: 0x7 1 1")
REFUSED = two_rooms("World surfaces 12", "0: 0 0x4 0x4 4 3 1 -1 0 4 99,0 1,1 2,2 3,3 1 1 1 1")


class Page(HTMLParser):
    """What a browser would find: the data of the scripts, the findings, and whatever leads elsewhere."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.data: dict[str, Any] = {}
        self.findings: list[dict[str, str | None]] = []
        self.links: list[str] = []
        self.tags: list[str] = []
        self._script = ""
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        held = dict(attrs)
        self.tags.append(tag)
        self._script = held.get("id") or "" if tag == "script" else ""
        self.links += [value or "" for name, value in attrs if name in ("src", "href")]
        if tag == "li" and (held.get("class") or "").split(" ")[0] in ("error", "warning", "info"):
            self.findings.append(held)

    def handle_data(self, data: str) -> None:
        if self._script:
            self.data[self._script] = json.loads(data)
            self._script = ""
        self.text += data


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fixtures").symlink_to(ROOT / "fixtures")
    return tmp_path


def page_of(path: str, *words: str, status: int = 0) -> Page:
    assert main(["report", path, "-o", "page.html", *words]) == status
    return Page(Path("page.html").read_text("utf-8"))


def numbers(text: str, dtype: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), dtype)


def test_the_page_holds_the_level(here: Path) -> None:
    page = page_of(ENGINE)
    level = jktools.load(ENGINE)
    held = page.data["level"]
    assert numbers(held["vertices"], "<f4").tolist() == level.vertices.ravel().tolist()
    corners, start = numbers(held["corner_vertex"], "<i4"), numbers(held["corner_start"], "<i4")
    rings = [corners[a:b].tolist() for a, b in pairwise(start)]
    assert rings == [surface.vertices.tolist() for surface in level.surfaces]
    assert [(t["index"], t["name"], t["sector"]) for t in held["things"]] == [
        (i, t.name, t.sector_index) for i, t in enumerate(level.things)
    ]
    assert {t["name"]: t["type"] for t in held["things"]}["candle"] == "cog"


def test_a_finding_has_the_place_of_its_object() -> None:
    """Surface 8 is the floor of the pit, of corners 12, 13, 8 and 9; thing 3 stands at .5 .5 .5."""
    found = {f["code"]: f for f in page_of(ENGINE).data["level"]["findings"]}
    level = jktools.load(ENGINE)
    assert found["JK701"]["place"] == pytest.approx(level.vertices[[12, 13, 8, 9]].mean(axis=0), abs=1e-4)
    assert found["JK730"]["place"] == [0.5, 0.5, 0.5]
    assert (found["JK730"]["kind"], found["JK730"]["index"]) == ("thing", 3)


def test_a_row_leads_to_its_finding() -> None:
    page = page_of(ENGINE)
    placed = [f for f in page.findings if "data-finding" in f]
    held = page.data["level"]["findings"]
    assert len(placed) == len(held) > 1
    for row in placed:
        assert held[int(row["data-finding"] or "")]["severity"] == (row["class"] or "").split()[0]
    assert sorted(int(row["data-finding"] or "") for row in placed) == list(range(len(held)))


def test_every_finding_of_lint_is_on_the_page(capsys: pytest.CaptureFixture[str]) -> None:
    main(["lint", ENGINE, "--format", "json"])
    said = json.loads(capsys.readouterr().out)["diagnostics"]
    page = page_of(ENGINE)
    assert len(page.findings) == len(said) > 0
    assert [f["class"].split()[0] for f in page.findings] == [each["severity"] for each in said]  # type: ignore[union-attr]
    assert all(each["message"] in page.text for each in said)


def test_ledges_and_basins_are_those_of_the_facts() -> None:
    facts = LevelFacts(jktools.load(ENGINE))
    player = next(each for each in facts.bodies if each.hovers and each.body.player)
    basins = [(b.surfaces, b.is_inescapable) for b in facts.basins(player)]
    body = next(b for b in page_of(ENGINE).data["level"]["bodies"] if b["name"] == "walkplayer")
    assert [(tuple(b["surfaces"]), b["stuck"]) for b in body["basins"]] == basins
    assert any(stuck for _, stuck in basins)
    ends, kinds = numbers(body["ends"], "<f4").reshape(-1, 6), numbers(body["kind"], "u1")
    assert len(ends) == len(kinds) > 0
    # The rim of the pit is a square of 1 JKU in sector 0's floor: each of its edges falls.
    falls = np.linalg.norm(ends[kinds == 2][:, 3:] - ends[kinds == 2][:, :3], axis=1)
    assert falls.sum() == pytest.approx(1.0, abs=1e-5)


def test_views_are_those_of_the_mesh() -> None:
    level = jktools.load("fixtures/smithdev/smithdev.gob!jkl/smithdev.jkl")
    held = page_of("fixtures/smithdev/smithdev.gob").data["level"]
    seen = LevelFacts(level).visibility
    bits = np.unpackbits(numbers(held["views"], "u1").reshape(len(seen.matrix), -1), axis=1, bitorder="little")
    assert (bits[:, : len(seen.matrix)].astype(bool) == seen.matrix).all()


def test_a_page_asks_for_nothing_and_stays_the_same(here: Path) -> None:
    page = page_of(ENGINE)
    text = Path("page.html").read_bytes()
    assert page.links == [] and b"://" not in text
    assert b"default-src 'none'" in text
    page_of(ENGINE)
    assert Path("page.html").read_bytes() == text


def test_names_in_a_level_cannot_end_the_script_or_add_to_the_page(here: Path) -> None:
    evil = "</script><img/src=x>"
    Path("evil.jkl").write_text(TWO_ROOMS.replace("1: ghost ghost ", f"1: ghost {evil} "))
    assert evil in Path("evil.jkl").read_text()
    page = page_of("evil.jkl")
    assert "img" not in page.tags
    assert [t["name"] for t in page.data["level"]["things"]][1] == evil


def test_a_level_that_cannot_be_compiled_has_its_findings(here: Path) -> None:
    Path("broken.jkl").write_text(REFUSED)
    page = page_of("broken.jkl")
    assert "Nothing is drawn: cannot compile broken.jkl" in page.text
    assert page.data == {} and len(page.findings) > 0


def test_several_levels_have_an_index(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("mod.gob").write_bytes(gob_of([(f"jkl/{n}.jkl", MISMATCH.encode("latin-1")) for n in ("a", "b & c")]))
    assert main(["report", "mod.gob", "-o", "out"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "mod.gob!jkl/a.jkl -> out/a.html", "mod.gob!jkl/b & c.jkl -> out/b & c.html", "index -> out/index.html",
    ]  # fmt: skip
    index = Page(Path("out/index.html").read_text("utf-8"))
    assert index.links == ["a.html", "b%20%26%20c.html"]
    assert "1 error" in index.text


def test_a_compiled_level_is_drawn_without_findings(here: Path) -> None:
    main(["build", ENGINE, "-o", "engine.jklb", "-q"])
    page = page_of("engine.jklb")
    assert page.findings == []
    held, from_source = page.data["level"], page_of(ENGINE).data["level"]
    assert {k: v for k, v in held.items() if k != "findings"} == {
        k: v for k, v in from_source.items() if k != "findings"
    }


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["no.jkl", "-o", "out"], "cannot read no.jkl: no such file or folder"),
        (["."], "Missing option '-o'"),
        ([ENGINE, "-o", "taken.txt/x.html"], "cannot write below taken.txt: it is a file, not a folder"),
        (["fixtures", "-o", "one.html"], "name a folder"),
        (["bad.jklb", "-o", "out"], "cannot read bad.jklb: "),
    ],
)
def test_what_cannot_be_done_is_said(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("taken.txt").write_text("")
    Path("bad.jklb").write_bytes(b"\0" * 64)
    assert main(["report", *words]) == 2
    assert said in capsys.readouterr().err


def test_one_level_that_cannot_be_read_loses_no_other(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("rooms.jkl").write_text(TWO_ROOMS)
    assert main(["report", "no.jkl", "rooms.jkl", "-o", "out"]) == 2
    assert "rooms.jkl -> out/rooms.html" in capsys.readouterr().out
    assert Path("out/rooms.html").exists()


def test_a_bug_on_one_level_loses_no_other(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from jktools.session import reporting  # noqa: PLC0415 (its function is replaced)

    def page_of(level: jktools.Level, *rest: Any) -> Any:
        if level.path == "a.jkl":
            raise ZeroDivisionError("boom")
        return whole(level, *rest)

    whole = reporting.page_of
    monkeypatch.setattr(reporting, "page_of", page_of)
    for name in ("a.jkl", "b.jkl"):
        Path(name).write_text(TWO_ROOMS)
    assert main(["report", "a.jkl", "b.jkl", "-o", "out"]) == 3
    shown = capsys.readouterr()
    assert "a.jkl: jktools failed on this file: ZeroDivisionError: boom" in shown.err
    assert shown.out == "b.jkl -> out/b.html\n"


def test_no_line_of_the_script_is_long_code_in_disguise() -> None:
    """The viewer is ours and is read by people: nothing minified, no other site."""
    lines = (ROOT / "jktools/emit/html/viewer.js").read_text().splitlines()
    assert max(map(len, lines)) <= 220
    assert not re.search(r"https?://|eval\(|innerHTML", "\n".join(lines))


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not at hand")
def test_the_script_parses() -> None:
    subprocess.run(["node", "--check", str(ROOT / "jktools/emit/html/viewer.js")], check=True)
