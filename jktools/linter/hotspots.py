"""Where findings about sight hotspots point, and what they say of a call."""

from __future__ import annotations

from jktools.diagnostics import Label, Subject
from jktools.facts.hotspots import Hotspot, Runner


def place_of(runner: Runner) -> Label:
    """The line that makes a script run."""
    return Label(runner.cog.head_span if runner.cog is not None else runner.things[0].head_span)


def subject_of(runner: Runner) -> Subject:
    """What a finding about a script is about."""
    return runner.cog.subject if runner.cog is not None else runner.things[0].subject


def call_label(spot: Hotspot) -> Label:
    """The call, with its share."""
    calls = spot.calls_per_second
    often = "any number of times" if calls == float("inf") else f"{calls:.6g} times"
    cost = spot.cost
    return spot.runner.script.label(
        spot.site.call,
        f"{often} a second, {cost.mean_surfaces:.6g} surfaces in {cost.mean_sectors:.6g} sectors on the mean, "
        f"{cost.most_surfaces} at most",
    )
