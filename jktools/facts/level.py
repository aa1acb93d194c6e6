"""The facts of one level."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from jktools import geometry
from jktools.engine.profile import Engine
from jktools.facts.basins import Basin, Touched, basins_of, touched_by_scripts
from jktools.facts.bodies import Walker, walkers
from jktools.facts.camera import Camera
from jktools.facts.changes import changeable_surfaces
from jktools.facts.cog.instance import InstanceFacts
from jktools.facts.floors import Floors
from jktools.facts.hotspots import (
    Hotspot,
    Runner,
    Scene,
    SightWork,
    Verdicts,
    class_scripts,
    game_runners,
    game_scripts,
    mentions_sight,
    runners,
    with_created,
)
from jktools.facts.in_view import Counted, FullFrame, fullest, in_view, totals
from jktools.facts.islands import Island, islands
from jktools.facts.ledges import Ledges, ledges_of
from jktools.facts.movers import Mover, movers
from jktools.facts.occluders import Occluders
from jktools.facts.openings import MOVEMENT, NOT_FOR_PLAYERS, VISIBLE, cleared_by_cogs, opened_by_cogs
from jktools.facts.reachability import Reach, reach
from jktools.facts.references import FileReference, file_references
from jktools.facts.roaming import Roaming
from jktools.facts.scene import Scene as SightScene
from jktools.facts.scene import scene
from jktools.facts.script import ScriptFacts, script_facts
from jktools.facts.sightline import EndpointError
from jktools.facts.still import Still
from jktools.facts.travel import PLAYER, landings, named_by_unread, passages, puts, reached, rides
from jktools.geometry import (
    Accuracy,
    Alignment,
    Convexity,
    Corners,
    Extent,
    NormalFit,
    Outside,
    Overlaps,
    Planarity,
    SectorMesh,
    Turns,
    VisibleSectors,
)
from jktools.geometry.collision import Collision
from jktools.geometry.engine_sight import SightFaces
from jktools.geometry.ledges import EdgeWalker
from jktools.geometry.plan import plan_of
from jktools.geometry.validity import Int32
from jktools.model import Level
from jktools.model.cog.program import Vocabulary
from jktools.model.resources import Kind
from jktools.source import InputError
from jktools.syntax.assets.material import read_material


class LevelFacts:
    """Facts are pulled: nothing is computed that no rule or pass asks for, and nothing twice."""

    def __init__(self, level: Level, vocabulary: Vocabulary | None = None) -> None:
        """Know nothing yet; `vocabulary` has the verbs of the user's own build, for the level's scripts."""
        self.level = level
        self._ledges: dict[tuple[Walker, Engine, str], Ledges] = {}
        self.vocabulary = vocabulary or Vocabulary(level.game)
        self._scripts: dict[str, ScriptFacts | None] = {}
        self._cels: dict[int, int | None] = {}
        self._sight_faces: dict[Engine, SightFaces] = {}

    @classmethod
    def of(cls, level: Level) -> LevelFacts:
        """Give the facts that are kept with a level, of the game's own verbs: the same at each call."""
        kept = level.kept.get(cls)
        if not isinstance(kept, cls):
            kept = level.kept[cls] = cls(level)
        return kept

    @cached_property
    def file_references(self) -> tuple[FileReference, ...]:
        """The files that the level names."""
        return tuple(file_references(self.level))

    @cached_property
    def convexity(self) -> Convexity:
        """Each sector's worst vertex behind one of its surfaces."""
        return geometry.sector_convexity(self.level)

    @cached_property
    def planarity(self) -> Planarity:
        """Each surface's corner farthest from its plane."""
        return geometry.surface_planarity(self.level)

    @cached_property
    def turns(self) -> Turns:
        """How each corner of a surface turns."""
        return geometry.corner_turns(self.level)

    @cached_property
    def mesh(self) -> SectorMesh:
        """The sectors, ready for questions of place and sight."""
        return SectorMesh.from_level(self.level)

    @cached_property
    def collision(self) -> Collision:
        """The sectors as bodies meet them."""
        return Collision(plan_of(self.level))

    @cached_property
    def reach(self) -> Reach:
        """The templates and files that the level can reach in play."""
        return reach(self.level, self.script)

    @cached_property
    def floors(self) -> Floors:
        """The things that bodies stand on, at all their places."""
        return Floors.of(self.level)

    @cached_property
    def bare_floors(self) -> Floors:
        """None of them."""
        return Floors()

    @cached_property
    def movers(self) -> list[Mover]:
        """The placed things with frames of their own."""
        return movers(self.level)

    @cached_property
    def bodies(self) -> tuple[Walker, ...]:
        """The distinct bodies that walk in the level, players first."""
        known = self.reach
        templates = self.level.resolved_templates.entries
        return walkers(self.level, [t for t in templates if known.has(t)] if known.is_complete else templates)

    @cached_property
    def edges(self) -> EdgeWalker:
        """The edges of the floors, and of the things that bodies stand on."""
        return EdgeWalker(self.level, self.floors.solids())

    def ledges(self, walker: Walker, engine: Engine = Engine.RESEARCH, accuracy: str = "balanced") -> Ledges:
        """What a body whose hover height is known meets beyond each edge of each floor."""
        key = (walker, engine, accuracy)
        if key not in self._ledges:
            self._ledges[key] = ledges_of(self.level, self.edges, walker, self.floors, engine, accuracy)
        return self._ledges[key]

    @cached_property
    def player_ledges(self) -> tuple[Ledges, ...]:
        """The ledges of each player's body whose hover height is known, for rules."""
        return tuple(self.ledges(each) for each in self.bodies if each.hovers and each.body.player)

    @cached_property
    def touched(self) -> Touched:
        """The sectors and surfaces that placed scripts name."""
        return touched_by_scripts(self.level, self.instances)

    def basins(self, walker: Walker, engine: Engine = Engine.RESEARCH, accuracy: str = "balanced") -> tuple[Basin, ...]:
        """Where a body whose hover height is known comes down to, and what leads out."""
        return basins_of(self.level, self.mesh, self.ledges(walker, engine, accuracy), self.touched)

    @cached_property
    def overlaps(self) -> Overlaps:
        """The pairs of sectors that overlap."""
        return geometry.sector_overlaps(self.mesh)

    @cached_property
    def occluders(self) -> Occluders:
        """The solid things."""
        return Occluders(self.level)

    def sight_faces(self, engine: Engine) -> SightFaces:
        """Give the sectors as sight meets them in a profile."""
        if engine not in self._sight_faces:
            self._sight_faces[engine] = SightFaces(self.level, engine)
        return self._sight_faces[engine]

    @cached_property
    def openable_surfaces(self) -> Int32:
        """Surfaces that COGs may make see-through; of a script that cannot be read, all that its values can name."""
        return opened_by_cogs(self.level, self.instances, VISIBLE)

    @cached_property
    def enterable_surfaces(self) -> Int32:
        """Surfaces that COGs may let things pass through; of a script that cannot be read, as `openable_surfaces`."""
        return opened_by_cogs(self.level, self.instances, MOVEMENT)

    @cached_property
    def ways(self) -> list[list[int]]:
        """From each sector, those that a player comes to from there through an adjoin."""
        return passages(
            self.level, self.enterable_surfaces, cleared_by_cogs(self.level, self.instances, NOT_FOR_PLAYERS)
        )

    @cached_property
    def visited(self) -> frozenset[int] | None:
        """The sectors that players come to, by `jktools.facts.travel`; None where that is not known."""
        starts = {t.sector_index for t in self.level.things if t.dropped is None and t.resolved.type == PLAYER}
        put = landings(self.level, self.instances, self.runners)
        if put is None or not starts:
            return None
        return reached(self.ways, starts | put, rides(self.mesh, self.movers))

    @cached_property
    def islands(self) -> list[Island]:
        """The parts of the level that no player comes to; none where that is not known."""
        return islands(self.level, self.visited, self.ways, self.instances)

    @cached_property
    def visibility(self) -> VisibleSectors:
        """Which sectors can be seen from which, at `balanced`."""
        return self.mesh.visible_sectors(open_surfaces=self.openable_surfaces)

    @cached_property
    def camera(self) -> Camera:
        """What the renderer takes into frames of the level."""
        return Camera(self.level)

    def fullest_frame(self, item: Counted, most: int) -> FullFrame | None:
        """A frame that takes in more than the engine draws of something, the fullest that is found; None without."""
        if totals(self.level, self.camera)[item] <= most:
            return None
        found = fullest(self.level, self.camera, self._in_view[item], item)
        return found if found is not None and found.held > most else None

    @cached_property
    def _in_view(self) -> tuple[Int32, Int32, Int32]:
        return in_view(self.camera, self.visibility)

    def visible_sectors(self, accuracy: Accuracy) -> VisibleSectors:
        """Which sectors can be seen from which, at any tier."""
        if accuracy == "balanced":
            return self.visibility
        return self.mesh.visible_sectors(accuracy, open_surfaces=self.openable_surfaces)

    @cached_property
    def collide_boxes(self) -> tuple[Int32, Outside]:
        """The sectors that have a collide box, and how far each box sticks out."""
        return geometry.collide_boxes_outside(self.level)

    @cached_property
    def corners(self) -> Corners:
        """The corners of the surfaces, as arrays."""
        return geometry.corners_of(self.level)

    @cached_property
    def adjoin_alignment(self) -> Alignment:
        """How far the two surfaces of each adjoin are from being one polygon."""
        return geometry.adjoin_alignment(self.level, self.corners)

    @cached_property
    def normal_fit(self) -> NormalFit:
        """How each written normal fits its polygon."""
        return geometry.normal_fit(self.level, self.corners)

    @cached_property
    def sector_extent(self) -> Extent:
        """What each sector says of its extent, against its vertices."""
        return geometry.sector_extent(self.level)

    @cached_property
    def sector_vertices(self) -> list[tuple[frozenset[int], frozenset[int]]]:
        """For each sector, the vertices that it lists and those that its surfaces use; empty where it is not sound."""
        return geometry.sector_vertices(self.level)

    @cached_property
    def scripts(self) -> dict[str, ScriptFacts | None]:
        """The scripts that the level places, by lower-case name; None for one that cannot be found."""
        return {name: self.script(name) for name in dict.fromkeys(cog.name.lower() for cog in self.level.cogs)}

    def script(self, name: str) -> ScriptFacts | None:
        """A script by its name, read once; None for one that cannot be found."""
        key = name.lower()
        if key not in self._scripts:
            self._scripts[key] = self._script(key)
        return self._scripts[key]

    def _script(self, name: str) -> ScriptFacts | None:
        found = self.level.resources.find(Kind.COG, name)
        if found is None:
            return None
        try:
            return script_facts(self.level.resources.library, found.member, self.vocabulary)
        except InputError:
            return None

    def is_own_script(self, name: str) -> bool:
        """Whether a script comes with the level, and not from a base."""
        found = self.level.resources.find(Kind.COG, name)
        return found is not None and found.own

    @cached_property
    def instances(self) -> tuple[InstanceFacts, ...]:
        """The placed scripts, one for each line of the level's `cogs`.

        A script that the engine refuses makes no cog, and all later ones get a number one lower (sithCog_Load in the
        decompiled engine); one that cannot be found here is taken to lie in the game's own files.
        """
        found, number = [], 0
        for cog in self.level.cogs:
            script = self.scripts[cog.name.lower()]
            refused = script is not None and script.script.rejected
            found.append(InstanceFacts(cog, script, -1 if refused else number))
            number += not refused
        return tuple(found)

    @cached_property
    def runners(self) -> list[Runner]:
        """The scripts that run: the placed ones, and class COGs with the things that carry them."""
        return runners(self.level, self.instances, self.script)

    @cached_property
    def changeable_surfaces(self) -> frozenset[int]:
        """Surfaces that a script can open to sight and movement, or shut."""
        others = [runner.analysis for runner in self.runners if runner.cog is None]
        return changeable_surfaces(self.level, self.instances, others)

    @cached_property
    def hotspots(self) -> list[Hotspot]:
        """The calls of verbs of sight, the dearest first."""
        if not self._may_ask_for_sight:
            return []
        still = Still(self.level, self.instances, self.running, self.reach)
        verdicts = Verdicts((t for t in self.level.things if t.dropped is None), still, self._seen)
        work = SightWork(self.level, self.mesh, self.changeable_surfaces)
        return Scene(self.level, self.running, work, verdicts, self.roaming.sectors, self.reach.created).hotspots()

    @cached_property
    def roaming(self) -> Roaming:
        """The sectors that bodies of any kind come to."""
        changeable = np.array(sorted(self.changeable_surfaces), np.int32)
        ways = passages(self.level, changeable, np.arange(len(self.level.surfaces), dtype=np.int32))
        named = named_by_unread(self.level, self.instances)
        return Roaming(self.level, ways, rides(self.mesh, self.movers), puts(self.level, self.runners), named)

    def _seen(self, a: int, b: int, engine: Engine) -> SightScene | None:
        """What is seen of one thing from another, by their numbers; None where one is not in the level."""
        try:
            return scene(self, str(a), str(b), engine)
        except EndpointError:
            return None

    @cached_property
    def _may_ask_for_sight(self) -> bool:
        """Whether the text of any script that could run names a verb of sight: a quick look before a long one."""
        names = [cog.name.lower() for cog in self.level.cogs]
        names += [*class_scripts(self.level), *(name for name, _ in game_scripts(self.level))]
        return any(mentions_sight(self.level.resources, name) for name in dict.fromkeys(names))

    @cached_property
    def running(self) -> list[Runner]:
        """The scripts that run, with the class COGs that only things to come carry, and the game's own."""
        found = with_created(self.level, self.runners, self.reach, self.script)
        return [*found, *game_runners(self.level, self.script)]

    def cel_count(self, material: int) -> int | None:
        """How many cels a material of the level's list has; None where its file is not at hand or is broken."""
        if material not in self._cels:
            self._cels[material] = self._count_cels(material)
        return self._cels[material]

    def _count_cels(self, material: int) -> int | None:
        if not 0 <= material < len(self.level.materials):
            return None
        found = self.level.resources.find(Kind.MATERIAL, self.level.materials[material])
        if found is None:
            return None
        try:
            read = read_material(self.level.resources.read(found))
        except InputError:
            return None
        return len(read.cels) if read.type >= 0 and not read.diagnostics else None
