"""The phrases that messages share."""

from __future__ import annotations

import pytest

from jktools.diagnostics.wording import counted, miscounted, numbered


@pytest.mark.parametrize(("count", "said"), [
    (0, "no vertices"), (1, "vertex 0 alone"), (2, "the vertices 0 to 1"), (13, "the vertices 0 to 12"),
])  # fmt: skip
def test_what_there_is_to_name(count: int, said: str) -> None:
    assert numbered(count, "vertex", "vertices") == said


@pytest.mark.parametrize(("count", "said"), [(0, "0 joints"), (1, "1 joint"), (2, "2 joints")])
def test_how_many_there_are(count: int, said: str) -> None:
    assert counted(count, "joint") == said


@pytest.mark.parametrize(("found", "said"), [(0, "0 follow"), (1, "1 follows"), (2, "2 follow")])
def test_a_heading_that_is_wrong(found: int, said: str) -> None:
    assert miscounted(3, "vertices", found) == f"the heading announces 3 vertices, but {said}"
