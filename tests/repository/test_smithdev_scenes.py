"""docs/smithdev.md: the pictures of colour, light, particles and sight are drawn from the compiled level."""

from __future__ import annotations

from pathlib import Path

from tests.support.levels import ROOT
from tools.smithdev_scenes import FOLDER, PICTURES, main


def test_the_pictures_are_current(tmp_path: Path) -> None:
    main(tmp_path)
    drawn = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert drawn.keys() == PICTURES.keys()
    stale = [name for name, data in drawn.items() if (FOLDER / name).read_bytes() != data]
    assert stale == [], "run python -m tools.smithdev_scenes"


def test_the_page_shows_them() -> None:
    page = (ROOT / "docs/smithdev.md").read_text("utf-8")
    assert [name for name in PICTURES if f"](smithdev/{name})" not in page] == []
