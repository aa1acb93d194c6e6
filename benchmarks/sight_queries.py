"""Real levels, and the queries about them that `jktools tradeoff` asks too."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from jktools.model import Level
from jktools.session import load
from jktools.source import Member, resolve
from jktools.tradeoff.queries import SETS, Queries, near, points, things, through_edges

__all__ = ["CORPUS", "SETS", "Queries", "levels", "near", "points", "things", "through_edges"]

CORPUS = Path(__file__).parents[2] / "shared/corpus"


def levels() -> Iterator[tuple[str, Level]]:
    """Every level of the corpus with more than one sector, by its file name, with the files of its pack."""
    for path in sorted([*CORPUS.glob("jkl/*.jkl"), *CORPUS.glob("gob/*")]):
        target = resolve(str(path))
        members = [target] if isinstance(target, Member) else target.members
        for member in members:
            if member.extension == "jkl":
                level = load(member.path)
                if level.has_geometry and len(level.sectors) > 1:
                    yield f"{path.name}!{member.name}" if len(members) > 1 else path.name, level
