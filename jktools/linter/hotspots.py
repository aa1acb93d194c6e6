"""Where findings about sight hotspots point, and what they say of a call."""

from __future__ import annotations

from jktools.diagnostics import Label, Subject
from jktools.facts import LevelFacts
from jktools.facts.hotspots import Hotspot, Runner, frequency, mean_work
from jktools.model import Cog, Template, Thing


def place_of(runner: Runner) -> Label:
    """The line that makes a script run; for one that the game's own files make run, the script."""
    owner = _owner(runner)
    return runner.script.label(runner.script.script.code) if owner is None else Label(owner.head_span)


def subject_of(runner: Runner) -> Subject | None:
    """What a finding about a script is about."""
    owner = _owner(runner)
    return None if owner is None else owner.subject


def _owner(runner: Runner) -> Cog | Thing | Template | None:
    if runner.cog is not None:
        return runner.cog
    if runner.things:
        return runner.things[0]
    return None if runner.template is None else runner.template.owner


def ours(facts: LevelFacts) -> list[Hotspot]:
    """The hotspots that the level's maker can mend: those of scripts that come with the level."""
    return [spot for spot in facts.hotspots if facts.is_own_script(spot.runner.name)]


def call_label(spot: Hotspot) -> Label:
    """The call, with its share."""
    cost = spot.cost
    often = frequency(spot.calls_per_second, spot.more, spot.causes)
    return spot.runner.script.label(
        spot.site.call,
        f"{often}; {mean_work(cost)}, {cost.most_surfaces} at most",
    )
