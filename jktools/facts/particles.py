"""The clouds of particles that a level's templates and things make, with the cels of their material.

A cloud is made of the values of its template or, where that has a PAR file, of the file (sithParticle_Initalize in the
decompiled engine).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from jktools.engine.particle_template import MATERIAL_CELS, ParticleTemplate
from jktools.model import Level
from jktools.model.resolved import Resolved
from jktools.model.resources import Kind
from jktools.syntax.assets.cloud import Cloud as CloudFile

PARTICLE = "particle"


class Cloud(NamedTuple):
    """One template or thing of type particle."""

    template: Resolved
    """It may be a thing's."""
    particles: ParticleTemplate
    """By its values. Count, size, places and material of a cloud from a file are the file's."""
    material: str | None
    knows_cels: bool
    """Whether the cels are those of the material's file, or of the game's own as the research document lists them."""
    file: str | None = None
    """The PAR that the cloud is made of; None for one made by its values."""
    knows_file: bool = False
    """Whether the file is at hand; its count, size and material are then taken."""

    @property
    def known(self) -> bool:
        """Whether count, size and material are known."""
        return self.file is None or self.knows_file


def clouds(level: Level) -> list[Cloud]:
    """The particle templates that the engine keeps, in their order."""
    return [
        cloud_of(level, held)
        for held in level.resolved_templates.entries
        if held.dropped is None and held.type == PARTICLE
    ]


def own_clouds(level: Level) -> Iterator[Cloud]:
    """The templates and things of type particle that are made by their values, not by a file."""
    for held in (*level.resolved_templates.entries, *level.resolved_things):
        if held.dropped is None and held.type == PARTICLE and held.name_in(PARTICLE) is None:
            yield cloud_of(level, held)


def cloud_of(level: Level, held: Resolved) -> Cloud:
    """What a template or thing of type particle makes."""
    name = held.name_in(PARTICLE)
    file = None if name is None else level.resources.asset(Kind.PARTICLES, name)
    read = file if isinstance(file, CloudFile) else None
    material = held.name_in("material") if name is None else None if read is None else read.material.lower() or None
    cels = None if material is None else _cels(level, material)
    particles = ParticleTemplate(
        count=int(held.number("count")) if read is None else len(read.vertices),
        timer=held.number("timer"),
        typeflags=held.flags("typeflags"),
        range=held.number("range"),
        minsize=held.number("minsize"),
        rate=held.number("rate"),
        maxthrust=held.number("maxthrust"),
        elementsize=held.number("elementsize") if read is None else read.size,
        pitchrange=held.number("pitchrange"),
        yawrange=held.number("yawrange"),
        cels=1 if cels is None else cels,
    )
    return Cloud(held, particles, material, cels is not None, name, read is not None)


def _cels(level: Level, material: str) -> int | None:
    if level.resources.find(Kind.MATERIAL, material) is None:
        return MATERIAL_CELS.get(material)
    read = level.resources.material(material)
    return len(read.cels) if read is not None and read.type >= 0 and read.cels else None
