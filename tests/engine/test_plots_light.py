"""The plots of docs/engine.md: drawn twice they are the same, and the page shows each of them."""

from __future__ import annotations

import re
from pathlib import Path

from tools.engine_plots_light import PLOTS, ROOT, draw


def test_the_same_bytes_each_time(tmp_path: Path) -> None:
    first, second = (draw(tmp_path / name) for name in ("a", "b"))
    assert [path.read_bytes() for path in first] == [path.read_bytes() for path in second]
    assert all(b"<svg" in path.read_bytes() for path in first)


def test_the_page_shows_them() -> None:
    shown = re.findall(r"\]\((engine/\w+\.svg)\)", (ROOT / "docs/engine.md").read_text())
    assert {f"engine/{name}" for name in PLOTS} <= set(shown)
    assert all((ROOT / "docs" / path).is_file() for path in shown)
