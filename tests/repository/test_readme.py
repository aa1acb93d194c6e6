"""What the README shows is what the program prints; `...` stands for lines left out."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from jktools.cli import main
from tests.support.levels import CORPUS, ROOT

PACK = CORPUS / "gob/masspack.gob"
README = (ROOT / "README.md").read_text()
TRANSCRIPTS = [
    (command, shown.strip("\n"))
    for block in re.findall(r"^```\n(\$ .*?)^```", README, re.MULTILINE | re.DOTALL)
    for command, shown in re.findall(r"^\$ (jktools .*)\n((?:(?!\$ ).*\n)*)", block, re.MULTILINE)
]


MEASURED = (("jktools tradeoff", r"[\d.]+ (?:µs|ms|s|MB)\b"),)
"""What another machine measures otherwise, in what a command prints; columns and lines are as wide as it needs."""


def still(command: str, text: str) -> str:
    """A text without what differs from run to run."""
    for name, pattern in MEASURED:
        if command.startswith(name):
            return re.sub(r"\s+", " ", re.sub(pattern, "*", text)).strip()
    return text


def shows(shown: str, printed: str) -> bool:
    """Whether the pieces between `...` stand in what was printed, in that order and where nothing is left out."""
    pieces = [re.escape(piece.strip("\n")) for piece in re.split(r"^\.\.\.$", shown, flags=re.MULTILINE)]
    return re.fullmatch(r"(?:.*\n)?".join(pieces), printed.strip("\n"), re.DOTALL) is not None


def wrongly_shown(folder: Path, transcripts: list[tuple[str, str]], capsys: pytest.CaptureFixture[str]) -> str:
    """What is printed where the README shows something else."""
    wrong = []
    for command, shown in transcripts:
        main(shlex.split(command)[1:])
        printed = capsys.readouterr().out
        if not shows(still(command, shown), still(command, printed)):
            wrong.append(f"$ {command}\n{printed}")
    return "\n".join(wrong)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder but for what the transcripts read."""
    monkeypatch.chdir(tmp_path)
    Path("fixtures").symlink_to(ROOT / "fixtures")
    if PACK.exists():
        Path(PACK.name).symlink_to(PACK.resolve())
    return tmp_path


@pytest.mark.skipif(not PACK.exists(), reason="the corpus of real mods is not at hand")
def test_transcripts_of_a_real_pack(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    real = [t for t in TRANSCRIPTS if "fixtures/" not in t[0]]
    assert len(real) >= 5
    assert wrongly_shown(folder, real, capsys) == ""


def test_transcripts_of_fixtures(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    own = [t for t in TRANSCRIPTS if "fixtures/" in t[0]]
    assert own
    assert wrongly_shown(folder, own, capsys) == ""
