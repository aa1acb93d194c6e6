"""The small text assets: what they say, and what is wrong with them."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.source import Source
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.cloud import Cloud
from jktools.syntax.assets.keyframe import Keyframe, KeyNode
from jktools.syntax.assets.reading import read_asset
from jktools.syntax.assets.small import AIClass, Episode, Item, Items, Puppet, SoundClass, Sprite
from jktools.syntax.assets.strings import Strings
from tests.support.assets import corpus_assets

SPRITE = "# one\ncrate.mat 1 0.5 .25 4 3 1 0 0 0 0\n"
SOUNDS = "create dooropen.wav\nmoving  loop.wav 0x1 .5 2.5 1\nstopmove none\n"
PUPPET = "mode=0\nstand kystand.key 0x20 1 2\nmode=1,basedon=0\nwalk kywalk.key\njoints\n0=9\n1=3\nend\n"
AI = "alignment=-1.0, maxstep=0.3 fov=120\nfollow 0.5\nprimaryfire 1 2 3\n"
KEY = """SECTION: HEADER
FLAGS 0x0
TYPE 0x1
FRAMES 10
FPS 15.0
JOINTS 3
SECTION: MARKERS
MARKERS 1
4.0 1
SECTION: KEYFRAME NODES
NODES 1
NODE 2
MESH NAME k_head
ENTRIES 2
0: 0 0x1 0 0 0 0 0 0
  0 0 .1 0 0 0
1: 5 0x0 0 0 .5 0 0 0
  0 0 0 0 0 0
"""
PAR = """SECTION: HEADER
PAR 1.0
SIZE 0.02
MATERIAL smoke.mat
LIGHTINGMODE 0
SECTION: GEOMETRYDEF
RADIUS 0.5
INSERT OFFSET 0 0 0
VERTICES 2
0: 0 0 .1 0
1: 0 .5 0 3
"""
ITEMS = "# name bin min max flags\nfists 1 0 1 0x5 cog=weap_fists.cog\nbattery 42 0 10 82\n"
EPISODE = '"A Mod"\n\nTYPE 1\nSEQ 2\n10: 1 1 LEVEL one.jkl 0 0 20 -1\n20: 1 2 CUT end.smk 0 0 -1 -1\nend\n'
STRINGS = 'MSGS 2\n# comment\n"ONE" 0 "first"\n  "TWO" 0 "second" # note\nEND\n'

ALL = {
    "spr": SPRITE,
    "snd": SOUNDS,
    "pup": PUPPET,
    "ai": AI,
    "key": KEY,
    "par": PAR,
    "dat": ITEMS,
    "jk": EPISODE,
    "uni": STRINGS,
}


def read(extension: str, text: str) -> Asset:
    return read_asset(Source(f"x.{extension}", text.encode("latin-1")), extension)


def told(extension: str, text: str) -> list[tuple[str, str]]:
    return [(d.code.id, d.message) for d in read(extension, text).diagnostics]


@pytest.mark.parametrize("extension", ALL)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_well_formed_files(extension: str, end: str) -> None:
    assert told(extension, ALL[extension].replace("\n", end)) == []


def names(extension: str) -> list[tuple[str, str, str]]:
    found = read(extension, ALL[extension]).references
    return [(r.extension, r.name, getattr(r.place, "text", "")) for r in found]


def test_references() -> None:
    assert names("spr") == [("mat", "crate.mat", "crate.mat")]
    assert names("snd") == [("wav", "dooropen.wav", "dooropen.wav"), ("wav", "loop.wav", "loop.wav")]
    assert [n for _, n, _ in names("pup")] == ["kystand.key", "kywalk.key"]
    assert names("par") == [("mat", "smoke.mat", "MATERIAL smoke.mat")]
    assert names("dat") == [("cog", "weap_fists.cog", "weap_fists.cog")]
    assert [(e, n) for e, n, _ in names("jk")] == [("jkl", "one.jkl"), ("smk", "end.smk")]


def test_values() -> None:
    sprite, sounds, puppet = read("spr", SPRITE), read("snd", SOUNDS), read("pup", PUPPET)
    assert isinstance(sprite, Sprite)
    assert (sprite.material, sprite.type, sprite.size) == ("crate.mat", 1, (0.5, 0.25))
    assert isinstance(sounds, SoundClass)
    assert sounds.sounds == (("create", "dooropen.wav"), ("moving", "loop.wav"), ("stopmove", "none"))
    assert isinstance(puppet, Puppet)
    assert puppet.keyframes == ((0, "stand", "kystand.key"), (1, "walk", "kywalk.key"))
    assert puppet.joints == ((0, 9), (1, 3))
    ai, key, cloud = read("ai", AI), read("key", KEY), read("par", PAR)
    assert isinstance(ai, AIClass)
    assert ai.parameters == (("alignment", "-1.0"), ("maxstep", "0.3"), ("fov", "120"))
    assert ai.instincts == (("follow", "0.5"), ("primaryfire", "1", "2", "3"))
    assert isinstance(key, Keyframe)
    assert (key.frames, key.fps, key.joints, key.markers) == (10, 15.0, 3, ((4.0, 1),))
    assert key.nodes == (KeyNode(2, "k_head", 2),)
    assert isinstance(cloud, Cloud)
    assert (cloud.material, cloud.radius, cloud.cel.tolist()) == ("smoke.mat", 0.5, [0, 3])
    assert cloud.size == np.float32(0.02)
    items, episode, strings = read("dat", ITEMS), read("jk", EPISODE), read("uni", STRINGS)
    assert isinstance(items, Items)
    assert items.items == (Item("fists", 1, 0, 1, 5, "weap_fists.cog"), Item("battery", 42, 0, 10, 0x82, None))
    assert isinstance(episode, Episode)
    assert (episode.title, episode.type, [(s.line, s.file, s.next) for s in episode.steps]) == (
        "A Mod", 1, [(10, "one.jkl", 20), (20, "end.smk", -1)],
    )  # fmt: skip
    assert isinstance(strings, Strings)
    assert {key: text.text for key, text in strings.texts.items()} == {"one": "first", "two": "second"}


@pytest.mark.parametrize(
    ("extension", "old", "new", "wanted"),
    [
        ("spr", " 1 0.5", " 3 0.5", ("JK030", "the sprite has type 3, but the engine knows 0 to 2")),
        ("spr", ".25", "0", ("JK030", "the sprite is 0.5 by 0 JKU, but both must be above 0")),
        ("spr", "1 0 0 0 0", "1 0 0", ("JK030", "sprite: expected the y, a number, but the line ends")),
        ("spr", SPRITE, "", ("JK030", "expected a line with a sprite, but the file has none")),
        ("snd", "create dooropen.wav", "create", ("JK031", 'expected a mode and a sound, but found "create"')),
        ("pup", "0=9", "0:9", ("JK031", 'expected "body part=node", but found "0:9"')),
        ("pup", "0=9", "10=9", ("JK031", "body part 10 is named, but the engine knows 0 to 9")),
        ("pup", "end\n", "", ("JK031", 'the joints have no "end"')),
        ("ai", AI, "", ("JK030", "expected a line with parameters, but the file has none")),
        (
            "ai", "follow 0.5\n", "follow 0.5\n" * 16,
            ("JK819", "primaryfire is instinct 17 of the list, but the engine keeps 16"),
        ),
        ("key", "FPS 15.0\n", "", ("JK030", 'expected the line "fps", but found "JOINTS 3"')),
        ("key", "ENTRIES 2", "ENTRIES 3", ("JK032", "the heading announces 3 entries, but 2 follow")),
        ("key", "JOINTS 3", "JOINTS 2", ("JK033", "node 2 (k_head) is moved, but the animation has the joints 0 to 1")),
        (
            "key", "MARKERS 1\n4.0 1", "MARKERS 9" + "\n4.0 1" * 9,
            ("JK820", "the animation has 9 markers, but the engine takes 8"),
        ),
        ("par", "VERTICES 2", "VERTICES 1", ("JK032", "the heading announces 1 vertices, but 2 follow")),
        ("par", "1: 0 .5 0 3", "1: 0 .5 0 -1", ("JK033", "vertex 1 shows cel -1, but cels count from 0")),
        (
            "par", "VERTICES 2", "VERTICES 257\n" + "0: 0 0 0 0\n" * 255 + "# ",
            ("JK818", "the cloud has 257 vertices, but the engine takes 256"),
        ),
        ("dat", "fists 1", "fists 200", ("JK033", "item fists has bin 200, but the bins are 0 to 199")),
        (
            "dat", "fists 1 0", "fists one 0",
            ("JK031", 'item 0: expected the bin, a whole number, but found "one"; the engine reads 0'),
        ),
        ("jk", "0 0 20 -1", "0 0 30 -1", ("JK033", "step 10 leads to line 30, but there is none")),
        ("jk", "SEQ 2", "SEQ 3", ("JK032", "the heading announces 3 steps, but 2 follow")),
        ("jk", "TYPE 1\n", "", ("JK030", 'expected the line "type", but found "SEQ 2"')),
        ("uni", "MSGS 2", "MSGS 1", ("JK032", "the heading announces 1 texts, but 2 follow")),
        ("uni", "MSGS 2\n", "", ("JK030", 'expected "MSGS" and a count, but found ""ONE" 0 "first""')),
        ("uni", "END\n", "", ("JK031", 'the table has no "END"')),
        ("uni", '"TWO"', '"one"', ("JK031", 'the key "one" stands here again, but the engine keeps its first text')),
        ("uni", '"ONE" 0 "first"', "ONE 0 first", ("JK031", 'expected "key" number "text", but found "ONE 0 first"')),
    ],
)  # fmt: skip
def test_what_is_told(extension: str, old: str, new: str, wanted: tuple[str, str]) -> None:
    text = ALL[extension]
    assert old in text
    assert wanted in told(extension, text.replace(old, new, 1))


def test_a_file_in_which_a_text_is_cut() -> None:
    assert told("uni", f'MSGS 1\n"A" 0 "{"x" * 300}"\nEND\n') == [
        ("JK031", "the line has 308 bytes, but the engine reads 254")
    ]


@pytest.mark.skipif(not list(corpus_assets("uni")), reason="the corpus of real mods is not at hand")
def test_real_files() -> None:
    """The three findings below were read in the files: two counts, and one key that stands twice."""
    found = {
        path: [d.code.id for d in read_asset(Source(path, data), path.rpartition(".")[2].lower()).diagnostics]
        for path, data in corpus_assets("uni", "jk", "snd", "spr")
    }
    assert len(found) == 21
    assert {path: codes for path, codes in found.items() if codes} == {
        "Phaser.gob!ui/jkstrings.uni": ["JK032"],
        "masspack.gob!misc/cogstrings.uni": ["JK032", "JK031"],
    }


@pytest.mark.parametrize("extension", ["par", "key", "jk"])
def test_a_file_of_something_else_is_told_once(extension: str) -> None:
    """Each line that should come is missing, but the one line that stands there is wrong once."""
    assert [code for code, _ in told(extension, "title\nsomething else\n")] == ["JK030"]
    assert [code for code, _ in told(extension, "\x00\x01\x02" * 300)] == ["JK030"]


def test_two_missing_lines_in_two_places_are_told_both() -> None:
    text = PAR.replace("SIZE 0.02\n", "").replace("RADIUS 0.5\n", "")
    assert [m for _, m in told("par", text)] == [
        'expected the line "size", but found "MATERIAL smoke.mat"',
        'expected the line "radius", but found "INSERT OFFSET 0 0 0"',
    ]
