"""docs/smithdev.md lists every heading of the research document, each with its test or the reason why there is none."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

from fixtures.smithdev.pack import GOB
from jktools.source import Container, resolve
from tests.support.levels import CORPUS, ROOT

DOCUMENT = CORPUS.parent / "seed/jk-engine-research.txt"
PAGE = (ROOT / "docs/smithdev.md").read_text("utf-8")
ROWS = re.findall(r"^\| (?!heading)(.+?) \| (.+) \|$", PAGE.partition("## The document, heading by heading")[2], re.M)
SCRIPTS = re.findall(
    r"^\| ([\w.]+\.cog) \| .+ \| (.+) \|$", PAGE.partition("## The scripts")[2].partition("\n## ")[0], re.M
)
TEST = re.compile(r"((?:tests/[\w/]+/)?test_\w+\.py)::(test_\w+)")
RUNNING_HEADS = {"jk engine research", "2018 bad ass hackers", "table of contents"}
"""What the document prints at the top of its pages; no headings."""
SENTENCES = (
    "the next tests will experiment", "effecthandle = newcoloreffect", "more research is needed",
)  # fmt: skip
"""How lines of the text begin that stand there as headings."""


def titles() -> Counter[str]:
    """The document's headings, as its text has them."""
    found: Counter[str] = Counter()
    for line in DOCUMENT.read_text("utf-8").split("\n"):
        if line.startswith("#"):
            title = re.sub(r"</?\w+>|[*\\]", "", line.lstrip("#")).strip().casefold()
            if title not in RUNNING_HEADS and not title.startswith(SENTENCES):
                found[title] += 1
    return found


@pytest.mark.skipif(not DOCUMENT.exists(), reason="the research document is not at hand")
def test_every_heading_is_listed() -> None:
    assert Counter(heading.rpartition(" > ")[2].casefold() for heading, _ in ROWS) == titles()


def test_every_script_is_listed() -> None:
    pack = resolve(str(GOB))
    assert isinstance(pack, Container)
    packed = [member.name.removeprefix("cog/") for member in pack.members if member.name.startswith("cog/")]
    assert sorted(script for script, _ in SCRIPTS) == sorted(packed)


@pytest.mark.parametrize(("heading", "answer"), ROWS + SCRIPTS)
def test_each_has_tests_that_exist_or_a_reason(heading: str, answer: str) -> None:
    named = TEST.findall(answer)
    for file, name in named:
        path = Path(file) if "/" in file else Path("tests/experiments") / file
        assert re.search(rf"^def {name}\(", (ROOT / path).read_text("utf-8"), re.M), f"{file}::{name}"
    assert "::" not in TEST.sub("", answer)
    assert named or len(answer.split()) > 1


def test_every_experiment_is_in_the_list() -> None:
    listed = {name for _, answer in ROWS for _, name in TEST.findall(answer)}
    modules = {file for _, answer in ROWS for file, _ in TEST.findall(answer)}
    held = sorted(path.name for path in (ROOT / "tests/experiments").glob("test_*.py"))
    assert listed
    assert [name for name in held if name not in modules] == []
