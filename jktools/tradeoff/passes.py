"""What is measured: queries, the passes of the compiler that have tiers, and the whole build.

Each pass makes ready what all tiers share, apart from the time that is measured, and gives a function whose every call
computes the answer anew.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from jktools.compiler import CHOICES, CompiledLevel, CompileSettings, compilation
from jktools.compiler.cut import choose
from jktools.compiler.walkability import NO_BODY, NO_FLOOR
from jktools.engine.profile import Engine
from jktools.facts import LevelFacts
from jktools.facts.bodies import Walker
from jktools.facts.ledges import Ledges, ledges_of
from jktools.facts.motion import Motion, bodies, gravity_of, motions
from jktools.geometry import Accuracy, Drop, VisibleSectors
from jktools.geometry.mesh import Location, Sight
from jktools.model import Level
from jktools.tradeoff import errors
from jktools.tradeoff.answers import Hollow, Stop, Viewed, hollow, walked
from jktools.tradeoff.errors import AT_EDGES, Error
from jktools.tradeoff.queries import SETS, Queries, can_be_asked, through_edges

TIERS: tuple[Accuracy, ...] = ("fast", "balanced", "exact")
ONE_THREAD = 1
LIMITS = (np.inf, np.inf, 1.0, 0.25)
"""JKU: the greatest depths asked for, in turn."""
KINDS: Mapping[str, Callable[[Level, int, np.random.Generator], Queries]] = {**SETS, AT_EDGES: through_edges}


class NothingToDoError(Exception):
    """The level calls for nothing of the kind; the message says why."""


class Asked(NamedTuple):
    """What a run is about, the same for every pass and tier."""

    engine: Engine
    queries: int
    """Sight, location and drop each, over all kinds."""
    seed: int


class _Worked(LevelFacts):
    """Facts of which some are known from elsewhere: what was measured need not be computed again for the file."""

    def __init__(self, level: Level) -> None:
        super().__init__(level)
        self.visible: VisibleSectors | None = None
        self.walked: dict[Walker, Ledges] = {}

    def visible_sectors(self, accuracy: Accuracy) -> VisibleSectors:
        return self.visible or super().visible_sectors(accuracy)

    def ledges(self, walker: Walker, engine: Engine = Engine.RESEARCH, accuracy: str = "balanced") -> Ledges:
        return self.walked[walker] if walker in self.walked else super().ledges(walker, engine, accuracy)


class Scene:
    """A level in one process, at one tier."""

    def __init__(self, load: Callable[[], Level], asked: Asked, tier: Accuracy) -> None:
        """Read it."""
        self.load, self.asked, self.tier = load, asked, tier
        self.level = load()
        self.facts = _Worked(self.level)

    @cached_property
    def queries(self) -> dict[str, Queries]:
        """The seeded queries of each kind."""
        if not can_be_asked(self.level):
            raise NothingToDoError("the level has no sector that can be computed with")
        each = -(-self.asked.queries // len(KINDS))
        rng = np.random.default_rng(self.asked.seed)
        return {kind: make(self.level, each, rng) for kind, make in KINDS.items()}

    def compiled(self, section: str) -> CompiledLevel:
        """The file, with one section and those that it needs."""
        only = frozenset({section} & set(CHOICES))
        skip = frozenset() if only else frozenset(CHOICES)
        settings = CompileSettings(str(self.asked.engine), self.tier, only=only, skip=skip)
        return CompiledLevel(compilation(self.level, settings, self.facts).data, self.level.path)

    def bytes_of(self, section: str) -> int:
        """How many bytes a section has in the file."""
        return _bytes(self.compiled(section), section)


def _bytes(file: CompiledLevel, section: str) -> int:
    held = file.sections.get(section)
    return 0 if held is None else held.nbytes


Run = Callable[[], Any]


class Result(NamedTuple):
    """What a cell gives beside time and memory."""

    answer: Any
    """Compared with that of `exact`; it can be sent between processes."""
    bytes: int | None
    """In the file; None for what a file does not hold."""
    seconds_at_edges: float | None = None
    """Processor seconds of the queries that are aimed at edges."""


@dataclass(frozen=True, slots=True)
class Pass:
    """One row of the table."""

    name: str
    title: str
    """What is timed."""
    measure: str
    """What `Error.worst` is, with its unit."""
    begin: Callable[[Scene], Run]
    """Make ready; raises NothingToDoError."""
    finish: Callable[[Scene, Any], Result]
    compare: Callable[[Any, Any], Error] | None
    """The error of the first answer against the second."""
    after: str = ""
    """The pass whose answer it starts from: both are measured in one process."""


def _asking(ask: Callable[[Scene, Queries], Any]) -> tuple[Callable[[Scene], Run], Callable[[Scene, Any], Result]]:
    """How queries are asked: those that games ask are timed together, those aimed at edges apart."""

    def begin(scene: Scene) -> Run:
        queries = scene.queries
        # What is made ready at the first question is not timed.
        ask(scene, queries[AT_EDGES].first)
        return lambda: {kind: ask(scene, each) for kind, each in queries.items() if kind != AT_EDGES}

    def finish(scene: Scene, answer: Mapping[str, Any]) -> Result:
        began = time.process_time()
        at_edges = ask(scene, scene.queries[AT_EDGES])
        seconds = time.process_time() - began
        return Result({**answer, AT_EDGES: at_edges}, None, seconds)

    return begin, finish


def _ask_sight(scene: Scene, queries: Queries) -> Sight:
    return scene.facts.mesh.sight(*queries, scene.tier, ONE_THREAD)


def _ask_location(scene: Scene, queries: Queries) -> Location:
    return scene.facts.mesh.location(queries.targets, scene.tier, ONE_THREAD)


def _ask_drop(scene: Scene, queries: Queries) -> Drop:
    limits = np.resize(LIMITS, len(queries.sectors))
    return scene.facts.mesh.drop(queries.origins, queries.sectors, limits, scene.tier, ONE_THREAD)


def _begin_visibility(scene: Scene) -> Run:
    if not len(scene.level.sectors):
        raise NothingToDoError("the level has no sector")
    mesh, opened = scene.facts.mesh, scene.facts.openable_surfaces
    return lambda: mesh.visible_sectors(scene.tier, ONE_THREAD, opened)


def _finish_visibility(scene: Scene, answer: VisibleSectors) -> Result:
    scene.facts.visible = answer
    segments = refuted = 0
    for each in scene.queries.values():
        aims = scene.facts.mesh.locate(each.targets, threads=ONE_THREAD)
        seen = scene.facts.mesh.sees(*each, aims, threads=ONE_THREAD)
        segments += int(seen.sum())
        refuted += int((~answer.matrix[each.sectors[seen], aims[seen]]).sum())
    file = scene.compiled("visibility")
    filed = file.visible_sectors
    return Result(
        Viewed(answer, segments, refuted, answer.matrix if filed is None else filed), _bytes(file, "visibility")
    )


def _known_bodies(scene: Scene) -> list[Walker]:
    facts = scene.facts
    known = [body for body in facts.bodies if body.hovers]
    if not known:
        raise NothingToDoError("the hover height of no body is known" if facts.bodies else NO_BODY)
    if not len(facts.edges.surface):
        raise NothingToDoError(NO_FLOOR)
    return known


def _begin_ledges(scene: Scene) -> Run:
    facts, engine = scene.facts, scene.asked.engine
    known, edges, floors = _known_bodies(scene), facts.edges, facts.floors
    return lambda: [ledges_of(scene.level, edges, b, floors, engine, scene.tier, ONE_THREAD) for b in known]


def _finish_ledges(scene: Scene, answer: Sequence[Ledges]) -> Result:
    scene.facts.walked = {each.walker: each for each in answer}
    return Result([walked(each) for each in answer], scene.bytes_of("ledges"))


def _begin_basins(scene: Scene) -> Run:
    facts, engine = scene.facts, scene.asked.engine
    known = _known_bodies(scene)
    _ = facts.touched
    for body in known:
        facts.walked.setdefault(body, facts.ledges(body, engine, scene.tier))
    return lambda: [hollow(i, b) for i, body in enumerate(known) for b in facts.basins(body, engine, scene.tier)]


def _finish_basins(scene: Scene, answer: Sequence[Hollow]) -> Result:
    return Result(answer, scene.bytes_of("basins"))


def _begin_motion(scene: Scene) -> Run:
    kept = set(choose(scene.facts).kept.tolist())
    held = [template for template in bodies(scene.level) if template.owner.index in kept]
    if not held:
        raise NothingToDoError("no template that the level can reach is an actor or player")
    gravity = gravity_of(scene.level)
    return lambda: motions(held, gravity, engine=scene.asked.engine, accuracy=scene.tier)


def _finish_motion(scene: Scene, answer: Sequence[Motion]) -> Result:
    stops = [
        Stop(each.template.owner.name, gait, *way)
        for each in answer
        for gait, way in (("walk", each.stop_walk), ("run", each.stop_run))
    ]
    return Result(stops, scene.bytes_of("motion"))


def _begin_geometry(scene: Scene) -> Run:
    settings = CompileSettings(str(scene.asked.engine), scene.tier, skip=frozenset(CHOICES))
    return lambda: compilation(scene.level, settings, scene.facts).data


def _finish_geometry(scene: Scene, answer: bytes) -> Result:
    held: npt.NDArray[np.float32] = CompiledLevel(answer, scene.level.path).vertices
    return Result(np.asarray(held, np.float64), scene.bytes_of("geometry"))


def _begin_build(scene: Scene) -> Run:
    settings = CompileSettings(str(scene.asked.engine), scene.tier)
    return lambda: len(compilation(scene.load(), settings).data)


def _finish_build(_: Scene, answer: int) -> Result:
    return Result(None, answer)


PASSES: Mapping[str, Pass] = {
    each.name: each
    for each in (
        Pass("location", "sectors of points", "share of points in a wrong sector",
             *_asking(_ask_location), errors.location_error),
        Pass("sight", "queries of sight", "share of wrong verdicts", *_asking(_ask_sight), errors.sight_error),
        Pass("drop", "floors below points", "share of wrong floors", *_asking(_ask_drop), errors.drop_error),
        Pass("visibility", "which sectors see which", "false and missed pairs, as a share of the true ones",
             _begin_visibility, _finish_visibility, errors.visibility_error),
        Pass("ledges", "edges of floors", "share of the edges' length that is classed wrong",
             _begin_ledges, _finish_ledges, errors.ledge_error),
        Pass("basins", "floors that lie deeper, from the ledges", "share of basins missed, false or told otherwise",
             _begin_basins, _finish_basins, errors.basin_error, after="ledges"),
        Pass("motion", "ways to rest", "JKU between the way to rest and what is said",
             _begin_motion, _finish_motion, errors.motion_error),
        Pass("geometry", "vertices, surfaces, sectors", "JKU that a vertex is moved",
             _begin_geometry, _finish_geometry, errors.geometry_error),
        Pass("build", "from the level's text to the file", "", _begin_build, _finish_build, None),
    )
}  # fmt: skip
"""In the order of the table; a pass comes after the one that it starts from."""
