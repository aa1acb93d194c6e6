"""The clouds of particles that a level's templates make, with the cels of their material."""

from __future__ import annotations

from typing import NamedTuple

from jktools.engine.particle_template import MATERIAL_CELS, ParticleTemplate
from jktools.model import Level
from jktools.model.resources import Kind
from jktools.model.templates import Resolved
from jktools.source import InputError
from jktools.syntax.assets.material import read_material


class Cloud(NamedTuple):
    """One template of type particle."""

    template: Resolved
    particles: ParticleTemplate
    material: str | None
    knows_cels: bool
    """Whether the cels are those of the material's file, or of the game's own as the research document lists them."""


def clouds(level: Level) -> list[Cloud]:
    """The particle templates that the engine keeps, in their order."""
    return [
        cloud_of(level, held)
        for held in level.resolved_templates.entries
        if held.dropped is None and held.type == "particle"
    ]


def cloud_of(level: Level, held: Resolved) -> Cloud:
    """What a template or thing of type particle makes."""
    material = held.name_in("material")
    cels = None if material is None else _cels(level, material)
    particles = ParticleTemplate(
        count=int(held.number("count")),
        timer=held.number("timer"),
        typeflags=held.flags("typeflags"),
        range=held.number("range"),
        minsize=held.number("minsize"),
        rate=held.number("rate"),
        maxthrust=held.number("maxthrust"),
        elementsize=held.number("elementsize"),
        pitchrange=held.number("pitchrange"),
        yawrange=held.number("yawrange"),
        cels=1 if cels is None else cels,
    )
    return Cloud(held, particles, material, cels is not None)


def _cels(level: Level, material: str) -> int | None:
    found = level.resources.find(Kind.MATERIAL, material)
    if found is None:
        return MATERIAL_CELS.get(material)
    try:
        read = read_material(level.resources.read(found))
    except InputError:
        return None
    return len(read.cels) if read.type >= 0 and read.cels else None
