"""Links of the pages lead to files and headings that are there, and so do the paths that they quote."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.levels import ROOT

FOLDERS = "docs|tests|jktools|fixtures|runtime|benchmarks|native|tools|grammars"
PLACEHOLDER = re.compile(r"[A-Z]{4,}")
"""In a path that stands for several, as `fixtures/broken/FAMILY`."""


def pages() -> list[Path]:
    listed = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=False).stdout
    pages = [ROOT / name for name in listed.split() if not name.endswith(".template.md")]
    return [page for page in pages if page.exists()]


def headings(page: Path) -> set[str]:
    """The anchors that a page's headings get."""
    found = re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)
    plain = (re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading) for heading in found)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in plain}


def dead_links(page: Path) -> Iterator[str]:
    prose = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(), flags=re.DOTALL)
    for link in re.findall(r"\[[^\]]*\]\(([^)\s]+)\)", prose):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        if not target.exists() or (anchor and target.suffix == ".md" and anchor not in headings(target)):
            yield link


def dead_paths(page: Path) -> Iterator[str]:
    for path, name in re.findall(rf"`((?:{FOLDERS})/[\w/.\-]+)(?:::(\w+))?`", page.read_text()):
        if PLACEHOLDER.search(path.rpartition("/")[2]) and not (ROOT / path).suffix:
            continue
        target = next((p for p in (ROOT / path, page.parent / path) if p.exists()), None)
        if target is None or (name and name not in target.read_text()):
            yield f"{path}::{name}" if name else path


def test_there_are_pages_with_links() -> None:
    if not (ROOT / ".git").exists():
        pytest.skip("no checkout")
    assert len(pages()) > 20
    assert "the-format" not in headings(ROOT / "README.md") and "commands" in headings(ROOT / "README.md")


def test_every_link_and_path_leads_somewhere(tmp_path: Path) -> None:
    found = {str(page.relative_to(ROOT)): [*dead_links(page), *dead_paths(page)] for page in pages()}
    assert {page: dead for page, dead in found.items() if dead} == {}
    page = tmp_path / "page.md"
    page.write_text(
        "# A heading\n[a](none.md) [b](#a-heading) [c](#none) `tests/none.py` `tests/support/levels.py::absent`\n"
    )
    assert [*dead_links(page), *dead_paths(page)] == [
        "none.md",
        "#none",
        "tests/none.py",
        "tests/support/levels.py::absent",
    ]
