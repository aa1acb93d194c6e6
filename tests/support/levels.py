"""Levels for tests: the two rooms, with fragments laid over them, and the corpus where it is at hand."""

from __future__ import annotations

import contextlib
import re
import struct
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

from jktools.model import Level
from jktools.session import load
from jktools.source import Source
from jktools.syntax.jkl import read

ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT.parent / "shared" / "corpus"
TWO_ROOMS = (ROOT / "tests/data/two_rooms.jkl").read_text("ascii")


def two_rooms(*fragment: str) -> str:
    """The text of the two rooms with a fragment laid over it.

    Lines of a fragment: a heading (`World adjoins 2`, `Sector 1`, `Section: THINGS`) replaces the heading of that
    name and chooses the block; a record replaces the record of the block with the same label, keyword or name, or
    is added at the block's end; `- line` deletes a line of the block, `+ line` adds one at the end of the file.
    `Normals` chooses the block of normals, which has no heading of its own.
    """
    lines = TWO_ROOMS.split("\n")
    start, end = 0, len(lines)
    for record in fragment:
        if record.startswith("+ "):
            lines.append(record[2:])
        elif record.startswith("- "):
            at = next(i for i in range(start, end) if lines[i].lower() == record[2:].lower())
            del lines[at]
            end -= 1
        elif record == "Normals":
            start = _block(lines, "World surfaces")[1]
            end = lines.index("", start + 1)
        elif re.match(r"world |sector \d|section:", record, re.IGNORECASE):
            start, end = _block(lines, record)
            lines[start] = record
        else:
            at = next((i for i in range(start + 1, end) if _key(lines[i]) == _key(record)), end)
            if at == end:
                at = next((i for i in range(start + 1, end) if lines[i] == "end"), end)
                lines.insert(at, record)
                end += 1
            else:
                lines[at] = record
    return "\n".join(lines)


FILE = "== "
"""In a fragment, starts the text of a file that lies beside the level, as `== cog/door.cog`."""


@contextlib.contextmanager
def level_with_files(*fragment: str, game: str = "jk") -> Iterator[Level]:
    """The two rooms with a fragment laid over them, in a folder with the files that the fragment holds."""
    starts = [i for i, line in enumerate(fragment) if line.startswith(FILE)]
    texts = {"jkl/test.jkl": two_rooms(*fragment[: starts[0]])}
    for start, end in zip(starts, [*starts[1:], len(fragment)], strict=True):
        texts[fragment[start].removeprefix(FILE)] = "\n".join([*fragment[start + 1 : end], ""])
    with tempfile.TemporaryDirectory() as folder:
        for name, text in texts.items():
            place = Path(folder, name)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, "latin-1", newline="")
        yield load(str(Path(folder, "jkl/test.jkl")), game="mots" if game == "mots" else "jk")


def _block(lines: list[str], heading: str) -> tuple[int, int]:
    words = re.sub(r"\s*\d+$", "", heading).lower() if heading.lower().startswith("world") else heading.lower()
    start = next(i for i, line in enumerate(lines) if line.lower().startswith(words))
    end = next(
        (i for i in range(start + 1, len(lines)) if re.match(r"world |sector |section:|$", lines[i], re.IGNORECASE)),
        len(lines),
    )
    return start, end


def _key(line: str) -> str:
    return line.split()[0].lower() if line.split() else ""


def level_of(text: str | bytes, path: str = "test.jkl", game: str = "jk") -> Level:
    """A level from its text."""
    return Level(read(Source(path, text.encode("latin-1") if isinstance(text, str) else text), game))


def gob_of(files: Sequence[tuple[str, bytes]]) -> bytes:
    """A GOB, written apart from the code under test."""
    offset = 16 + 136 * len(files)
    directory, body = b"", b""
    for name, data in files:
        directory += struct.pack("<II128s", offset + len(body), len(data), name.encode("latin-1"))
        body += data
    return struct.pack("<4sIII", b"GOB ", 20, 12, len(files)) + directory + body


def corpus_files() -> Iterator[tuple[str, bytes]]:
    """Every JKL of the corpus with its bytes, unpacked apart from the code under test."""
    for path in sorted((CORPUS / "gob").glob("*")) if CORPUS.exists() else []:
        data = path.read_bytes()
        for i in range(struct.unpack_from("<I", data, 12)[0]):
            offset, size, raw = struct.unpack_from("<II128s", data, 16 + 136 * i)
            name = raw.split(b"\0")[0].decode("latin-1").replace("\\", "/")
            if name.lower().endswith(".jkl"):
                yield f"{path.name}!{name}", data[offset : offset + size]
    for path in sorted((CORPUS / "jkl").glob("*.jkl")) if CORPUS.exists() else []:
        yield path.name, path.read_bytes()
