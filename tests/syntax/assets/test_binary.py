"""MAT, CMP and WAV: every byte accounted for, and what is wrong told."""

from __future__ import annotations

import struct

import pytest

from jktools.source import Source
from jktools.syntax.assets.colormap import read_colormap
from jktools.syntax.assets.material import Material, read_material
from jktools.syntax.assets.wave import read_wave
from tests.support.assets import corpus_assets

MATERIALS, WAVES = list(corpus_assets("mat")), list(corpus_assets("wav"))


def mat(
    cels: list[tuple[int, ...]],
    textures: list[tuple[int, int, int, int]],
    kind: int = 2,
    bits: int = 8,
    head: bytes = b"MAT ",
) -> bytes:
    """A MAT, written apart from the code under test; a texture is width, height, flag and number of sizes."""
    data = head + struct.pack("<IIII", 0x32, kind, len(cels), len(textures)) + struct.pack("<14I", 0, bits, *[0] * 12)
    assert len(data) == 76
    for cel in cels:
        data += struct.pack("<6I", cel[0], cel[1], 0, 0, 0, 0)
        if cel[0] == 8:
            data += struct.pack("<4I", 0, 0, 0, cel[2])
    for width, height, flag, sizes in textures:
        data += struct.pack("<6I", width, height, flag, 0, 7, sizes)
        for k in range(sizes):
            data += bytes(max(1, width >> k) * max(1, height >> k) * bits // 8)
    return data


def read(data: bytes) -> Material:
    return read_material(Source("x.mat", data))


def codes(data: bytes) -> list[str]:
    return [d.code.id for d in read(data).diagnostics]


def test_a_material() -> None:
    material = read(mat([(8, 3, 1), (0, 5)], [(64, 32, 0, 1), (16, 8, 1, 4)], bits=16))
    assert material.diagnostics == ()
    assert [(c.type, c.color, c.texture) for c in material.cels] == [(8, 3, 1), (0, 5, None)]
    assert [(t.width, t.height, t.transparent, t.transparent_color, t.mips) for t in material.textures] == [
        (64, 32, False, 7, 1),
        (16, 8, True, 7, 4),
    ]
    assert (material.type, material.bits, material.is_color, material.size) == (2, 16, False, (16, 8))
    colour = read(mat([(0, 5)], [], kind=0))
    assert (colour.diagnostics, colour.is_color, colour.size) == ((), True, None)


def test_what_is_wrong_with_a_material_is_told() -> None:
    good = mat([(8, 3, 0)], [(8, 8, 0, 4)])
    assert codes(good) == []
    assert codes(good[:-1]) == ["JK034"]
    assert codes(good + b"\0") == ["JK035"]
    assert codes(good[:50]) == ["JK034"]
    assert codes(b"MAX " + good[4:]) == ["JK030"]
    assert codes(mat([(8, 3, 1)], [(8, 8, 0, 1)])) == ["JK033"]
    assert codes(mat([(4, 3)], [])) == ["JK036"]
    assert codes(mat([(0, 1)] * 16, [], kind=0)) == []
    assert codes(mat([(0, 1)] * 17, [], kind=0)) == ["JK817"]
    assert codes(good[:12] + struct.pack("<I", 2**32 - 1) + good[16:]) != []
    assert codes(mat([(8, 3, 0)], [(8, 8, 0, 4)])[:4] + struct.pack("<I", 0x33) + good[8:]) == ["JK036"]


@pytest.mark.skipif(not MATERIALS, reason="the corpus of real mods is not at hand")
def test_no_byte_of_a_real_material_is_unexplained() -> None:
    """The reader tells of bytes that are left and of bytes that are missing; here nothing may be told."""
    colours = 0
    for path, data in MATERIALS:
        material = read(data)
        assert material.diagnostics == (), path
        assert len(material.textures) == struct.unpack_from("<I", data, 16)[0], path
        assert len(material.cels) == struct.unpack_from("<I", data, 12)[0], path
        assert codes(data + b"x") == ["JK035"], path
        assert codes(data[:-1]) == ["JK034"], path
        colours += material.is_color
    assert (len(MATERIALS), colours) == (152, 5)


def cmp(flags: int, light: bool, size: int = 0) -> bytes:
    palette = bytes(range(256)) * 3
    data = b"CMP " + struct.pack("<II3f40x", 30, flags, 0.5, 0, 1) + palette + (bytes(64 * 256) if light else b"")
    return data + (bytes(65536) if flags & 1 else b"") + bytes(size)


@pytest.mark.parametrize(("flags", "light", "size"), [(1, True, 82752), (0, True, 17216), (0, False, 832)])
def test_a_colormap(flags: int, light: bool, size: int) -> None:
    data = cmp(flags, light)
    assert len(data) == size
    colormap = read_colormap(Source("x.cmp", data))
    assert colormap.diagnostics == ()
    assert (colormap.tint, colormap.has_light, colormap.has_transparency) == ((0.5, 0, 1), light, bool(flags))
    assert colormap.palette[1].tolist() == [3, 4, 5]
    for wrong, code in (
        (data[:-1], "JK034"),
        (data + b"x", "JK034" if not light else "JK035"),
        (b"XMP" + data[3:], "JK030"),
    ):
        assert [d.code.id for d in read_colormap(Source("x.cmp", wrong)).diagnostics] == [code]


def wav(
    encoding: int = 1, channels: int = 1, bits: int = 16, samples: bytes = bytes(44100), first: bytes = b""
) -> bytes:
    block = channels * bits // 8
    form = struct.pack("<HHIIHH", encoding, channels, 22050, 22050 * block, block, bits)
    body = (
        b"WAVE" + first + b"fmt " + struct.pack("<I", 16) + form + b"data" + struct.pack("<I", len(samples)) + samples
    )
    return b"RIFF" + struct.pack("<I", len(body)) + body


def heard(data: bytes) -> list[str]:
    return [d.code.id for d in read_wave(Source("x.wav", data)).diagnostics]


def test_a_sound() -> None:
    wave = read_wave(Source("x.wav", wav()))
    assert wave.diagnostics == ()
    assert (wave.encoding, wave.channels, wave.rate, wave.bits, wave.size, wave.seconds) == (
        1,
        1,
        22050,
        16,
        44100,
        1.0,
    )
    assert heard(wav() + b"LIST\4\0\0\0abcd") == []
    assert heard(wav(channels=2, bits=8)) == []


def test_sounds_that_the_engine_cannot_play() -> None:
    assert heard(wav(encoding=2)) == ["JK822"]
    assert heard(wav(bits=24)) == ["JK822"]
    assert heard(wav(channels=6)) == ["JK822"]
    assert heard(wav(first=b"LIST\4\0\0\0abcd")) == ["JK822"]
    assert heard(wav()[:-10]) == ["JK034"]
    assert heard(b"RIFX" + wav()[4:]) == ["JK030"]
    assert heard(wav()[:12]) == ["JK030"]
    assert heard(b"") == ["JK034"]


@pytest.mark.skipif(not WAVES, reason="the corpus of real mods is not at hand")
def test_real_sounds_can_be_played() -> None:
    assert [heard(data) for _, data in WAVES] == [[]] * 6


def test_a_side_of_a_picture_is_never_below_1() -> None:
    assert codes(mat([(8, 3, 0)], [(16, 2, 0, 4), (1, 16, 0, 5)])) == []


def test_a_cel_without_its_texture_has_no_size() -> None:
    assert read(mat([(8, 3, 1)], [(8, 8, 0, 1)])).size is None


def test_absurd_numbers_of_sizes_are_no_picture() -> None:
    good = mat([(8, 3, 0)], [(8, 8, 0, 1)])
    at = len(good) - 64 - 4  # the last field before the pixels
    for sizes in (0, 33, 2**32 - 1):
        assert codes(good[:at] + struct.pack("<I", sizes) + good[at + 4 :])[0] == "JK036"


def test_only_the_flag_of_transparency_brings_its_table() -> None:
    head = struct.pack("<4sII3f", b"CMP ", 30, 4, 1, 1, 1).ljust(64, b"\0")
    colormap = read_colormap(Source("x.cmp", head + bytes(768 + 64 * 256)))
    assert (colormap.diagnostics, colormap.has_light, colormap.has_transparency) == ((), True, False)
