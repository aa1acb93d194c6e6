"""The passes of the compiler: each computes one section of the file, or says why the scene does not need it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

from jktools.compiler import scene, sections, walkability
from jktools.compiler.cut import Omission
from jktools.compiler.errors import PassError
from jktools.compiler.sections import Columns, Cut, NotNeeded, Strings
from jktools.compiler.settings import CompileSettings
from jktools.facts import LevelFacts

Compute = Callable[[LevelFacts, Strings, CompileSettings], Columns | Cut | NotNeeded]
Progress = Callable[[str], None]
"""Told the name of each pass before it runs."""


@dataclass(frozen=True, slots=True)
class Pass:
    """One pass; its section in the file has its name."""

    name: str
    compute: Compute
    needs: tuple[str, ...] = ()
    """Passes whose sections its own refers to: when one of them is left out, so is this."""
    optional: bool = True
    """Whether a level is one without it."""


PASSES: Mapping[str, Pass] = {
    each.name: each
    for each in (
        Pass("resources", sections.resources, optional=False),
        Pass("geometry", sections.geometry, ("resources",), optional=False),
        Pass("templates", sections.templates),
        Pass("things", sections.things, ("geometry",)),
        Pass("cogs", sections.cogs),
        Pass("visibility", sections.visibility, ("geometry",)),
        Pass("hotspots", scene.hotspots, ("resources",)),
        Pass("lights", scene.lights, ("geometry", "things")),
        Pass("particles", scene.particles, ("templates",)),
        Pass("colour_effects", scene.colour_effects, ("resources",)),
        Pass("motion", scene.motion, ("templates",)),
        Pass("ledges", walkability.ledges, ("geometry",)),
        Pass("basins", walkability.basins, ("geometry", "ledges")),
        Pass("models", scene.models, ("templates",)),
        Pass("files", sections.files, optional=False),  # the last: it tells what the others looked for
    )
}
"""In the order of the file; a pass comes after those that it needs."""

CHOICES = tuple(each.name for each in PASSES.values() if each.optional)
"""The passes that can be chosen or left out."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What one pass brought."""

    columns: Columns | None
    note: str = ""
    """Why there are none, or what was left out."""
    failed: bool = False
    omissions: tuple[Omission, ...] = ()


@contextmanager
def at(kind: str, index: int) -> Iterator[None]:
    """Names the object that a pass works on, should it fail there."""
    try:
        yield
    except Exception as error:
        error.add_note(f"{kind} {index}")
        raise


def run(facts: LevelFacts, strings: Strings, settings: CompileSettings, progress: Progress) -> dict[str, Outcome]:
    """Run the passes that the settings choose.

    Raises PassError when one fails, unless the settings say to keep going: then its outcome says so. Raises
    ValueError for a choice that is none.
    """
    unknown = sorted((settings.only | settings.skip) - set(CHOICES))
    if unknown:
        raise ValueError(f"{unknown[0]!r} is no pass that can be chosen: those are {', '.join(CHOICES)}")
    outcomes: dict[str, Outcome] = {}
    for each in PASSES.values():
        why_not = _left_out(each, settings, outcomes)
        if why_not:
            outcomes[each.name] = Outcome(None, why_not)
            continue
        progress(each.name)
        try:
            found = each.compute(facts, strings, settings)
        except Exception as error:
            message = _failure(each, facts, error)
            if not settings.keep_going:
                raise PassError(message) from error
            outcomes[each.name] = Outcome(None, message, failed=True)
            continue
        outcomes[each.name] = _outcome(found)
    return outcomes


def _outcome(found: Columns | Cut | NotNeeded) -> Outcome:
    match found:
        case NotNeeded():
            return Outcome(None, found.reason)
        case Cut():
            return Outcome(found.columns, found.note, omissions=found.omissions)
        case _:
            return Outcome(found)


def _left_out(each: Pass, settings: CompileSettings, before: Mapping[str, Outcome]) -> str:
    if each.name in settings.skip:
        return "left out by --skip"
    if each.optional and settings.only and each.name not in _with_needs(settings.only):
        return "left out by --only"
    missing = [name for name in each.needs if before[name].columns is None]
    return f"needs {missing[0]}, which is absent: {before[missing[0]].note}" if missing else ""


def _with_needs(names: frozenset[str]) -> set[str]:
    """Passes with all those that they need."""
    found: set[str] = set()
    waiting = list(names)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += PASSES[name].needs
    return found


def _failure(each: Pass, facts: LevelFacts, error: Exception) -> str:
    place = "".join(f" at {note}" for note in getattr(error, "__notes__", ()))
    return f"the pass {each.name} failed on {facts.level.path}{place}: {type(error).__name__}: {error}"
