"""`jktools tradeoff` on small levels."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from jktools.cli import main
from jktools.engine.profile import Engine
from jktools.model import Level
from jktools.tradeoff import Asked, Cell, Plan, Row
from jktools.tradeoff.errors import Error
from jktools.tradeoff.passes import PASSES
from jktools.tradeoff.plot import points_of, to_plot
from jktools.tradeoff.worker import Memory
from jktools.tradeoff.write import duration, to_table
from tests.support.levels import ROOT, TWO_ROOMS, level_of, two_rooms

WALKER = (
    "World templates 3",
    "walkplayer none type=player collide=1 move=physics size=.065 movesize=.065 height=.12 mass=150 maxthrust=2 "
    "maxvel=1 jumpspeed=1.5 physflags=0x4A4F surfdrag=3 airdrag=.5 staticdrag=.3",
)


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rooms.jkl").write_text(TWO_ROOMS)
    return tmp_path


def rows() -> list[Row]:
    sight = (
        Cell("fast", [0.002, 0.001, 0.5], Memory(9_000_000, 2_250_000), None, 0.1, Error(0.25, {}, "1 of 4 wrong")),
        Cell("balanced", [0.0123456], None, None, None, Error(0.0, {}, "none")),
        Cell("exact", [12.34567], Memory(10**9, 123_456_789), 1_234_567, None, Error(0.0, {}, "none")),
    )
    ledges = (Cell("fast", [3e-6], Memory(1, 1), 7, no_error="exact is not measured"), Cell("exact", not_measured="takes longer than 60 s"))  # noqa: E501  # fmt: skip
    return [
        Row(PASSES["sight"], sight), Row(PASSES["ledges"], ledges), Row(PASSES["motion"], (), "the level has no body"),
    ]  # fmt: skip


def level() -> Level:
    return level_of(TWO_ROOMS, "rooms.jkl")


def test_the_table() -> None:
    plan = Plan(Asked(Engine.RESEARCH, 20_000, 1997), ("sight", "ledges", "motion"))
    assert to_table(level(), plan, rows()) == (
        "rooms.jkl: 2 sectors, 12 surfaces, 2 things; engine research\n"
        "\n"
        "pass    tier         time    memory      bytes  error against exact\n"
        "sight   fast         2 ms    2.2 MB          -  1 of 4 wrong\n"
        "        balanced  12.3 ms         -          -  none\n"
        "        exact      12.3 s  123.5 MB  1,234,567  -\n"
        "ledges  fast         3 µs    0.0 MB          7  not known: exact is not measured\n"
        "        exact           -         -          -  not measured: takes longer than 60 s\n"
        "motion  -                                       nothing to do: the level has no body\n"
        "\n"
        "sight: 20,000 queries, seed 1997; a quarter is aimed at edges and not part of the time\n"
        "time: processor time, the median; memory: what the computation adds to its process at most\n"
    )


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.0009994, "999 µs"), (0.0009996, "1 ms"), (0.99949, "999 ms"), (0.9996, "1 s"), (1234.5, "1234 s"), (0, "0 µs")],
)
def test_durations(seconds: float, text: str) -> None:
    assert duration(seconds) == text


def test_points_of_the_plot() -> None:
    sight, ledges, _ = rows()
    assert points_of(sight) == [("fast", 0.002, 0.25), ("balanced", 0.0123456, 0.0), ("exact", 12.34567, 0.0)]
    assert points_of(ledges) == []


@pytest.mark.parametrize(("suffix", "begins"), [("png", b"\x89PNG"), ("svg", b"<?xml")])
def test_plots_are_the_same_for_the_same(suffix: str, begins: bytes) -> None:
    data = to_plot(rows(), "rooms.jkl", suffix)
    assert data.startswith(begins)
    assert to_plot(rows(), "rooms.jkl", suffix) == data
    assert to_plot([], "nothing", suffix).startswith(begins)


def test_json_keeps_to_its_schema(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "walk.jkl").write_text(two_rooms(*WALKER))
    chosen = ("sight", "visibility", "ledges", "basins", "motion", "geometry")
    words = ["--passes", ",".join(chosen), "--queries", "80", "--json", "-o", "plot.svg"]
    assert main(["tradeoff", "walk.jkl", *words]) == 0
    report = json.loads(capsys.readouterr().out)
    schema = json.loads((ROOT / "docs/tradeoff.schema.json").read_text())
    jsonschema.validate(report, schema)
    assert [each["name"] for each in report["passes"]] == list(chosen)
    measured = {each["name"]: each for each in report["passes"] if each["tiers"]}
    assert set(measured) >= set(chosen) - {"basins"}
    kinds = ("queries", "visibility", "ledges", "basins", "motion", "geometry")
    for name, each in measured.items():
        for cell in each["tiers"]:
            fits = [
                k
                for k in kinds
                if cell["error"] and set(cell["error"]["measures"]) <= set(schema["$defs"][k]["properties"])
            ]
            assert fits == ["queries" if name == "sight" else name]
    assert (here / "plot.svg").read_bytes().startswith(b"<?xml")


def test_json_of_what_is_not_measured(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--passes", "sight,ledges", "--queries", "40", "--time-limit", "1e-9", "--json"]
    assert main(["tradeoff", "rooms.jkl", *words]) == 0
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/tradeoff.schema.json").read_text()))
    for cell in (cell for each in report["passes"] for cell in each["tiers"]):
        assert cell["not_measured"] == "takes longer than 1e-09 s"
        assert (cell["seconds"], cell["memory"], cell["bytes"], cell["error"]) == (None, None, None, None)


def test_nothing_is_plotted_where_no_error_is_known(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["tradeoff", "rooms.jkl", "--passes", "sight", "--tiers", "fast", "--queries", "4", "-o", "a.png"]) == 0
    assert "note: a.png is not written: there is no pass whose time and error are known" in capsys.readouterr().err
    assert not (here / "a.png").exists()


def test_options_choose(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["tradeoff", "rooms.jkl", "--passes", "visibility, sight", "--tiers", "exact,fast", "--queries", "40"]
    assert main([*words, "--engine", "openjkdf2"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "rooms.jkl: 2 sectors, 12 surfaces, 2 things; engine openjkdf2"
    assert [line.split()[0] for line in lines[3:7]] == ["sight", "exact", "visibility", "exact"]


@pytest.mark.parametrize(
    ("words", "status", "message"),
    [
        (["no.jkl"], 2, "no.jkl"),
        (["rooms.jkl", "--passes", "site"], 2, "'site' is none of location, sight, drop, visibility, ledges"),
        (["rooms.jkl", "--tiers", "best"], 2, "'best' is none of fast, balanced, exact"),
        (["rooms.jkl", "--passes", ""], 2, "'' is none of"),
        (["rooms.jkl", "-o", "plot.gif"], 2, "plot.gif names no format: .png or .svg"),
        (["rooms.jkl", "-o", "no/such/plot.svg"], 2, "there is no folder no/such to write plot.svg into"),
        (["rooms.jkl", "--queries", "0"], 2, "0 is not in the range"),
        (["rooms.jkl", "--time-limit", "0"], 2, "0.0 is not in the range"),
        (["broken.jkl"], 1, "cannot compile broken.jkl: the engine refuses it"),
        (["static.jkl"], 1, "cannot compile static.jkl: it has no GEORESOURCE"),
    ],
)
def test_bad_input_gets_one_error(
    here: Path, words: list[str], status: int, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "broken.jkl").write_text(two_rooms("World adjoins 2", "- 1: 0x7 0 1"))
    (here / "static.jkl").write_text("SECTION: JK\nVERSION 1\n")
    assert main(["tradeoff", *words]) == status
    shown = capsys.readouterr()
    assert message in shown.err
    assert shown.out == ""
    assert shown.err.count("rror:") == 1
