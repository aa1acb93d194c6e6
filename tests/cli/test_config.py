from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from jktools.cli import main
from jktools.session import ConfigError, find_config, load_config
from tests.support.levels import two_rooms

BROKEN = two_rooms("World adjoins 2", "1: 0x7 1 1", "Sector 0", "CollideBox .1 .1 .1 .9 1.25 .9")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mod").mkdir()
    (tmp_path / "mod/broken.jkl").write_text(BROKEN)
    return tmp_path


def findings(capsys: pytest.CaptureFixture[str], *words: str) -> list[dict[str, Any]]:
    main(["lint", "mod/broken.jkl", "--format", "json", *words])
    report: dict[str, Any] = json.loads(capsys.readouterr().out)
    return list(report["diagnostics"])


def configure(text: str) -> None:
    Path("jktools.toml").write_text(text)


def test_it_is_found_upward_from_the_path(here: Path) -> None:
    assert find_config("mod/broken.jkl") is None
    configure("")
    assert find_config("mod/broken.jkl!x") == here / "jktools.toml"
    Path("mod/pyproject.toml").write_text("[tool.other]\n")
    assert find_config("mod") == here / "jktools.toml"
    Path("mod/pyproject.toml").write_text("[tool.jktools.lint]\nignore = ['JK3']\n")
    assert find_config("mod") == here / "mod/pyproject.toml"
    assert load_config(here / "mod/pyproject.toml").settings.ignore == ("JK3",)


def test_rules_severities_and_options(capsys: pytest.CaptureFixture[str]) -> None:
    assert [(d["code"], d["severity"]) for d in findings(capsys)] == [("JK201", "error"), ("JK301", "warning")]
    configure("[severity]\nJK301 = 'error'\nadjoin-mirror-mismatch = 'info'\n")
    assert [(d["code"], d["severity"]) for d in findings(capsys)] == [("JK201", "info"), ("JK301", "error")]
    configure("[lint]\nignore = ['JK2']\n[rules.JK301]\ndistance = 0.3\n")
    assert findings(capsys) == []
    assert len(findings(capsys, "--config", "none")) == 2


def test_fail_on_and_what_the_command_line_says_wins() -> None:
    configure("[lint]\nselect = ['JK301']\nfail-on = 'error'\n")
    assert main(["lint", "mod/broken.jkl"]) == 0
    assert main(["lint", "mod/broken.jkl", "--fail-on", "warning"]) == 1
    assert main(["lint", "mod/broken.jkl", "--select", "JK201"]) == 1


@pytest.mark.parametrize(
    ("entry", "hidden"),
    [
        ("code = 'JK301'", True),
        ("code = 'JK301'\nobject = 'sector 0'", True),
        ("code = 'JK301'\nobject = 'sector 1'", False),
        ("code = 'JK301'\npath = 'broken.jkl'", True),
        ("code = 'JK301'\npath = 'MOD/*.jkl'", True),
        ("code = 'JK301'\npath = 'roken.jkl'", False),
        ("code = 'collidebox-outside-sector'\nreason = 'known'", True),
    ],
)
def test_findings_hidden_by_object(capsys: pytest.CaptureFixture[str], entry: str, hidden: bool) -> None:
    configure(f"[[ignore]]\n{entry}\n")
    assert ("JK301" not in {d["code"] for d in findings(capsys)}) == hidden


def test_an_entry_that_hides_nothing_is_a_finding_where_its_rule_ran(capsys: pytest.CaptureFixture[str]) -> None:
    configure("game = 'jk'\n\n[[ignore]]\ncode = 'JK301'\nobject = 'sector 1'\n")
    (told,) = [d for d in findings(capsys) if d["code"] == "JK020"]
    assert Path(told["path"]).name == "jktools.toml"
    assert told["line"] == 3
    assert [d["code"] for d in findings(capsys, "--select", "JK201")] == ["JK201"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("gmae = 'jk'", "gmae"),
        ("game = 'quake'", "$.game"),
        ("[rules.JK301]\ndistanse = 1", "distanse"),
        ("[rules.JK301]\ndistance = -1", "of rules.JK301"),
        ("[rules.JK201]\ndistance = 1", "rule JK201 has no options"),
        ("[severity]\nJK999 = 'error'", "no rule is called JK999"),
        ("[lint", "cannot read"),
    ],
)
def test_a_bad_configuration_is_one_sentence_and_status_2(
    text: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    configure(text)
    assert main(["lint", "mod/broken.jkl"]) == 2
    shown = capsys.readouterr().err
    assert shown.startswith("jktools: error: cannot ")
    assert "jktools.toml" in shown
    assert message in shown
    assert len(shown.splitlines()) == 1


def test_a_configuration_that_is_not_there(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lint", "mod/broken.jkl", "--config", "no.toml"]) == 2
    assert "cannot read no.toml: no such file" in capsys.readouterr().err
    with pytest.raises(ConfigError):
        load_config(Path("no.toml"))


def test_each_path_has_the_configuration_above_it(capsys: pytest.CaptureFixture[str]) -> None:
    Path("other").mkdir()
    Path("other/broken.jkl").write_text(BROKEN)
    Path("other/jktools.toml").write_text("[lint]\nignore = ['JK301']\n")
    found = findings(capsys, "other")
    assert [(d["code"], d["path"]) for d in found] == [
        ("JK201", "mod/broken.jkl"), ("JK301", "mod/broken.jkl"), ("JK201", "other/broken.jkl"),
    ]  # fmt: skip


def test_own_verbs_are_read_and_checked() -> None:
    configure("[cog.verbs]\nJackLogVel = { args = ['thing', 'flex'], returns = 'int' }\n")
    verb = load_config(Path("jktools.toml")).settings.verbs["jacklogvel"]
    assert ([a.kind for a in verb.args], verb.returns, verb.sleeps) == (["thing", "flex"], "int", False)
    for wrong, told in (
        ("logit = { args = ['thin'] }", "cog.verbs.logit"),
        ("logit = { arguments = [] }", "arguments"),
        ("logit = { returns = 'number' }", "cog.verbs.logit"),
        ("'log it' = {}", '"log it" cannot be called by a script'),
    ):
        configure(f"[cog.verbs]\n{wrong}\n")
        with pytest.raises(ConfigError, match=told):
            load_config(Path("jktools.toml"))
