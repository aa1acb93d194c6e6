"""What the analysis says of a script against what the machine does with it."""

from __future__ import annotations

import math
import random

from jktools.facts.cog import ranges
from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.ranges import Range
from jktools.model.cog import values
from jktools.model.cog.program import Program
from jktools.model.cog.values import Value
from tests.support.cog_machine import OWN_NUMBER, Log, Machine

SECONDS = 60.0


def holds(known: Range, value: Value | None) -> bool:
    """Whether a value lies in a range."""
    if value is None:
        return known == ranges.ANY
    if isinstance(value, values.Vector):
        return bool(known.kinds & ranges.VECTOR)
    if isinstance(value, values.String):
        return bool(known.kinds & ranges.STRING)
    if not known.kinds & (ranges.INT if isinstance(value, int) else ranges.FLEX):
        return False
    return known == ranges.ANY_FLEX or known.low <= value <= known.high or (math.isnan(value) and not known.is_known)


def random_values(program: Program, seed: int) -> dict[int, Value]:
    """Values that a level could give, some of them absurd."""
    pick = random.Random(seed)
    found: dict[int, Value] = {}
    for slot in program.valued:
        if slot.type == "vector":
            found[slot.index] = values.Vector(0.0, 1.0, 0.0)
        elif slot.type in ("flex", "float"):
            found[slot.index] = values.flex(pick.choice([0.0, 0.1, 0.5, 1.0, 2.5, 10.0, -1.0, 0.001]))
        else:
            numbers = [-1, 0, 1, 2, 3, 10, 40]
            if slot.type == "cog":
                numbers.remove(OWN_NUMBER)
            found[slot.index] = pick.choice(numbers)
    return found


def violations(program: Program, seed: int, *, bind: bool = True) -> list[str]:
    """Each way in which a simulated minute is not what the analysis allows."""
    bound = random_values(program, seed) if bind else {}
    log = Machine(program, bound, seed).run(SECONDS)
    return [
        *_against(Analysis(program), log, "any"),
        *_against(Analysis(program, bound), log, "bound"),
    ]


def _against(analysis: Analysis, log: Log, which: str) -> list[str]:
    known, rates = analysis.known, analysis.rates
    found = []
    static = {site.call.start: site for site in rates.sites}
    for start, all_given in log.arguments.items():
        site = static.get(start)
        if site is None:
            found.append(f"{which}: the call at {start} ran, but is held for dead")
            continue
        for given in all_given:
            for argument, value in zip(site.arguments, given, strict=True):
                if not holds(argument, value):
                    found.append(f"{which}: {site.verb.name} at {start} got {value}, not in {argument}")
    if not log.hung:
        found += _counts(analysis, log, which)
    for cause, label in sorted(log.causes):
        if cause and label not in rates.arms.get(cause, ()):
            found.append(f"{which}: {cause} caused {label}, which it is said not to")
    ways = {(p.source, p.target) for p in analysis.reach.passages}
    found += [f"{which}: code passed from {a} to {b}" for a, b in sorted(log.passages) if (a, b) not in ways]
    del known
    return found


def _counts(analysis: Analysis, log: Log, which: str) -> list[str]:
    rates = analysis.rates
    found = []
    most = rates.most_runs(SECONDS, log.events, things=len(log.things))
    for label, runs in log.runs.items():
        if runs > most[label]:
            found.append(f"{which}: {label} ran {runs} times, at most {most[label]} are allowed")
    for site in rates.sites:
        bound = sum(
            rates.repeats_of(label, site).most(log.runs[label], SECONDS, log.runs.total())
            for label in rates.senders_of(site)
        )
        if log.calls[site.call.start] > bound:
            found.append(
                f"{which}: {site.verb.name} at {site.call.start} was called {log.calls[site.call.start]} times, "
                f"at most {bound} are allowed"
            )
    return found
