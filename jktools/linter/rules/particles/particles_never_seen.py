"""JK740: a cloud of particles that shows nothing."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.facts.particles import Cloud, clouds
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK740", "particles-never-seen", severity=Severity.WARNING, since="0.1.0")
def particles_never_seen(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a template of type particle that the level can reach and that shows nothing.

    ## Why it matters
    A cloud is `count` squares of side `elementsize`, with the colour of a `material`. Without one of the three there is
    nothing to see, while the thing lives and costs its time.

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
    for cloud in clouds(level):
        missing = _missing(cloud)
        if missing is not None and facts.reach.has(cloud.template):
            setting = cloud.template.values.get(missing)
            yield Finding(
                Label(setting.origins[0].span if setting is not None else cloud.template.owner.head_span),
                f"{cloud.template.owner.title} makes particles, but has "
                + (f"no {missing}" if setting is None else f"{missing}={setting.text}"),
                "give it a count, an elementsize and a material",
                cloud.template.owner.subject,
            )


def _missing(cloud: Cloud) -> str | None:
    if cloud.particles.spawned == 0:
        return "count"
    if not cloud.particles.elementsize > 0:
        return "elementsize"
    return "material" if cloud.material is None else None
