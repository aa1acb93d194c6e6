"""The planted faults of fixtures/broken: each is found, nothing else is, and the reports read as they are kept.

`python -m tests.linter.test_broken` writes the kept reports anew; read what changed.
"""

from __future__ import annotations

import json
import re
from collections import Counter

import pytest

from fixtures.broken import make
from jktools import __version__
from jktools.cli import main
from tests.support.levels import ROOT

BROKEN = ROOT / "fixtures/broken"
REPORTS = ROOT / "tests/data/broken"
EXPECTED = json.loads((BROKEN / "expected.json").read_text("ascii"))
FAMILIES = list(EXPECTED)
OPTIONS = {"references": ["--base", "fixtures/broken/game"]}
BINARY = {".mat", ".wav"}
VERSION = "VERSION"


def report(family: str, form: str) -> tuple[list[str], str]:
    """The command, and the file that keeps what it prints from the root of the project."""
    command = ["lint", f"fixtures/broken/{family}", *OPTIONS.get(family, []), "--config", "none", "--format", form]
    return command, f"{family}.{'txt' if form == 'text' else form}"


def without_version(text: str) -> str:
    return text.replace(f'"version": "{__version__}"', f'"version": "{VERSION}"')


def planted(family: str) -> Counter[tuple[str, str, str]]:
    """Place, code and reason of each comment `JK201: ...`; it speaks for the next line that is no such comment."""
    found: Counter[tuple[str, str, str]] = Counter()
    for path in sorted(p for p in (BROKEN / family).rglob("*.*") if p.suffix not in BINARY):
        waiting: list[tuple[str, str]] = []
        for number, line in enumerate(path.read_text("ascii").split("\n"), 1):
            comment = re.fullmatch(r"\s*(?:#|//) (JK\d{3}): (.*)", line)
            if comment:
                waiting.append((comment[1], comment[2]))
            else:
                place = f"{path.relative_to(BROKEN / family).as_posix()}:{number}"
                found.update((place, code, reason) for code, reason in waiting)
                waiting = []
        assert not waiting, path
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
        place = f"{entry['path'].removeprefix(f'fixtures/broken/{family}/')}:{entry['line']}"
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
    assert without_version(capsys.readouterr().out) == (REPORTS / kept).read_text("ascii")


def test_every_family_of_rules_is_there() -> None:
    codes = {entry["code"][2] for entries in EXPECTED.values() for entry in entries}
    assert codes == set("012345678")


def test_what_is_no_text_is_what_its_generator_makes() -> None:
    assert {name: (BROKEN / name).read_bytes() for name in make.FILES} == make.FILES
    assert {p.relative_to(BROKEN).as_posix() for p in BROKEN.rglob("*.*") if p.suffix in BINARY} == set(make.FILES)


if __name__ == "__main__":
    for each in FAMILIES:
        for style in ("text", "json"):
            arguments, name = report(each, style)
            main([*arguments, "--output", str(REPORTS / name)])
            (REPORTS / name).write_text(without_version((REPORTS / name).read_text("ascii")), "ascii", newline="\n")
