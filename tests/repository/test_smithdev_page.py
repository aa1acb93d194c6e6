"""docs/smithdev.md: its pictures are drawn from the compiled level, the same each time, and the page shows each."""

from __future__ import annotations

import re
from pathlib import Path

from tests.support.levels import ROOT
from tools.smithdev_pictures import FOLDER, PICTURES, main

PAGE = (ROOT / "docs/smithdev.md").read_text("utf-8")


def test_the_pictures_are_current(tmp_path: Path) -> None:
    main(tmp_path)
    drawn = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert drawn.keys() == PICTURES.keys()
    stale = [name for name, data in drawn.items() if (FOLDER / name).read_bytes() != data]
    assert stale == [], "run python -m tools.smithdev_pictures"


def test_the_page_shows_them() -> None:
    shown = re.findall(r"\]\((smithdev/[\w.]+)\)", PAGE)
    assert {f"smithdev/{name}" for name in PICTURES} <= set(shown)
    assert all((ROOT / "docs" / path).is_file() for path in shown)
