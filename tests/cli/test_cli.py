"""What a user sees: whole outputs, exit statuses, and no traceback whatever the input."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest

import jktools
from jktools.cli import main
from tests.support.levels import ROOT, TWO_ROOMS, gob_of, two_rooms

BROKEN = two_rooms("World adjoins 2", "1: 0x7 1 1", "Sector 0", "CollideBox .1 .1 .1 .9 1.25 .9")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rooms.jkl").write_text(TWO_ROOMS)
    (tmp_path / "broken.jkl").write_text(BROKEN)
    return tmp_path


def test_the_whole_text_report(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lint", "broken.jkl"]) == 1
    assert capsys.readouterr().out == (ROOT / "tests/data/broken.txt").read_text()


def test_the_whole_json_report(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lint", "--format", "json", "broken.jkl"]) == 1
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/lint.schema.json").read_text()))
    assert report["summary"] == {"files": 1, "error": 1, "warning": 1, "info": 0}
    first = report["diagnostics"][0]
    line = BROKEN.split("\n").index("0: 0x7 1 1") + 1
    assert (first["code"], first["path"], first["line"], first["column"]) == ("JK201", "broken.jkl", line, 8)
    assert (first["end_line"], first["end_column"]) == (line, 9)
    assert first["object"] == {"kind": "adjoin", "index": 0, "name": None}
    assert first["related"] == [{"path": "broken.jkl", "line": line + 1, "column": 8, "message": "adjoin 1 names 1"}]


@pytest.mark.parametrize(
    ("words", "status"),
    [
        ("lint rooms.jkl", 0),
        ("lint broken.jkl", 1),
        ("lint broken.jkl --fail-on never", 0),
        ("lint broken.jkl --ignore JK201,JK3", 0),
        ("lint broken.jkl --select JK301 --fail-on error", 0),
        ("lint no.jkl", 2),
        ("lint no.jkl broken.jkl", 2),
        ("lint rooms.jkl --select JK999", 2),
        ("lint", 2),
        ("lunt", 2),
        ("build rooms.jkl -o out", 0),
        ("build broken.jkl -o out", 0),
        ("build no.jkl -o out", 2),
        ("inspect rooms.jkl", 2),
        ("explain JK201", 0),
        ("explain adjoin-mirror-mismatch", 0),
        ("explain JK999", 2),
        ("rules", 0),
        ("--version", 0),
        ("--help", 0),
    ],
)
def test_exit_statuses(words: str, status: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words.split()) == status
    assert "Traceback" not in "".join(capsys.readouterr())


def test_one_path_that_cannot_be_read_does_not_lose_the_others(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lint", "no.jkl", "broken.jkl"]) == 2
    shown = capsys.readouterr()
    assert "1 error, 1 warning in 1 file" in shown.out
    assert shown.err == "jktools: error: cannot read no.jkl: no such file or folder\n"


@pytest.mark.parametrize(
    ("name", "data", "status"),
    [
        ("empty.jkl", b"", 1),
        ("garbage.jkl", bytes(range(256)) * 100, 1),
        ("zeros.jkl", b"\0" * 10_000, 1),
        ("empty.gob", b"", 2),
        ("cut.gob", gob_of([("jkl\\a.jkl", TWO_ROOMS.encode())])[:100], 2),
        ("cut_data.gob", gob_of([("jkl\\a.jkl", TWO_ROOMS.encode())])[:-500], 1),
        ("claims.gob", b"GOB \x14\0\0\0\x0c\0\0\0\xff\xff\xff\xff" + b"\0" * 136, 2),
        ("count.jkl", two_rooms("World vertices 2000000000").encode(), 1),
        ("line.jkl", two_rooms("World vertices 12", "3: 0 1 0" + " 1" * 5_000_000).encode(), 1),
        ("none.gob", gob_of([("misc\\a.txt", b"")]), 2),
        ("text.txt", b"hello", 2),
    ],
)
def test_bad_input_is_a_finding_or_status_2_in_bounded_memory(name: str, data: bytes, status: int, here: Path) -> None:
    (here / name).write_bytes(data)
    code = (
        "import resource, sys; resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30));"
        "from jktools.cli import main; sys.exit(main(sys.argv[1:]))"
    )
    for words in (["lint", name], ["build", name, "-o", "out"]):
        done = subprocess.run(
            [sys.executable, "-c", code, *words], capture_output=True, text=True, check=False,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        )  # fmt: skip
        assert done.returncode == status, done.stderr
        assert "Traceback" not in done.stderr
        assert (done.stdout + done.stderr).strip()


def test_build_and_inspect(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "p.gob").write_bytes(
        gob_of([("jkl\\Rooms.jkl", TWO_ROOMS.encode()), ("jkl\\static.jkl", b"Section: MODELS\n")])
    )
    assert main(["build", "p.gob", "-o", "out"]) == 0
    shown = capsys.readouterr()
    assert shown.out.startswith("p.gob!jkl/Rooms.jkl -> out/rooms.jklb (")
    assert "skipped, it has no GEORESOURCE" in shown.err
    assert main(["inspect", "out/rooms.jklb", "--json", "--verify", "--source", "p.gob"]) == 0
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/inspect.schema.json").read_text()))
    assert report["grid"] is None
    sizes = [section["bytes"] for section in report["sections"].values()]
    assert (
        sum(sizes) + sum(report["rest"].values())
        == report["level"]["bytes"]
        == (here / "out/rooms.jklb").stat().st_size
    )
    assert report["counts"]["vertices"] == 12
    assert report["level"]["inputs"][0]["path"] == "jkl/Rooms.jkl"
    assert [p.name for p in (here / "out").iterdir()] == ["rooms.jklb"]
    compiled = jktools.open_compiled("out/rooms.jklb", verify=True)
    assert compiled.vertices.shape == (12, 3)


def test_the_seconds_of_each_pass_are_told(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("one", "two"):
        (here / f"{name}.jkl").write_text(TWO_ROOMS)
    assert main(["build", "one.jkl", "-o", "plain"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 1
    for jobs in ("1", "2"):
        assert main(["build", "one.jkl", "two.jkl", "-o", "out", "-v", "--jobs", jobs, "--skip", "motion"]) == 0
        first, passes, _, _, total = capsys.readouterr().out.splitlines()
        assert first.startswith("one.jkl -> ")
        assert total.startswith("2 levels: ")
        steps = dict(re.findall(r"([a-z_]+) (\d+\.\d{3})", passes.partition(":")[2]))
        ran = [name for name, each in jktools.open_compiled("out/one.jklb").passes.items() if each["ran"]]
        assert {"read", "write", "visibility", *ran} <= set(steps)
        assert "motion" not in steps
        whole = float(passes.strip().partition(" s: ")[0])
        assert whole == pytest.approx(sum(map(float, steps.values())), abs=0.02)
    assert (here / "plain/one.jklb").read_bytes() != (here / "out/one.jklb").read_bytes()


def test_the_step_of_the_grid_is_printed(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "rooms.jkl", "-o", "out", "--accuracy", "fast"]) == 0
    assert "bytes, vertices in steps of 1/16384 JKU)" in capsys.readouterr().out
    assert main(["inspect", "out/rooms.jklb", "--columns"]) == 0
    shown = capsys.readouterr().out
    assert "  vertices: in steps of 1/16384 JKU, moved by at most 1/32768 on each axis\n" in shown
    assert re.search(r"      vertices +144  float32: 12\n", shown), "so few take fewer bytes as they are"
    assert main(["inspect", "out/rooms.jklb", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    jsonschema.validate(report, json.loads((ROOT / "docs/inspect.schema.json").read_text()))
    assert report["grid"] == {"step": 1 / 16384, "moved_at_most": 1 / 32768}


def test_clashing_names_go_into_a_folder_a_pack(here: Path) -> None:
    for pack in ("a", "b"):
        (here / f"{pack}.gob").write_bytes(gob_of([("jkl\\rooms.jkl", TWO_ROOMS.encode())]))
    assert main(["build", "a.gob", "b.gob", "-o", "out", "-q"]) == 0
    assert sorted(p.relative_to(here / "out").as_posix() for p in (here / "out").rglob("*.jklb")) == [
        "a.gob/rooms.jklb",
        "b.gob/rooms.jklb",
    ]


def test_one_level_may_go_into_a_file_of_any_name(here: Path) -> None:
    assert main(["build", "rooms.jkl", "-o", "deep/down/x.jklb", "-q"]) == 0
    assert (here / "deep/down/x.jklb").exists()
    assert main(["build", "rooms.jkl", "broken.jkl", "-o", "x.jklb"]) == 2


def test_a_report_goes_to_a_file_and_colour_only_where_asked(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["lint", "broken.jkl", "--output", "report.txt"])
    assert capsys.readouterr().out == ""
    assert (here / "report.txt").read_text() == (ROOT / "tests/data/broken.txt").read_text()
    main(["lint", "broken.jkl", "--color", "always"])
    assert "\x1b[31m" in capsys.readouterr().out


def imported_by(words: str) -> set[str]:
    code = f"import sys; from jktools.cli import main; main({words.split()!r}); print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stderr.split())


def test_the_version_is_answered_before_anything_is_imported() -> None:
    assert not imported_by("--version") & {"click", "numpy", "lark", "rich", "msgspec"}


def test_lint_and_build_import_nothing_heavy() -> None:
    for words in ("lint rooms.jkl", "build rooms.jkl -o out"):
        loaded = imported_by(words)
        assert "numpy" in loaded
        assert not loaded & {"trimesh", "plotly", "dask", "scipy", "rich"}


def test_a_closed_pipe_is_silent(here: Path) -> None:
    command = f"{sys.executable} -m jktools rules | head -1"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert done.stdout.startswith("JK001")


def test_a_traceback_is_shown_only_on_request(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(*_: object, **options: object) -> None:
        raise ZeroDivisionError("by nought")

    monkeypatch.setattr("jktools.cli.lint.check", fail)
    assert main(["lint", "rooms.jkl"]) == 3
    assert "a bug in jktools: ZeroDivisionError: by nought" in capsys.readouterr().err
    monkeypatch.setenv("JKTOOLS_TRACEBACK", "1")
    with pytest.raises(ZeroDivisionError):
        main(["lint", "rooms.jkl"])
