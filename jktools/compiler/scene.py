"""The columns of what a scene costs and shows: hotspots of sight, lights, particles, colour effects, motion."""

from __future__ import annotations

import numpy as np

from jktools.compiler.cut import choose
from jktools.compiler.sections import Columns, NotNeeded, Strings
from jktools.compiler.settings import CompileSettings
from jktools.engine.profile import Engine
from jktools.facts import LevelFacts
from jktools.facts.colour_effects import constant_effects, palettes, shown
from jktools.facts.hotspots import Runner, Verdict
from jktools.facts.lights import still_lights
from jktools.facts.motion import Interval, bodies, gravity_of, motions
from jktools.facts.particles import clouds
from jktools.model.insert_offset import insert_offset

VERDICTS = (Verdict.NEVER, Verdict.ALWAYS, Verdict.VARIES)
"""In the order of the schema."""
UNKNOWN = -1
STOPS = ("stop_walk", "stop_run")
"""Columns of both ends of an interval; of a jump the file holds the least."""


def hotspots(facts: LevelFacts, strings: Strings, settings: CompileSettings) -> Columns | NotNeeded:
    """What tests of sight cost."""
    spots = facts.hotspots
    if not spots:
        return NotNeeded("no script at hand asks for sight")
    return {
        "cog": np.array([_cog(spot.runner) for spot in spots]),
        "script": strings.indices(spot.runner.name for spot in spots),
        "verb": strings.indices(spot.site.verb.name for spot in spots),
        "line": np.array([spot.runner.script.span(spot.site.call).first.line for spot in spots]),
        "things": np.array([len(spot.runner.things) for spot in spots]),
        "more": np.array([spot.more for spot in spots]),
        "calls_per_second": np.array([spot.calls_per_second for spot in spots]),
        "mean_sectors": np.array([spot.cost.mean_sectors for spot in spots]),
        "mean_surfaces": np.array([spot.cost.mean_surfaces for spot in spots]),
        "most_sectors": np.array([spot.cost.most_sectors for spot in spots]),
        "most_surfaces": np.array([spot.cost.most_surfaces for spot in spots]),
        "pairs": np.array([spot.cost.pairs for spot in spots]),
        "verdict": np.array([VERDICTS.index(spot.verdicts[Engine(settings.engine)]) for spot in spots]),
    }


def lights(facts: LevelFacts, _: Strings, __: CompileSettings) -> Columns | NotNeeded:
    """The light of things that stay, on the vertices of surfaces."""
    found = still_lights(facts.level)
    if not found:
        return NotNeeded("no thing that stays in place shines")
    return {
        "thing": np.array([light.thing.index for light in found]),
        "position": np.array([light.thing.position for light in found]),
        "intensity": np.array([light.intensity for light in found]),
        "reach": np.array([light.reach for light in found]),
        "vertex_start": np.concatenate([[0], np.cumsum([len(light.vertices) for light in found])]),
        "vertex": np.concatenate([light.vertices for light in found]),
        "amount": np.concatenate([light.amounts for light in found]),
    }


def particles(facts: LevelFacts, strings: Strings, settings: CompileSettings) -> Columns | NotNeeded:
    """The particle templates that are kept."""
    kept = _kept(facts, settings)
    found = [cloud for cloud in clouds(facts.level) if cloud.template.owner.index in kept]
    if not found:
        return NotNeeded("no template that the level can reach makes particles")
    return {
        "template": np.array([cloud.template.owner.index for cloud in found]),
        "material": np.array([_text(strings, cloud.material) for cloud in found]),
        "cels": np.array([cloud.particles.cels if cloud.knows_cels else UNKNOWN for cloud in found]),
        "spawned": np.array([cloud.particles.spawned if cloud.known else UNKNOWN for cloud in found]),
        "timer_ms": np.array([cloud.particles.timer_ms for cloud in found]),
        "flags": np.array([cloud.particles.typeflags & 0xFFFFFFFF for cloud in found]),
        "lost_a_step": np.array([cloud.particles.lost_a_step for cloud in found]),
        "light_mode": np.array([cloud.particles.light_mode if cloud.file is None else UNKNOWN for cloud in found]),
        "elementsize": np.array([cloud.particles.elementsize if cloud.known else np.nan for cloud in found]),
        **{
            key: np.array([getattr(cloud.particles, key) for cloud in found], np.float64)
            for key in ("range", "minsize", "maxthrust", "pitchrange", "yawrange")
        },
    }


def colour_effects(facts: LevelFacts, strings: Strings, settings: CompileSettings) -> Columns | NotNeeded:
    """What the level's colours become under each effect that is known."""
    found = constant_effects(facts.runners)
    if not found:
        return NotNeeded("no script at hand makes a colour effect of known colours")
    known = palettes(facts.level)
    rows = [(each, view) for each in found for view in shown(each.effect, known, Engine(settings.engine))]
    effects = [each.effect for each, _ in rows]
    return {
        "cog": np.array([_cog(each.runner) for each, _ in rows]),
        "script": strings.indices(each.runner.name for each, _ in rows),
        "line": np.array([each.runner.script.span(each.site.call).first.line for each, _ in rows]),
        "argument": np.array([(*e.filters, *e.tint, *e.add, e.brightness) for e in effects]),
        "colormap": np.array([view.colormap for _, view in rows]),
        "palette": np.array([view.after.reshape(-1) for _, view in rows]),
    }


def motion(facts: LevelFacts, _: Strings, settings: CompileSettings) -> Columns | NotNeeded:
    """How the templates that are kept move."""
    kept = _kept(facts, settings)
    held = [template for template in bodies(facts.level) if template.owner.index in kept]
    if not held:
        return NotNeeded("no template that the level can reach is an actor or player")
    found = motions(
        held, gravity_of(facts.level), engine=Engine(settings.engine), accuracy=settings.accuracy
    )  # fmt: skip
    columns = {"template": np.array([each.template.owner.index for each in found])}
    for key in found[0]._fields[1:]:
        values = [getattr(each, key) for each in found]
        if isinstance(values[0], Interval) and key not in STOPS:
            values = [value.least for value in values]
        columns[key] = np.array(values, np.float64)
    return columns


def models(facts: LevelFacts, strings: Strings, settings: CompileSettings) -> Columns | NotNeeded:
    """The models of the templates that are kept."""
    level = facts.level
    kept = choose(facts, cut_anyway=settings.cut_anyway).kept.tolist()
    named = dict.fromkeys(level.resolved_templates[i].name_in("model3d") for i in kept)
    offsets = {name: insert_offset(level.resources, name) for name in named if name is not None}
    found = {name: offset for name, offset in offsets.items() if offset is not None}
    if not found:
        return NotNeeded("no model of a template is at hand")
    files = [level.resources.model(name) for name in found]
    return {
        "name": strings.indices(found),
        "insert_offset": np.array([(each.x, each.y, each.z) for each in found.values()]),
        "radius": np.array([np.nan if file is None else file.radius for file in files]),
        "known": np.array([each.known for each in found.values()]),
    }


def _kept(facts: LevelFacts, settings: CompileSettings) -> frozenset[int]:
    return frozenset(choose(facts, cut_anyway=settings.cut_anyway).kept.tolist())


def _cog(runner: Runner) -> int:
    return UNKNOWN if runner.cog is None else runner.cog.index


def _text(strings: Strings, text: str | None) -> int:
    return UNKNOWN if text is None else int(strings.indices([text])[0])
