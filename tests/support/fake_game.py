"""A small game and a mod for it, of every kind of file that the engine reads: what one names is there."""

from __future__ import annotations

import struct
from pathlib import Path

from tests.support.assets import BLOCK
from tests.support.levels import gob_of, two_rooms
from tests.support.packs import write


def material() -> bytes:
    """A texture of 8 by 8."""
    head = struct.pack("<4sIIII14I", b"MAT ", 0x32, 2, 1, 1, 0, 8, *[0] * 12)
    return head + struct.pack("<10I", 8, 0, 0, 0, 0, 0, 0, 0, 0, 0) + struct.pack("<6I", 8, 8, 0, 0, 0, 1) + bytes(64)


def colormap() -> bytes:
    """A palette with its light table."""
    return struct.pack("<4sII3f", b"CMP ", 30, 0, 1, 1, 1).ljust(64, b"\0") + bytes(768 + 64 * 256)


def wave() -> bytes:
    """Four samples of silence."""
    body = (
        b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 1, 1, 22050, 22050, 1, 8) + b"data" + struct.pack("<I", 4) + bytes(4)
    )
    return b"RIFF" + struct.pack("<I", len(body)) + body


def script(symbols: str, code: str) -> str:
    """A script that does one thing when the level starts."""
    return f"flags=0x240\nsymbols\nmessage startup\n{symbols}end\ncode\nstartup:\n{code}return;\nend\n"


def model(*materials: str) -> str:
    """The block with other materials."""
    return BLOCK.replace("stone.mat", materials[0]).replace("glass.mat", materials[-1])


KEY = """SECTION: HEADER
FLAGS 0x0
TYPE 0x1
FRAMES 10
FPS 15.0
JOINTS 3
SECTION: KEYFRAME NODES
NODES 1
NODE 2
MESH NAME arm
ENTRIES 1
0: 0 0x1 0 0 0 0 0 0
  0 0 0 0 0 0
"""

CLOUD = """SECTION: HEADER
PAR 1.0
SIZE 0.02
MATERIAL smoke.mat
LIGHTINGMODE 0
SECTION: GEOMETRYDEF
RADIUS 0.5
INSERT OFFSET 0 0 0
VERTICES 1
0: 0 0 .1 0
"""

STATIC = """SECTION: COGS
World cogs 1
0: everywhere.cog 3
end
SECTION: TEMPLATES
World templates 1
_walk none type=actor move=physics size=.065
end
"""

GAME: dict[str, bytes | str] = {
    "jkl/static.jkl": STATIC,
    "misc/items.dat": "fists 1 0 1 0x5 cog=fists.cog\nend\n",
    "misc/cmp/rooms.cmp": colormap(),
    "misc/ai/default.ai": "maxstep=0.3\n",
    "misc/ai/guard.ai": "maxstep=0.3\nfollow 0.5\n",
    "misc/pup/ky.pup": "mode=0\nstand kystand.key 0x20 1 2\n",
    "misc/snd/ky.snd": "create step.wav\n",
    "misc/spr/default.spr": "dflt.mat 0 1 1 4 3 1 0 0 0 0\n",
    "misc/spr/flash.spr": "flash.mat 0 1 1 4 3 1 0 0 0 0\n",
    "misc/par/smoke.par": CLOUD,
    "3do/dflt.3do": model("dflt.mat"),
    "3do/ky.3do": model("kyle.mat", "saber.mat"),
    "3do/key/kystand.key": KEY,
    "mat/dflt.mat": material(),
    "mat/wall.mat": material(),
    "mat/flash.mat": material(),
    "mat/smoke.mat": material(),
    "mat/lost.mat": material(),
    "3do/mat/kyle.mat": material(),
    "3do/mat/saber.mat": material(),
    "sound/wind.wav": wave(),
    "sound/step.wav": wave(),
    "voice/hello.wav": wave(),
    "cog/everywhere.cog": script("int left=3\n", 'CreateThing(LoadTemplate("by_static"), 0);\n'),
    "cog/fists.cog": script("template shot=by_item local\n", "CreateThing(shot, 0);\n"),
    "cog/kyle.cog": script("sound hello=hello.wav local\n", "PlaySoundLocal(hello, 1, 0, 0);\n"),
}
"""The game's own files."""

TEMPLATES = """World templates 16
walkplayer _walk type=player model3d=ky.3do puppet=ky.pup soundclass=ky.snd cog=kyle.cog
crate none type=cog collide=1 size=.1
bit none type=debris sprite=flash.spr
smoke none type=particle particle=smoke.par count=4 elementsize=.02 material=smoke.mat
bang none type=explosion debris=bit creatething=smoke
guard _walk aiclass=guard.ai explode=bang
by_static none type=item
by_item none type=weapon explode=bang
by_value none type=debris model3d=block.3do
by_literal none type=item
parent none type=item size=.2
child parent size=.3
lost_bit none type=debris sprite=lost.spr
lost none type=explosion debris=lost_bit
+twinkle none type=explosion"""

MOD: dict[str, bytes | str] = {
    "jkl/rooms.jkl": two_rooms(
        "World sounds 4", "step.wav", "hello.wav", "lost.wav",
        "World materials 2", "1: lost.mat 1 1",
        "World AIClasses 1", "0: guard.ai",
        "World models 3", "0: ky.3do", "1: block.3do", "2: lost.3do",
        "World sprites 2", "0: flash.spr", "1: lost.spr",
        "World keyframes 2", "0: kystand.key", "1: lost.key",
        "World puppets 1", "0: ky.pup",
        "World soundclasses 1", "0: ky.snd",
        "World scripts 3", "0: door.cog", "1: kyle.cog", "2: lost.cog",
        "World cogs 4", "0: door.cog by_value",
        *TEMPLATES.splitlines(),
        "World things 4", "2: guard guard .5 .5 .2 0 0 0 0", "3: child child .5 .5 .2 0 0 0 0",
    ),
    "episode.jk": '"A Mod"\nTYPE 1\nSEQ 1\n10: 1 1 LEVEL rooms.jkl 0 0 -1 -1\nend\n',
    "3do/block.3do": model("stone.mat", "glass.mat"),
    "3do/mat/stone.mat": material(),
    "3do/mat/glass.mat": material(),
    "cog/door.cog": script(
        "template made\nthing other local\n", 'CreateThing(made, other);\nLoadTemplate("by_literal");\n'
    ),
    "3do/lost.3do": model("wall.mat"),
    "misc/spr/lost.spr": "lost.mat 0 1 1 4 3 1 0 0 0 0\n",
    "3do/key/lost.key": KEY,
    "sound/lost.wav": wave(),
    "cog/lost.cog": script("", 'Print("lost");\n'),
}  # fmt: skip
"""The mod's own files: what is called `lost` is listed, and nothing in play leads to it."""


def pack_of(files: dict[str, bytes | str]) -> bytes:
    """A GOB of them."""
    return gob_of(
        [(n.replace("/", "\\"), d if isinstance(d, bytes) else d.encode("latin-1")) for n, d in files.items()]
    )


def install(folder: Path, *, without: str = "") -> tuple[Path, Path]:
    """Write the mod as a GOB and the game as a folder with one; a file may be left out. Gives both paths."""
    mod = write(folder / "mod.gob", pack_of({n: d for n, d in MOD.items() if n != without}))
    game = {n: d for n, d in GAME.items() if n != without}
    write(folder / "game/resource/res.gob", pack_of(game))
    return mod, folder / "game"
