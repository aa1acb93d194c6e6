"""Which templates a compiled level keeps, and what is said of the rest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from jktools.facts import LevelFacts
from jktools.facts.reachability import Reach
from jktools.model import Template
from jktools.model.resources import Kind

NAMED = 3
"""Missing files named in a note."""


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


LISTS: Mapping[str, Kind] = MappingProxyType(
    {
        "sounds": Kind.SOUND, "aiclasses": Kind.AI_CLASS, "models": Kind.MODEL, "sprites": Kind.SPRITE,
        "keyframes": Kind.KEYFRAME, "animclasses": Kind.PUPPET, "soundclasses": Kind.SOUND_CLASS,
        "cogscripts": Kind.COG,
    }
)  # fmt: skip
"""The lists whose entries are looked up by name. Materials and colormaps are counted, so that all of them stay."""


@dataclass(frozen=True, slots=True)
class NameChoice:
    """The names of the plain lists that stay."""

    kept: Mapping[str, tuple[str, ...]]
    """By the key of `Document.lists`."""
    note: str
    omissions: tuple[Omission, ...]


def choose_names(facts: LevelFacts, *, cut_anyway: bool = False) -> NameChoice:
    """Keep the names of files that the level can reach; all of them while a file that may name more is missing."""
    level, reached = facts.level, facts.reach
    kept = {key: level.names(key) for key in level.document.lists}
    unknown = [each.name for each in reached.unread] + list(reached.missing)
    if unknown and not cut_anyway:
        return NameChoice(kept, f"all names stay: what is reached is not known without {_some(unknown)}", ())
    left: list[Omission] = []
    for key, kind in LISTS.items():
        names = kept[key]
        out = [i for i, name in enumerate(names) if name.lower() not in reached.files[kind]]
        kept[key] = tuple(name for i, name in enumerate(names) if i not in set(out))
        if out:
            left.append(Omission("resources", f"nothing reaches these {key}", tuple(out), tuple(names[i] for i in out)))
    count = sum(len(each.source) for each in left)
    return NameChoice(kept, f"names of files that nothing reaches are left out: {count}" if count else "", tuple(left))


def _some(names: Sequence[str]) -> str:
    return ", ".join(names[:NAMED]) + (f" and {len(names) - NAMED} more" if len(names) > NAMED else "")


def _note(reached: Reach, listed: int, kept: int, *, cut_anyway: bool) -> str:
    names = [each.name for each in reached.unread]
    unread = _some(names)
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
