"""`lint --format sarif`, `github` and `junit`: the same findings for other readers."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from urllib.parse import unquote
from xml.etree import ElementTree

import pytest

from jktools.cli import main
from tests.support.levels import TWO_ROOMS, gob_of, two_rooms

BROKEN = two_rooms("World adjoins 2", "1: 0x7 1 1", "Sector 0", "CollideBox .1 .1 .1 .9 1.25 .9")
"""An error (JK201, with a second place) and a warning (JK301)."""
LINE = BROKEN.split("\n").index("0: 0x7 1 1") + 1


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fine rooms, 100%.jkl").write_text(TWO_ROOMS)
    (tmp_path / "broken.jkl").write_text(BROKEN)
    (tmp_path / "mod.gob").write_bytes(gob_of([("jkl/rooms.jkl", BROKEN.encode("latin-1"))]))
    return tmp_path


def report(words: str, capsys: pytest.CaptureFixture[str], status: int = 1) -> str:
    assert main(words.split()) == status
    return capsys.readouterr().out


def sarif(words: str, capsys: pytest.CaptureFixture[str], status: int = 1) -> dict[str, Any]:
    log = json.loads(report(f"lint --format sarif {words}", capsys, status))
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    assert isinstance(run, dict)
    return run


def place(run: dict[str, Any], location: dict[str, Any]) -> tuple[str, int, int, int, int]:
    """Path and region of a location, whose index must name the same file."""
    physical = location["physicalLocation"]
    artifact, region = physical["artifactLocation"], physical["region"]
    assert run["artifacts"][artifact["index"]]["location"]["uri"] == artifact["uri"]
    keys = ("startLine", "startColumn", "endLine", "endColumn")
    return (unquote(artifact["uri"]), *(region[key] for key in keys))


def test_sarif_says_what_the_json_says(capsys: pytest.CaptureFixture[str]) -> None:
    said = json.loads(report("lint --format json .", capsys))["diagnostics"]
    run = sarif(".", capsys)
    rules = run["tool"]["driver"]["rules"]
    results = [
        (rules[r["ruleIndex"]]["id"], r["ruleId"], r["level"], *place(run, r["locations"][0])) for r in run["results"]
    ]
    keys = ("code", "code", "severity", "path", "line", "column", "end_line", "end_column")
    assert results == [tuple(each[key] for key in keys) for each in said]
    assert [r["message"]["text"].split("\n")[0] for r in run["results"]] == [each["message"] for each in said]
    assert [rule["id"] for rule in rules] == ["JK201", "JK301"]
    assert all(rule["help"]["text"].startswith(rule["shortDescription"]["text"]) for rule in rules)


def test_sarif_tells_the_other_places(capsys: pytest.CaptureFixture[str]) -> None:
    run = sarif("broken.jkl --select JK201", capsys)
    (other,) = run["results"][0]["relatedLocations"]
    assert place(run, other) == ("broken.jkl", LINE + 1, 8, LINE + 1, 9)
    assert other["message"]["text"] == "adjoin 1 names 1"


def test_sarif_puts_what_lies_in_a_pack_into_the_artifact_of_the_pack(capsys: pytest.CaptureFixture[str]) -> None:
    run = sarif("mod.gob", capsys)
    pack, level = run["artifacts"]
    assert (pack["location"]["uri"], "parentIndex" in pack) == ("mod.gob", False)
    assert (level["location"]["uri"], level["parentIndex"]) == ("mod.gob!jkl/rooms.jkl", 0)


def test_sarif_names_every_file_as_an_address(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (relative,) = sarif("--select JK2 fine*.jkl".replace("fine*.jkl", "."), capsys)["artifacts"][-1:]
    assert relative["location"] == {"uri": "fine%20rooms%2C%20100%25.jkl", "uriBaseId": "%SRCROOT%"}
    (absolute,) = sarif(f"{here}/broken.jkl", capsys)["artifacts"]
    assert absolute["location"] == {"uri": f"file://{here}/broken.jkl"}


def test_sarif_tells_what_could_not_be_read(capsys: pytest.CaptureFixture[str]) -> None:
    (invocation,) = sarif("broken.jkl no.jkl", capsys, 2)["invocations"]
    assert invocation["executionSuccessful"] is False
    (told,) = invocation["toolExecutionNotifications"]
    assert told["message"]["text"] == "cannot read no.jkl: no such file or folder"
    assert sarif("broken.jkl", capsys)["invocations"] == [{"executionSuccessful": True}]


def test_a_fingerprint_stays_when_lines_move(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def fingerprints() -> list[str]:
        return [r["partialFingerprints"]["primaryLocationLineHash"] for r in sarif("broken.jkl", capsys)["results"]]

    before = fingerprints()
    assert len(set(before)) == len(before) == 2
    (here / "broken.jkl").write_text("# a comment\n" + BROKEN.replace("0: 0x7 1 1", "0:  0x7   1 1"))
    assert fingerprints() == before
    (here / "broken.jkl").write_text(BROKEN.replace("0: 0x7 1 1", "0: 0x3 1 1"))
    assert fingerprints()[0] != before[0]


def test_github_gets_a_command_for_each_finding(capsys: pytest.CaptureFixture[str]) -> None:
    first, second, count = report("lint --format github broken.jkl", capsys).splitlines()
    place = f"file=broken.jkl,line={LINE},endLine={LINE},col=8,endColumn=9"
    assert first.startswith(f"::error {place},title=JK201 adjoin-mirror-mismatch::adjoin 0")
    assert "%0Ahelp: " in first
    assert second.startswith("::warning file=broken.jkl,line=")
    assert count == "1 error, 1 warning in 1 file"


def test_github_puts_what_lies_in_a_pack_on_the_pack(capsys: pytest.CaptureFixture[str]) -> None:
    first = report("lint --format github --select JK201 mod.gob", capsys).splitlines()[0]
    assert first.startswith(
        f"::error file=mod.gob,title=JK201 adjoin-mirror-mismatch::jkl/rooms.jkl:{LINE}:8: adjoin 0"
    )


def test_github_gets_no_command_that_a_file_made_up(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Names of files end up in properties, where a comma or a line break would begin something else."""
    (here / "a,line=1%0A.jkl").write_text(BROKEN)
    report("lint --format github .", capsys)
    main(["lint", "--format", "github", "a,line=1%0A.jkl", "--select", "JK201"])
    assert capsys.readouterr().out.startswith("::error file=a%2Cline=1%250A.jkl,line=")


def test_junit_fails_what_makes_the_run_fail(capsys: pytest.CaptureFixture[str]) -> None:
    for threshold, failing in (("warning", ["error", "warning"]), ("error", ["error"])):
        root = ElementTree.fromstring(report(f"lint --format junit --fail-on {threshold} .", capsys))
        suites = {suite.get("name"): suite for suite in root}
        broken = suites["broken.jkl"]
        assert [f.get("type") for f in broken.iter("failure")] == failing
        assert (broken.get("tests"), broken.get("failures")) == ("2", str(len(failing)))
        assert len(list(broken.iter("system-out"))) == 2 - len(failing)
        (passed,) = suites["fine rooms, 100%.jkl"]
        assert (passed.tag, len(passed)) == ("testcase", 0)
    assert main(["lint", "--format", "junit", "--fail-on", "never", "."]) == 0
    assert "<failure" not in capsys.readouterr().out


def test_junit_tells_what_could_not_be_read(capsys: pytest.CaptureFixture[str]) -> None:
    root = ElementTree.fromstring(report("lint --format junit no.jkl", capsys, 2))
    (error,) = root.iter("error")
    assert error.get("message") == "cannot read no.jkl: no such file or folder"


@pytest.mark.parametrize("form", ["sarif", "github", "junit"])
def test_control_characters_of_a_file_break_no_format(
    form: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "odd.jkl").write_bytes(BROKEN.encode("latin-1").replace(b"0: 0x7 1 1", b"0: 0x7 \x01\x1b[31m\xff 1"))
    out = report(f"lint --format {form} odd.jkl", capsys)
    assert "\x1b" not in out and "\x01" not in out
    if form == "junit":
        ElementTree.fromstring(out)
    if form == "sarif":
        json.loads(out)
