"""The sections on what a scene costs and shows, read back from the file."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.compiler.section import Section
from tests.support.levels import level_of, level_with_files, two_rooms

LAMP = [
    "World templates 6",
    "lamp none type=cog cog=lamp.cog light=1",
    "smoke none type=particle timer=1.5 material=00gsmoke.mat range=.1 elementsize=.01 count=300 typeflags=0x3f "
    "rate=128",
    "walkplayer none type=player move=physics physflags=0x4a4f mass=150 maxthrust=2 surfdrag=3 airdrag=.5 maxvel=1 "
    "staticdrag=.3",
    "World things 5", "7: lamp lamp 0 0 0 0 0 0 0", "3: smoke smoke .5 .5 .5 0 0 0 0", "World cogs 1", "0: fx.cog .5",
    "== cog/lamp.cog", "symbols", "message created", "message pulse", "end", "code",
    "created: SetThingPulse(GetSenderRef(), 0.1); return;",
    "pulse: if (HasLOS(GetSenderRef(), GetLocalPlayerThing()) == 1) Print(\"x\"); return;", "end",
    "== cog/fx.cog", "symbols", "message activated", "flex dim", "int fx local", "end", "code", "activated:",
    "fx = NewColorEffect(0, 0, 0, 0, 0, 0, 0, 0, 0, dim);", "end",
]  # fmt: skip


@pytest.fixture(scope="module")
def compiled() -> CompiledLevel:
    with level_with_files(*LAMP) as level:
        return CompiledLevel(compile_level(level))


def section(level: CompiledLevel, name: str) -> Section:
    found = level.sections[name]
    assert isinstance(found, Section)
    return found


def test_hotspots(compiled: CompiledLevel) -> None:
    spots = section(compiled, "hotspots")
    assert (spots.cog.tolist(), spots.things.tolist(), spots.line.tolist()) == ([-1], [1], [7])
    assert [compiled.strings[i] for i in (spots.script[0], spots.verb[0])] == ["lamp.cog", "haslos"]
    assert spots.calls_per_second[0] == pytest.approx(10)
    # The lamp lies in a corner of the rooms: 6 surfaces to its own room, 12 to the other.
    assert (spots.mean_surfaces[0], spots.most_surfaces[0], spots.verdict[0]) == (9, 12, 2)


def test_class_cogs_look_in_a_level_that_places_no_cog() -> None:
    lines = [line for line in LAMP if line != "0: fx.cog .5"]
    lines[lines.index("World cogs 1")] = "World cogs 0"
    lines.insert(lines.index("World cogs 0") + 1, "- 0: door.cog 3 -1 wind.wav")
    with level_with_files(*lines) as level:
        compiled = CompiledLevel(compile_level(level))
    assert compiled.passes["cogs"] == {"ran": False, "failed": False, "note": "no COG is placed"}
    assert section(compiled, "hotspots").calls_per_second.tolist() == pytest.approx([10])


def test_lights(compiled: CompiledLevel) -> None:
    lights = section(compiled, "lights")
    assert (lights.thing.tolist(), lights.vertex_start.tolist()) == ([2], [0, 4])
    assert lights.vertex.tolist() == [0, 1, 3, 4]
    assert lights.amount.tolist() == pytest.approx([1, 0.2, 0.2, 0.2])
    assert lights.reach.tolist() == [1.25]
    assert lights.position.shape == (1, 3)


def test_particles(compiled: CompiledLevel) -> None:
    clouds = section(compiled, "particles")
    assert (clouds.spawned.tolist(), clouds.timer_ms.tolist(), clouds.lost_a_step.tolist()) == ([256], [1500], [12])
    assert (clouds.cels.tolist(), clouds.flags.tolist(), clouds.light_mode.tolist()) == ([4], [0x3F], [0])
    assert compiled.strings[clouds.material[0]] == "00gsmoke.mat"


def test_colour_effects(compiled: CompiledLevel) -> None:
    effects = section(compiled, "colour_effects")
    assert (effects.cog.tolist(), effects.line.tolist(), effects.colormap.tolist()) == ([0], [8], [-1])
    assert effects.argument.tolist() == [[0] * 9 + [0.5]]
    assert effects.palette.shape == (1, 768)
    assert effects.palette.reshape(256, 3)[200].tolist() == [100, 100, 100]


def test_motion(compiled: CompiledLevel) -> None:
    motion = section(compiled, "motion")
    assert motion.template.tolist() == [0]
    assert motion.walk.tolist() == pytest.approx([2 / 3])
    assert motion.stop_walk.shape == (1, 2)
    assert motion.stop_walk[0, 0] == motion.stop_walk[0, 1]
    assert np.isfinite(motion.jump_reach).all()


def test_what_cannot_be_reached_is_left_out() -> None:
    lines = [line for line in LAMP if line != "3: smoke smoke .5 .5 .5 0 0 0 0"]
    with level_with_files(*lines) as level:
        both = [CompiledLevel(compile_level(level, CompileSettings(cut_anyway=cut))) for cut in (False, True)]
    assert [each.counts["particles"] for each in both] == [1, 0]
    assert [each.counts["motions"] for each in both] == [1, 1]


def test_what_the_scene_does_not_call_for_is_absent_and_says_why() -> None:
    level = CompiledLevel(compile_level(level_of(two_rooms())))
    notes = {name: each["note"] for name, each in level.passes.items() if not each["ran"]}
    notes.pop("basins")
    assert notes == {
        "hotspots": "no script at hand asks for sight",
        "lights": "no thing that stays in place shines",
        "particles": "no template that the level can reach makes particles",
        "colour_effects": "no script at hand makes a colour effect of known colours",
        "models": "no model of a template is at hand",
    }


@pytest.mark.parametrize("accuracy", ["fast", "balanced", "exact"])
@pytest.mark.parametrize("engine", ["research", "openjkdf2"])
def test_every_tier_and_profile_compiles_to_the_same_bytes_twice(accuracy: str, engine: str) -> None:
    settings = CompileSettings(engine=engine, accuracy=accuracy)  # type: ignore[arg-type]
    with level_with_files(*LAMP) as level:
        first = compile_level(level, settings)
        assert compile_level(level, settings) == first
    motion = section(CompiledLevel(first), "motion")
    assert (motion.stop_walk[0, 0] < motion.stop_walk[0, 1]) == (accuracy == "exact")
