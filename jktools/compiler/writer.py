"""Writes a compiled level: the same bytes for the same input and settings, on any machine."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import flatbuffers
import numpy as np

from jktools import __version__
from jktools.compiler import level_generated as fb
from jktools.compiler.checksum import seal
from jktools.compiler.columns import SECTIONS, camel_case
from jktools.compiler.cut import Omission
from jktools.compiler.errors import CompiledFileError, CompileError
from jktools.compiler.passes import Outcome, Progress, run
from jktools.compiler.reader import FORMAT_MAJOR, FORMAT_MINOR, CompiledLevel
from jktools.compiler.sections import Columns, Strings
from jktools.compiler.settings import CompileSettings
from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.model import Level

ALIGNMENT = 8
"""Bytes; every vector starts at a multiple, so that a mapped file can be viewed as arrays of any scalar."""

FIRST_GUESS = 1 << 20
"""Bytes that the builder starts with; it grows by doubling."""


@dataclass(frozen=True, slots=True)
class Compilation:
    """A compiled level, and what went wrong on the way."""

    data: bytes
    failures: tuple[str, ...]
    """Bugs in jktools: a sentence for each pass that failed, whose section is absent."""


def compile_level(level: Level, settings: CompileSettings | None = None) -> bytes:
    """Compile a level as `compilation` does, and give the file's bytes alone."""
    return compilation(level, settings).data


def compilation(
    level: Level,
    settings: CompileSettings | None = None,
    facts: LevelFacts | None = None,
    progress: Progress = lambda _: None,
) -> Compilation:
    """Compile a level.

    Raises CompileError when the engine would refuse it or read beyond its lists, PassError when a pass fails and the
    settings do not say to keep going.
    """
    settings = settings or CompileSettings()
    _refuse_broken(level)
    strings = Strings()
    outcomes = run(facts or LevelFacts(level), strings, settings, progress)
    data = _assemble(level, settings, strings, outcomes)
    try:
        CompiledLevel(data, level.path)
    except CompiledFileError as error:
        raise CompileError(
            f"cannot compile {level.path}: {error.__cause__ or error}; `jktools lint` tells where"
        ) from error
    return Compilation(data, tuple(o.note for o in outcomes.values() if o.failed))


def _refuse_broken(level: Level) -> None:
    if not level.has_geometry:
        raise CompileError(f"cannot compile {level.path}: it has no GEORESOURCE, so it is no level")
    errors = [d for d in level.diagnostics if d.severity is Severity.ERROR]
    if errors:
        first = errors[0]
        span = first.label.span
        where = f" line {span.first.line}" if span else ""
        more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
        raise CompileError(
            f"cannot compile {level.path}: the engine refuses it:{where} [{first.code}] {first.message}{more}"
        )


def _assemble(level: Level, settings: CompileSettings, strings: Strings, outcomes: Mapping[str, Outcome]) -> bytes:
    builder = flatbuffers.Builder(FIRST_GUESS)
    offsets: dict[str, int] = {}
    for name, outcome in outcomes.items():
        if outcome.columns is not None:
            offsets[name] = _section(builder, name, outcome.columns)
    offsets["world"] = _world(builder, level)
    offsets["strings"] = _strings(builder, strings.texts)
    offsets["passes"] = _passes(builder, outcomes)
    omissions = [omission for outcome in outcomes.values() for omission in outcome.omissions]
    if omissions:
        offsets["omissions"] = _omissions(builder, omissions)
    offsets["settings"] = _table(
        builder, "Settings",
        game=builder.CreateString(level.game), engine=builder.CreateString(settings.engine),
        accuracy=builder.CreateString(settings.accuracy),
    )  # fmt: skip
    offsets["inputs"] = _inputs(builder, level)
    offsets["checksum"] = _vector(builder, np.zeros(hashlib.sha256().digest_size, np.uint8))
    offsets["tool_version"] = builder.CreateString(__version__)
    root = _table(builder, "Level", format_major=FORMAT_MAJOR, format_minor=FORMAT_MINOR, **offsets)
    builder.Finish(root, b"JKLB")
    return seal(builder.Output())


def _section(builder: flatbuffers.Builder, name: str, columns: Columns) -> int:
    offsets = {}
    for key, column in SECTIONS[name].items():
        values = np.ascontiguousarray(columns[key], f"<{column.type}").reshape(-1)
        offsets[key] = _vector(builder, values)
    return _table(builder, camel_case(name), **offsets)


def _vector(builder: flatbuffers.Builder, values: np.ndarray[Any, Any]) -> int:
    # The Python builder ignores force_align; Prep makes the first byte of the data fall on a multiple.
    builder.Prep(ALIGNMENT, values.nbytes)
    return int(builder.CreateNumpyVector(values))


def _table(builder: flatbuffers.Builder, kind: str, /, **fields: int | float) -> int:
    """A table of the schema from its fields, by their names in the schema."""
    getattr(fb, f"{kind}Start")(builder)
    for field, value in fields.items():
        getattr(fb, f"{kind}Add{camel_case(field)}")(builder, value)
    return int(getattr(fb, f"{kind}End")(builder))


def _offsets(builder: flatbuffers.Builder, offsets: Sequence[int]) -> int:
    builder.StartVector(4, len(offsets), 4)
    for offset in reversed(offsets):
        builder.PrependUOffsetTRelative(offset)
    return int(builder.EndVector())


def _strings(builder: flatbuffers.Builder, texts: Sequence[str]) -> int:
    return _offsets(builder, [builder.CreateString(text) for text in texts])


def _inputs(builder: flatbuffers.Builder, level: Level) -> int:
    digest = np.frombuffer(hashlib.sha256(level.source.data).digest(), np.uint8)
    path = builder.CreateString(level.source.name)
    return _offsets(builder, [_table(builder, "Input", path=path, sha256=_vector(builder, digest))])


def _omissions(builder: flatbuffers.Builder, omissions: Sequence[Omission]) -> int:
    return _offsets(
        builder,
        [
            _table(
                builder, "Omission", section=builder.CreateString(each.section),
                reason=builder.CreateString(each.reason), source=_vector(builder, np.array(each.source, "<i4")),
                name=_strings(builder, each.names),
            )
            for each in omissions
        ],
    )  # fmt: skip


def _passes(builder: flatbuffers.Builder, outcomes: Mapping[str, Outcome]) -> int:
    passes = []
    for name, outcome in outcomes.items():
        fields: dict[str, int] = {"name": builder.CreateString(name), "ran": outcome.columns is not None}
        if outcome.note:
            fields["note"] = builder.CreateString(outcome.note)
        passes.append(_table(builder, "Pass", **fields))
    return _offsets(builder, passes)


def _world(builder: flatbuffers.Builder, level: Level) -> int:
    header = level.header
    fields: dict[str, int | float] = {"version": header.version}
    for name, values in header.values.items():
        fields[name] = _vector(builder, values) if len(values) > 1 else float(values[0])
    return _table(builder, "World", **fields)
