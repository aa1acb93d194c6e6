"""The planted faults of fixtures/broken: each is found, nothing else is, and the reports read as they are kept.

`python -m tests.linter.test_broken` writes the kept reports anew; read what changed.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from pathlib import Path

import pytest

from fixtures.broken import make
from jktools import __version__
from jktools.cli import main
from jktools.linter.registry import rules
from tests.support.levels import ROOT

BROKEN = ROOT / "fixtures/broken"
REPORTS = ROOT / "tests/data/broken"
EXPECTED = json.loads((BROKEN / "expected.json").read_text("ascii"))
FAMILIES = list(EXPECTED)
OFF = [rule.code.id for rule in rules() if not rule.on]
OPTIONS = {
    "references": ["--base", "fixtures/broken/game"],
    "optional": ["--select", ",".join(OFF)],
    "flood": ["--select", "JK009,JK039,JK065"],  # and not each of the thousand
}
NEARLY = BROKEN / "nearly"
LEAST_NEARLY = 140
"""Rules of which a fixture shows what is just allowed."""
BINARY = {".mat", ".wav", ".cmp", ".gob"}
VERSION = "VERSION"

WITHOUT_FIXTURE = {
    "JK901": "tells of a bug in jktools; tests/linter/test_runner.py makes one",
    "JK902": "tells of a bug in jktools; tests/cli/test_robustness.py makes one",
}
"""The rules that no file can raise."""


def report(family: str, form: str) -> tuple[list[str], str]:
    """The command, and the file that keeps what it prints from the root of the project."""
    command = ["lint", f"fixtures/broken/{family}", *OPTIONS.get(family, []), "--config", "none", "--format", form]
    return command, f"{family}.{'txt' if form == 'text' else form}"


def without_version(text: str) -> str:
    return text.replace(f'"version": "{__version__}"', f'"version": "{VERSION}"')


def planted(family: str) -> Counter[tuple[str, str, str]]:
    """Place, code and reason of each fault.

    A comment `JK201: ...` speaks for the next line that is no such comment, `JK514 of the file: ...` for no line. For
    files in which no comment can stand, their generator speaks.
    """
    found: Counter[tuple[str, str, str]] = Counter()
    for path in sorted(p for p in (BROKEN / family).rglob("*.*") if p.suffix not in BINARY):
        waiting: list[tuple[str, str]] = []
        name = path.relative_to(BROKEN / family).as_posix()
        for number, line in enumerate(path.read_bytes().decode("latin-1").split("\n"), 1):
            comment = re.fullmatch(r"\s*(?:#|//) (JK\d{3})( of the file)?: (.*)", line)
            if comment is None:
                found.update((f"{name}:{number}", code, reason) for code, reason in waiting)
                waiting = []
            elif comment[2]:
                found[name, comment[1], comment[3]] += 1
            else:
                waiting.append((comment[1], comment[3]))
        assert not waiting, path
    for path_in_fixtures, fault in make.FAULTY.items():
        owner, _, name = path_in_fixtures.partition("/")
        if owner == family:
            found[f"{name}!{fault.member}" if fault.member else name, fault.code, fault.reason] += 1
    return found


@pytest.mark.parametrize("family", FAMILIES)
def test_every_expected_finding_is_planted_and_says_why(family: str) -> None:
    assert planted(family) == Counter((e["place"], e["code"], e["reason"]) for e in EXPECTED[family])


@pytest.mark.parametrize("family", FAMILIES)
def test_lint_finds_what_is_planted_and_nothing_else(
    family: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    main(report(family, "json")[0])
    found = []
    for entry in json.loads(capsys.readouterr().out)["diagnostics"]:
        place = entry["path"].removeprefix(f"fixtures/broken/{family}/")
        place += f":{entry['line']}" if entry["line"] else ""
        subject = entry["object"]
        found.append((place, entry["code"], subject and f"{subject['kind']} {subject['index']}"))
    assert found == [(e["place"], e["code"], e["object"]) for e in EXPECTED[family]]


@pytest.mark.parametrize("form", ["text", "json"])
@pytest.mark.parametrize("family", FAMILIES)
def test_reports_read_as_kept(
    family: str, form: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    command, kept = report(family, form)
    assert main(command) == 1
    assert without_version(capsys.readouterr().out) == (REPORTS / kept).read_text("utf-8")


def test_every_rule_is_planted_or_says_why_not() -> None:
    codes = {entry["code"] for entries in EXPECTED.values() for entry in entries}
    assert sorted(codes | WITHOUT_FIXTURE.keys()) == [rule.code.id for rule in rules()]
    assert not codes & WITHOUT_FIXTURE.keys()


def test_a_family_plants_what_is_off_or_what_is_on() -> None:
    """The rules that are off are all in one family, which selects them; the others run as they are."""
    codes = {family: {entry["code"] for entry in EXPECTED[family]} for family in FAMILIES}
    assert sorted(codes["optional"]) == OFF


def nearly() -> list[tuple[str, str]]:
    """File and code of each comment `not JK201: ...`: what stands there is just inside what is allowed."""
    return [
        (path.relative_to(NEARLY).as_posix(), code)
        for path in sorted(p for p in NEARLY.rglob("*.*") if p.suffix not in BINARY)
        for code in re.findall(r"(?m)(?:#|//) not (JK\d{3})(?: of the file)?: \S", path.read_bytes().decode("latin-1"))
    ]


def test_what_is_nearly_a_fault_is_none(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """No rule that is on says anything, nor does one that is off where a comment names it."""
    monkeypatch.chdir(ROOT)
    selected = ",".join(rule.code.id for rule in rules())
    main(["lint", "fixtures/broken/nearly", "--config", "none", "--format", "json", "--select", selected])
    found = json.loads(capsys.readouterr().out)["diagnostics"]
    named = nearly()
    told = [(each["path"].removeprefix("fixtures/broken/nearly/"), each["code"], each["line"]) for each in found]
    assert [each for each in told if each[1] not in OFF or each[:2] in named] == []


def test_what_is_nearly_a_fault_is_planted_somewhere() -> None:
    planted_codes = {entry["code"] for entries in EXPECTED.values() for entry in entries}
    codes = {code for _, code in nearly()}
    assert codes <= planted_codes
    assert len(codes) >= LEAST_NEARLY


def test_what_is_no_text_is_what_its_generator_makes() -> None:
    assert [name for name, data in make.FILES.items() if (BROKEN / name).read_bytes() != data] == []
    binary = {p.relative_to(BROKEN).as_posix() for p in BROKEN.rglob("*.*") if p.suffix in BINARY}
    assert binary == {name for name in make.FILES if Path(name).suffix in BINARY}


if __name__ == "__main__":
    for each in FAMILIES:
        for style in ("text", "json"):
            arguments, name = report(each, style)
            main([*arguments, "--output", str(REPORTS / name)])
            (REPORTS / name).write_text(without_version((REPORTS / name).read_text("utf-8")), "utf-8", newline="\n")
