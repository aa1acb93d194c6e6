"""JK656: a surface set to a cel that its material does not have."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

VERBS = frozenset({"setwallcel", "setsurfacecel"})


@rule("JK656", "cel-out-of-range", severity=Severity.WARNING, since="0.1.0")
def cel_out_of_range(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a placed script that shows a cel which the surface's material does not have.

    ## Why it matters
    A switch is mostly a material of two cels, one for each position. With a material of one cel the second does not
    exist, and what the surface shows is not defined. Judged is the surface that the level's `cogs` line names, with the
    material that the level gives it, when that file is at hand.
    """
    for instance in facts.instances:
        if instance.analysis is None or instance.script is None:
            continue
        for site in instance.analysis.rates.sites:
            if site.verb.name not in VERBS or len(site.call.arguments) != len(site.verb.args):
                continue
            number, cel = site.arguments[0].number, site.arguments[1].number
            if number is None or cel is None or not 0 <= number < len(level.surfaces) or number != int(number):
                continue
            surface = level.surfaces[int(number)]
            cels = facts.cel_count(surface.material)
            if cels is not None and int(cel) >= cels:
                name = level.materials[surface.material]
                yield Finding(
                    Label(instance.cog.head_span),
                    f"{instance.cog.title} shows cel {cel:g} of surface {surface.index} with {site.verb.name}, but "
                    f"{name} has {cels} cel{'s' * (cels != 1)}, from 0",
                    "give the surface a material with that cel, or name another surface",
                    instance.cog.subject,
                    (instance.script.label(site.call, "the call"), Label(surface.head_span, surface.title)),
                )
