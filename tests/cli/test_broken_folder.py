"""Every rule's finding in every form: `fixtures/broken` as a whole, and a copy beside packs that are broken."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import jsonschema
import pytest

from fixtures.broken import make
from jktools.cli import main
from jktools.linter.registry import rules
from tests.support.levels import ROOT

FOLDER = "fixtures/broken"
ALL = ",".join(rule.code.id for rule in rules())
MANY = {"JK001", "JK030", "JK051"}
"""Those of which `flood` has a hundred and more; they add nothing but time here."""


@pytest.fixture(autouse=True)
def at_root(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


@cache
def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """What the command line prints into a pipe."""
    command = [sys.executable, "-m", "jktools", "lint", FOLDER, "--config", "none", *arguments]
    return subprocess.run(command, capture_output=True, encoding="utf-8", check=False, cwd=ROOT)


def everything(form: str) -> str:
    done = run("--select", ALL, "--ignore", ",".join(sorted(MANY)), "--base", f"{FOLDER}/game", "--format", form)
    assert (done.returncode, done.stderr) == (1, "")
    return done.stdout


def findings() -> list[dict[str, Any]]:
    report = json.loads(everything("json"))
    jsonschema.validate(report, json.loads((ROOT / "docs/lint.schema.json").read_text()))
    found: list[dict[str, Any]] = report["diagnostics"]
    assert Counter(each["severity"] for each in found) == {
        severity: report["summary"][severity] for severity in ("error", "warning", "info")
    }
    return found


def test_the_folder_raises_nearly_every_rule() -> None:
    """As it was read family by family, plus what only other options raise."""
    codes = {each["code"] for each in findings()}
    assert {rule.code.id for rule in rules()} - codes == {*MANY, "JK901", "JK902"}


def test_each_message_is_one_sentence_of_the_house() -> None:
    """Lower case or a name that is quoted from the file, no full stop, nothing of Python; a cure for each."""
    for each in findings():
        for said in (each["message"], each["help"]):
            assert said, each["code"]
            assert not said.endswith(".") or said.endswith("..."), said
            assert not re.match(r"[A-Z][a-z]", said), said
            assert not re.search(r"\b(None|nan|inf|True|False|np\.|array\(|0x-)\b", said), said


def test_sarif_has_each_finding_at_its_place() -> None:
    said = findings()
    (log,) = json.loads(everything("sarif"))["runs"]
    rows = []
    for result in log["results"]:
        (location,) = result["locations"]
        physical = location["physicalLocation"]
        artifact = log["artifacts"][physical["artifactLocation"]["index"]]
        assert artifact["location"]["uri"] == physical["artifactLocation"]["uri"]
        region = physical.get("region", {})
        assert log["tool"]["driver"]["rules"][result["ruleIndex"]]["id"] == result["ruleId"]
        rows.append((result["ruleId"], region.get("startLine"), region.get("startColumn")))
        for other in result.get("relatedLocations", []):
            assert other["physicalLocation"]["region"]["startLine"] >= 1
    assert rows == [(each["code"], each["line"], each["column"]) for each in said]


def test_the_grammar_alone_finds_the_same() -> None:
    assert run("--strict-grammar", "--format", "json").stdout == run("--format", "json").stdout


def test_github_and_junit_have_as_many() -> None:
    said = findings()
    lines = everything("github").splitlines()
    words = {"error": "error", "warning": "warning", "info": "notice"}
    assert Counter(re.findall(r"(?m)^::(\w+) ", "\n".join(lines))) == Counter(words[each["severity"]] for each in said)
    root = ElementTree.fromstring(everything("junit"))
    failing = [each for each in said if each["severity"] != "info"]
    assert len(list(root.iter("failure"))) == len(failing)


def test_text_has_every_message_and_no_colour_in_a_pipe() -> None:
    text = everything("text")
    assert "\x1b" not in text
    heads = Counter(re.findall(r"(?m)^(?:error|warning|info)\[(JK\d{3})\]: ", text))
    assert heads == Counter(each["code"] for each in findings())


@pytest.mark.parametrize(
    ("arguments", "status", "codes"),
    [
        (("--select", "JK2"), 1, r"JK2\d\d"),
        (("--select", "JK2", "--ignore", "JK2"), 0, "none"),
        (("--select", "JK730,adjoin-mirror-mismatch"), 1, "JK730|JK201"),
        (("--select", "JK730"), 0, "JK730"),
        (("--select", "JK730", "--fail-on", "info"), 1, "JK730"),
        (("--select", "JK201", "--fail-on", "never"), 0, "JK201"),
        (("--select", "JK301", "--fail-on", "error"), 0, "JK301"),
        (("--select", "JK999"), 2, "none"),
    ],
)
def test_what_is_chosen_and_what_fails(
    arguments: tuple[str, ...], status: int, codes: str, capsys: pytest.CaptureFixture[str]
) -> None:
    folders = [f"{FOLDER}/{family}" for family in ("topology", "geometry", "engine")]
    assert main(["lint", *folders, "--config", "none", *arguments]) == status
    out, err = capsys.readouterr()
    found = re.findall(r"(?m)^\w+\[(JK\d{3})\]", out)
    assert all(re.fullmatch(codes, code) for code in found)
    assert bool(found) is (codes != "none")
    assert bool(err) is (status == 2)


def test_a_broken_pack_takes_nothing_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(ROOT / FOLDER / "topology", tmp_path / "topology")
    whole = make.FAULTY["packs/cut.gob"].data
    (tmp_path / "a_garbage.gob").write_bytes(b"GOB " + b"\xff" * 40)
    (tmp_path / "b_empty.gob").write_bytes(b"")
    (tmp_path / "c_directory.gob").write_bytes(whole[:50])
    (tmp_path / "d_zip.zip").write_bytes(b"PK\x03\x04" + bytes(20))
    (tmp_path / "topology/z_cut.gob").write_bytes(whole)
    monkeypatch.chdir(tmp_path)

    def lint(path: str, status: int) -> tuple[list[tuple[str, str, int | None]], str]:
        assert main(["lint", path, "--config", "none", "--format", "json"]) == status
        out, err = capsys.readouterr()
        return [(d["path"], d["code"], d["line"]) for d in json.loads(out)["diagnostics"]], err

    found, told = lint(".", 2)
    alone, _ = lint("topology", 1)
    assert [each for each in found if each[0].startswith("topology")] == alone
    assert ("topology/z_cut.gob!jkl/rooms.jkl", "JK010", None) in alone
    for name in ("a_garbage.gob", "b_empty.gob", "c_directory.gob", "d_zip.zip"):
        assert told.count(f"jktools: error: cannot read {name}: ") == 1
