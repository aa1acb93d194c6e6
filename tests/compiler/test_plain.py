"""`--plain`: nothing but arrays of the schema's types, and the same level."""

from __future__ import annotations

from pathlib import Path

import pytest

from jktools.cli import main
from jktools.compiler import CompiledLevel, CompileSettings, compile_level
from jktools.compiler import level_generated as fb
from jktools.compiler.columns import SECTIONS, camel_case
from jktools.geometry import Accuracy
from tests.support.halls import halls
from tests.support.levels import CORPUS, level_of, two_rooms

TEXT = two_rooms(
    "World sounds 60", *(f"squeak_{i:02}.wav" for i in range(60)), "World templates 9",
    "guard walkplayer health=60", "captain guard light=.5",
)  # fmt: skip


@pytest.mark.parametrize("accuracy", ["balanced", "fast"])
def test_every_column_is_a_plain_vector(accuracy: Accuracy) -> None:
    level = level_of(TEXT)
    packed, plain = (
        CompiledLevel(compile_level(level, CompileSettings(accuracy=accuracy, plain=each)), verify=True)
        for each in (False, True)
    )
    assert (packed.plain, plain.plain) == (False, True)
    assert packed.vertex_step == plain.vertex_step
    assert bool(plain.vertex_step) == (accuracy == "fast")
    root = fb.Level.GetRootAs(plain.data)  # type: ignore[no-untyped-call]
    assert root.TextStartPacked() is None
    assert b"squeak_07.wav\0squeak_08.wav\0" in bytes(plain.data)
    assert b"squeak_07.wav\0" not in bytes(packed.data)
    seen = 0
    for name, section in plain.sections.items():
        table = getattr(root, camel_case(name))()
        for key, column in SECTIONS[name].items():
            if column.until is None:
                assert section.stored[key].in_file
                assert section.stored[key].is_plain(column), f"{name}.{key}"
                assert getattr(table, f"{camel_case(key)}Packed")() is None
                assert not getattr(table, f"{camel_case(key)}IsNone")()
                seen += 1
    assert seen > 100
    assert plain.templates is not None
    assert set(plain.templates.base.tolist()) == {-1}
    assert packed.templates is not None
    assert set(packed.templates.base.tolist()) != {-1}
    for name in ("value_start", "value_key", "value_text", "value_source", "value_list", "number"):
        assert getattr(plain.templates, name).tolist() == getattr(packed.templates, name).tolist(), name
    for name in SECTIONS["geometry"]:
        assert getattr(plain, name).tobytes() == getattr(packed, name).tobytes(), name
    assert plain.strings == packed.strings


def test_both_ways_say_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "rooms.jkl").write_text(TEXT)
    for folder, words in (("packed", []), ("plain", ["--plain"])):
        assert main(["build", str(tmp_path / "rooms.jkl"), "-o", str(tmp_path / folder), "-q", *words]) == 0
    one, two = (str(tmp_path / folder / "rooms.jklb") for folder in ("packed", "plain"))
    assert Path(one).stat().st_size < Path(two).stat().st_size
    assert main(["diff", one, two]) == 0
    assert "no difference" in capsys.readouterr().out
    assert main(["inspect", "--verify", "--source", str(tmp_path / "rooms.jkl"), two]) == 0


def test_fast_takes_no_grid_that_costs_more() -> None:
    """12 vertices as floats take 144 bytes; as steps 72, and more than as much again to tell what steps they are."""
    small, large = (
        CompiledLevel(compile_level(level, CompileSettings(accuracy="fast"))) for level in (level_of(TEXT), halls())
    )
    assert small.geometry.stored["vertices"].step == 0
    assert small.vertex_step == 2.0**-14
    assert large.geometry.stored["vertices"].step == large.vertex_step > 0
    assert len(large.data) < len(compile_level(halls()))


@pytest.mark.skipif(not CORPUS.exists(), reason="the corpus of real mods is not at hand")
def test_a_real_level_of_few_vertices_is_no_larger_at_fast() -> None:
    level = level_of((CORPUS / "jkl/treeofmight2.jkl").read_bytes())
    assert len(compile_level(level, CompileSettings(accuracy="fast"))) <= len(compile_level(level))
