"""Real levels: no false parse error, and as many records as an independent count finds."""

from __future__ import annotations

import re

import pytest

from tests.support.levels import corpus_files, level_of

CORPUS_FILES = list(corpus_files())


def count_records(text: str) -> dict[str, int]:
    """Count the records of a JKL line by line, knowing nothing of the reader.

    A record is a line that is neither empty nor a comment; a block goes from its heading to the next line that
    starts with a letter (labels are digits), or to `end` where names start records.
    """
    counts = dict.fromkeys(("vertices", "surfaces", "adjoins", "sectors", "things", "templates", "cogs"), 0)
    block = None
    for line in text.splitlines():
        line = line.split("#")[0].strip()
        if not line or line.startswith(";"):
            continue
        heading = re.match(r"world\s+(\w+(?:\s+vertices)?)\s+\d+$", line, re.IGNORECASE)
        if heading:
            block = heading[1].lower()
        elif re.match(r"(section:|end$)", line, re.IGNORECASE):
            block = None
        elif re.match(r"sector\s+\d+$", line, re.IGNORECASE):
            counts["sectors"] += 1
        elif block == "surfaces" and len(line.replace(",", " ").split()) == 4:
            block = None  # the normals
        elif block in counts and block != "sectors":
            counts[block] += 1
    return counts


@pytest.mark.skipif(not CORPUS_FILES, reason="the corpus of real mods is not at hand")
@pytest.mark.parametrize(("path", "data"), CORPUS_FILES, ids=[path for path, _ in CORPUS_FILES])
def test_a_real_level_is_read_whole(path: str, data: bytes) -> None:
    level = level_of(data, path, "mots" if ".goo!" in path.lower() else "jk")
    told = [(d.code.id, d.message) for d in level.diagnostics]
    if path.startswith("Phaser"):  # its static.jkl has `5;` where `5:` is meant: a true finding
        assert [code for code, _ in told] == ["JK002"]
    else:
        assert told == []
    assert {
        "vertices": len(level.vertices),
        "surfaces": len(level.surfaces),
        "adjoins": len(level.adjoins),
        "sectors": len(level.sectors),
        "things": len(level.things),
        "templates": len(level.templates),
        "cogs": len(level.cogs),
    } == count_records(data.decode("latin-1"))


def test_the_count_of_this_test_counts() -> None:
    geometry = ["World vertices 2", "0: 1 2 3", "# no", "1: 1 2 3", "World texture vertices 1", "0: 1 2"]
    text = "\n".join([*geometry, "Section: THINGS", "World things 9", "0: a a 1", "end"])
    assert count_records(text) == {
        "vertices": 2, "surfaces": 0, "adjoins": 0, "sectors": 0, "things": 1, "templates": 0, "cogs": 0,
    }  # fmt: skip
