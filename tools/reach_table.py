"""`docs/reachability.md`: what each level of the corpus can reach, and what cutting the rest saves.

`make counts` writes it where the corpus is at hand.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from jktools.compiler import CompileError, CompileSettings, compilation
from jktools.facts import LevelFacts
from jktools.session import Settings, discover
from jktools.session.levels import read_level

CORPUS = Path(__file__).resolve().parent.parent.parent / "shared" / "corpus"

HEAD = """# Reachable templates

Made by `make counts` from the corpus of real mods (`python -m tools.generate --count`).

A compiled level keeps the templates that the level can reach (`jktools/facts/reachability.py`): from placed things,
placed COGs and what the engine creates by name, through parameters, values of COG symbols and strings in their code.
While one of the COGs that it uses cannot be read, all templates stay: mods ship without the COGs of the game, so that
only a build with `--base` cuts them, and no level of the corpus has its base here. The columns with the cut are those
of `--cut-anyway`.

| level | templates | reached | COGs and lists not at hand | bytes, all kept | bytes, cut anyway | saved |
|---|---|---|---|---|---|---|"""


def reach_table(into: Path) -> Path:
    """Write the page."""
    target = into / "docs/reachability.md"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("\n".join([HEAD, *_rows()]) + "\n")
    return target


def _rows() -> Iterator[str]:
    for member in discover(str(CORPUS)):
        level = read_level(member, Settings())
        if not level.has_geometry:
            continue
        facts = LevelFacts(level)
        reached = sum(facts.reach.has(held) for held in level.resolved_templates.entries)
        try:
            whole, cut = (_bytes(facts, cut_anyway=anyway) for anyway in (False, True))
        except CompileError:
            continue
        name = Path(member.path).relative_to(CORPUS).as_posix()
        yield (
            f"| {name} | {len(level.templates)} | {reached} | {len(facts.reach.unread)} | {whole} | {cut} "
            f"| {100 * (whole - cut) / whole:.0f} % |"
        )


def _bytes(facts: LevelFacts, *, cut_anyway: bool) -> int:
    return len(compilation(facts.level, CompileSettings(cut_anyway=cut_anyway), facts).data)
