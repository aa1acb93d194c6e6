"""WAV, the sounds: their header, and whether the engine can play them."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from jktools.diagnostics.wording import counted
from jktools.source import Source
from jktools.syntax.assets import faults
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.binary import ByteReader

RIFF = struct.Struct("<4sI4s")
CHUNK = struct.Struct("<4sI")
FORMAT = struct.Struct("<HHIIHH")
PCM = 1
MOST_CHUNKS = 1000
"""A wave has a handful; a file of garbage must not be walked byte by byte."""

_NAMES = {
    2: "Microsoft ADPCM",
    3: "floating point",
    6: "A-law",
    7: "mu-law",
    17: "IMA ADPCM",
    85: "MP3",
    0xFFFE: "extensible",
}


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Wave(Asset):
    """A WAV file's header."""

    encoding: int = 0
    """1 is PCM, the only one that the engine plays."""
    channels: int = 0
    rate: int = 0
    """Samples a second."""
    bits: int = 0
    """Per sample."""
    size: int = 0
    """Bytes of samples."""

    @property
    def seconds(self) -> float:
        """How long it plays; 0 where the header does not say."""
        frame = self.channels * self.bits // 8
        return self.size / (frame * self.rate) if frame and self.rate else 0.0


def read_wave(source: Source) -> Wave:
    """Read a WAV's header. Never raises: what is wrong is told in `Wave.diagnostics`.

    What the engine plays: PCM of 8 or 16 bits with one or two channels. It takes the first chunk for the format, never
    looks at the encoding, and hands the samples of the chunk `data` on unchanged (stdSound_ParseWav in the decompiled
    engine).
    """
    data = ByteReader(source, "the sound")
    riff = data.take(RIFF, "its header")
    if riff is None or not (data.starts(b"RIFF", riff[0]) and data.starts(b"WAVE", riff[2])):
        return Wave(source=source, diagnostics=data.finish())
    form: tuple[int, ...] | None = None
    size = -1
    for _ in range(MOST_CHUNKS):
        if data.left < CHUNK.size or (form is not None and size >= 0):
            break
        name, length = data.take(CHUNK, "a chunk") or (b"", 0)
        start = data.at
        if start == RIFF.size + CHUNK.size and name != b"fmt ":
            data.faults.tell(
                faults.UNPLAYABLE_SOUND, source,
                f'the sound starts with the chunk "{name.decode("latin-1").strip()}", but the engine takes the first '
                'for "fmt"',
                "export it again without what stands before",
            )  # fmt: skip
        if name == b"fmt " and length >= FORMAT.size and data.left >= FORMAT.size:
            form = FORMAT.unpack_from(source.data, start)
        if name == b"data":
            size = min(length, data.left)
        if not data.skip(length, f'its chunk "{name.decode("latin-1").strip()}"'):
            break
        data.at += min(length % 2, data.left)
    if not data.lost:
        data.lost = True  # what editors append behind the samples is nobody's fault
    encoding, channels, rate, _, _, bits = form or (0, 0, 0, 0, 0, 0)
    for there, chunk in ((form is not None, "fmt "), (size >= 0, "data")):
        if not there and not data.faults.found:
            data.faults.tell(
                faults.MALFORMED_ASSET, source, f'the sound has no chunk "{chunk.strip()}", but the engine needs one',
                "export it again as PCM; the engine cannot play it",
            )  # fmt: skip
    if form is not None and (encoding != PCM or channels not in (1, 2) or bits not in (8, 16)):
        shown = "PCM" if encoding == PCM else _NAMES.get(encoding, f"of encoding {encoding}")
        data.faults.tell(
            faults.UNPLAYABLE_SOUND, source,
            f"the sound is {shown} with {bits} bits and {counted(channels, 'channel')}, but the engine plays PCM with "
            "8 or 16 bits and 1 or 2",
            "export it again as PCM, mono, 16 bits",
        )  # fmt: skip
    return Wave(
        source=source, diagnostics=data.finish(), encoding=encoding, channels=channels, rate=rate, bits=bits,
        size=max(0, size),
    )  # fmt: skip
