"""JK740: a cloud of particles that shows nothing."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.own_line import own_origin
from jktools.facts.particles import Cloud
from jktools.linter.particles import new_faults
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK740", "particles-never-seen", severity=Severity.WARNING, since="0.1.0")
def particles_never_seen(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template or thing of type particle that the level can reach and that shows nothing.

    ## Why it matters
    A cloud is `count` squares of side `elementsize`. Without one of the two there is nothing to see, while the thing
    lives and costs its time. A negative `elementsize` draws the same square as a positive one (JK743). A cloud from a
    PAR file has both from there.

    ## Bad
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat range=.1 elementsize=.01
        World things 4
        2: smoke smoke .5 .5 .5 0 0 0 0

    ## Good
        World templates 4
        smoke none type=particle timer=1 material=00gsmoke.mat range=.1 elementsize=.01 count=64
        World things 4
        2: smoke smoke .5 .5 .5 0 0 0 0
    """
    for cloud, key in new_faults(level, facts.reach, _missing):
        held = cloud.template
        own = own_origin(held, key)
        setting = held.values.get(key)
        yield Finding(
            Label(held.owner.head_span if own is None else own.span),
            f"{held.owner.title} makes particles, but has "
            + (f"no {key}" if setting is None else f"{key}={setting.text}"),
            f"give it a{'n' if key == 'elementsize' else ''} {key} above 0",
            held.owner.subject,
        )


def _missing(cloud: Cloud) -> str | None:
    if cloud.particles.count == 0:
        return "count"
    return "elementsize" if cloud.particles.elementsize == 0 else None
