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


def shows(shown: str, printed: str) -> bool:
    """Whether the pieces between `...` stand in what was printed, in that order and where nothing is left out."""
    pieces = [re.escape(piece.strip("\n")) for piece in re.split(r"^\.\.\.$", shown, flags=re.MULTILINE)]
    return re.fullmatch(r"(?:.*\n)?".join(pieces), printed.strip("\n"), re.DOTALL) is not None


@pytest.mark.skipif(not PACK.exists(), reason="the corpus of real mods is not at hand")
def test_transcripts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    Path(PACK.name).symlink_to(PACK.resolve())
    assert len(TRANSCRIPTS) >= 5
    wrong = []
    for command, shown in TRANSCRIPTS:
        main(shlex.split(command)[1:])
        printed = capsys.readouterr().out
        if not shows(shown, printed):
            wrong.append(f"$ {command}\n{printed}")
    assert not wrong, "\n".join(wrong)
