"""Which templates a compiled level keeps, and what is said of the rest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from jktools.facts import LevelFacts
from jktools.facts.reachability import Reach
from jktools.model import Template

NAMED = 3
"""Scripts named in a note."""


@dataclass(frozen=True, slots=True)
class Omission:
    """Records of a section that are left out for one reason."""

    section: str
    reason: str
    source: tuple[int, ...]
    names: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Choice:
    """The templates that stay."""

    kept: npt.NDArray[np.intp]
    note: str
    omissions: tuple[Omission, ...]


def choose(facts: LevelFacts, *, cut_anyway: bool = False) -> Choice:
    """Keep the templates that the level can reach.

    While a COG that it uses cannot be read every template that the engine keeps stays, unless `cut_anyway`.
    """
    level = facts.level
    listed = [template for template in level.templates if template.dropped is None]
    dropped = [template for template in level.templates if template.dropped is not None]
    reached, kept = facts.reach, listed
    if reached.is_complete or cut_anyway:
        kept = [template for template in listed if reached.has(template.resolved)]
    left = sorted({t.index for t in listed} - {t.index for t in kept})
    return Choice(
        np.array([template.index for template in kept], np.intp),
        _note(reached, len(listed), len(kept), cut_anyway=cut_anyway),
        tuple(_omissions([level.templates[i] for i in left], dropped)),
    )


def _note(reached: Reach, listed: int, kept: int, *, cut_anyway: bool) -> str:
    names = [each.name for each in reached.unread]
    unread = ", ".join(names[:NAMED]) + (f" and {len(names) - NAMED} more" if len(names) > NAMED else "")
    if reached.is_complete:
        return f"{kept} of {listed} can be reached"
    if cut_anyway:
        return f"{kept} of {listed} can be reached as far as is known: cut anyway, without {unread}"
    return f"all {listed} stay: what they reach is not known without {unread}"


def _omissions(left: list[Template], dropped: list[Template]) -> Iterator[Omission]:
    if left:
        yield _omission("nothing reaches them", left)
    reasons = dict.fromkeys(str(template.dropped) for template in dropped)
    for reason in reasons:
        yield _omission(f"the engine drops them: {reason}", [t for t in dropped if t.dropped == reason])


def _omission(reason: str, templates: list[Template]) -> Omission:
    return Omission("templates", reason, tuple(t.index for t in templates), tuple(t.name for t in templates))
