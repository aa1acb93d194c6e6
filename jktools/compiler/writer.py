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
from jktools.compiler.columns import OMISSION, SECTIONS, TEXT, Column, camel_case
from jktools.compiler.cut import Omission
from jktools.compiler.errors import CompiledFileError, CompileError
from jktools.compiler.grid import grid_of, on_grid
from jktools.compiler.mapping import IDENTIFIER
from jktools.compiler.packing import VECTORS, Stored, pack, pack_group, plain_array
from jktools.compiler.passes import Outcome, Progress, run
from jktools.compiler.reader import ALIGNMENT, FORMAT_MAJOR, FORMAT_MINOR, CompiledLevel
from jktools.compiler.sections import Columns, Strings, parameter_keys
from jktools.compiler.settings import CompileSettings
from jktools.compiler.text import written
from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.model import Level

FIRST_GUESS = 1 << 20
"""Bytes that the builder starts with; it grows by doubling."""


@dataclass(frozen=True, slots=True)
class Compilation:
    """A compiled level, and what went wrong on the way."""

    data: bytes
    failures: tuple[str, ...]
    """Bugs in jktools: a sentence for each pass that failed, whose section is absent."""
    step: float = 0.0
    """Of the grid that the vertices are on, JKU; 0 where they are as read."""


def compile_level(level: Level, settings: CompileSettings | None = None) -> bytes:
    """Compile a level as `compilation` does, and give the file's bytes alone."""
    return compilation(level, settings).data


WRITING = "write"
"""What comes behind the passes: the file is put together and checked."""


def compilation(
    level: Level,
    settings: CompileSettings | None = None,
    facts: LevelFacts | None = None,
    progress: Progress = lambda _: None,
) -> Compilation:
    """Compile a level. `progress` is told the name of each pass before it runs, and `WRITING` behind the last.

    With `facts`, what they have worked out is not worked out again; the file then lists all that was ever looked for.
    Raises CompileError when the engine would refuse it or read beyond its lists, PassError when a pass fails and the
    settings do not say to keep going.
    """
    settings = settings or CompileSettings()
    _refuse_broken(level)
    if facts is None:
        # What was looked for before is no matter of this file.
        level = level.anew()
        facts = LevelFacts(level)
    if settings.accuracy == "fast":
        level = on_grid(level)
        facts = LevelFacts(level, facts.vocabulary)
    strings = Strings(parameter_keys(level))
    outcomes = run(facts, strings, settings, progress)
    progress(WRITING)
    data = _assemble(level, settings, strings, outcomes)
    try:
        CompiledLevel(data, level.path)
    except CompiledFileError as error:
        raise CompileError(
            f"cannot compile {level.path}: {error.__cause__ or error}; `jktools lint` tells where"
        ) from error
    grid = grid_of(level)
    return Compilation(data, tuple(o.note for o in outcomes.values() if o.failed), grid.step if grid else 0.0)


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
    grid = grid_of(level)
    step = grid.step if grid else 0.0
    file = _File(plain=settings.plain)
    builder = file.builder
    offsets: dict[str, int] = {}
    for name, outcome in outcomes.items():
        if outcome.columns is not None:
            offsets[name] = _table(builder, camel_case(name), **file.columns(outcome.columns, SECTIONS[name]))
    omissions = [omission for outcome in outcomes.values() for omission in outcome.omissions]
    if omissions:
        offsets["omissions"] = _omissions(file, omissions, strings)
    offsets |= _text(file, strings.texts)
    offsets["world"] = _world(file, level)
    offsets["passes"] = _passes(builder, outcomes)
    offsets["settings"] = _table(
        builder, "Settings",
        game=builder.CreateString(level.game), engine=builder.CreateString(settings.engine),
        accuracy=builder.CreateString(settings.accuracy), cut_anyway=settings.cut_anyway, plain=settings.plain,
        vertex_step=step,
        **{
            name: _strings(builder, sorted(passes))
            for name, passes in (("only", settings.only), ("skip", settings.skip))
            if passes
        },
    )  # fmt: skip
    offsets["inputs"] = _inputs(file, level)
    offsets["checksum"] = file.vector(np.zeros(hashlib.sha256().digest_size, np.uint8), shared=False)
    offsets["tool_version"] = builder.CreateString(__version__)
    root = _table(builder, "Level", format_major=FORMAT_MAJOR, format_minor=FORMAT_MINOR, **offsets)
    builder.Finish(root, IDENTIFIER)
    return seal(builder.Output())


class _File:
    """A file being written: vectors of the same bytes are written once."""

    def __init__(self, *, plain: bool) -> None:
        self.plain = plain
        """Whether every column is its plain vector."""
        self.builder = flatbuffers.Builder(FIRST_GUESS)
        self._written: dict[tuple[int, bytes], int] = {}

    def vector(self, values: np.ndarray[Any, Any], *, shared: bool = True) -> int:
        """Write a vector, or find the one that has its bytes."""
        flat = np.ascontiguousarray(values).reshape(-1)
        key = (flat.itemsize, flat.tobytes())
        if shared and key in self._written:
            return self._written[key]
        # The Python builder ignores force_align; Prep makes the first byte of the data fall on a multiple.
        self.builder.Prep(ALIGNMENT, flat.nbytes)
        offset = int(self.builder.CreateNumpyVector(flat))
        if shared:
            self._written[key] = offset
        return offset

    def columns(self, values: Columns, columns: Mapping[str, Column]) -> dict[str, int]:
        """Write columns in their smallest forms, or as plain vectors: the offset of each by its field."""
        if self.plain:
            return {
                name: self.vector(plain_array(values[name], column))
                for name, column in columns.items()
                if column.until is None
            }
        stored: dict[str, Stored | None] = {}
        for name, column in columns.items():
            if column.until is not None or name in stored:
                continue
            given = values[name]
            if isinstance(given, Stored):
                stored[name] = given
            elif column.group is None:
                stored[name] = pack(given, column)
            else:
                group = {key: each for key, each in columns.items() if each.group == column.group}
                arrays = {key: each for key in group if not isinstance(each := values[key], Stored)}
                stored |= pack_group(arrays, group)
        offsets = {}
        for name, form in stored.items():
            if form is not None and form.is_plain(columns[name]):
                assert form.values is not None
                offsets[name] = self.vector(form.values)
            elif form is not None:
                offsets[f"{name}_packed"] = self._packed(form)
        return offsets

    def _packed(self, form: Stored) -> int:
        fields: dict[str, int | float] = {"count": form.count, "first": form.first, "step": form.step}
        if form.values is not None:
            kind = form.values.dtype.str[1:]
            fields[next(name for name, each in VECTORS.items() if each == kind)] = self.vector(form.values)
        if form.index is not None:
            fields["index8" if form.index.itemsize == 1 else "index16"] = self.vector(form.index)
        if form.origin:
            fields["origin"] = self.vector(np.array(form.origin, "<i4"))
        return _table(self.builder, "Packed", **fields)


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


def _text(file: _File, texts: Sequence[str]) -> dict[str, int]:
    """Every string, one after the other: by symbols, or as it is with a zero byte behind it."""
    octets = [text.encode() for text in texts]
    octets, symbols = ([each + b"\0" for each in octets], []) if file.plain else written(octets)
    start = np.concatenate([[0], np.cumsum([len(each) for each in octets], dtype=np.int64)])
    fields = {
        "strings": _offsets(file.builder, []),
        "text": file.vector(np.frombuffer(b"".join(octets), np.uint8)),
        **file.columns({"text_start": start}, {"text_start": TEXT["text_start"]}),
    }
    if symbols:
        fields["symbols"] = file.vector(np.frombuffer(b"".join(each + b"\0" for each in symbols), np.uint8))
    return fields


def _inputs(file: _File, level: Level) -> int:
    digest = np.frombuffer(hashlib.sha256(level.source.data).digest(), np.uint8)
    path = file.builder.CreateString(level.source.name)
    return _offsets(file.builder, [_table(file.builder, "Input", path=path, sha256=file.vector(digest))])


def _omissions(file: _File, omissions: Sequence[Omission], strings: Strings) -> int:
    return _offsets(
        file.builder,
        [
            _table(
                file.builder, "Omission", section=file.builder.CreateString(each.section),
                reason=file.builder.CreateString(each.reason),
                **file.columns(
                    {"source": np.array(each.source, "<i4"), "name_text": strings.indices(each.names)}, OMISSION
                ),
            )
            for each in omissions
        ],
    )  # fmt: skip


def _passes(builder: flatbuffers.Builder, outcomes: Mapping[str, Outcome]) -> int:
    passes = []
    for name, outcome in outcomes.items():
        fields: dict[str, int] = {"name": builder.CreateString(name), "ran": outcome.columns is not None}
        if outcome.failed:
            fields["failed"] = True
        if outcome.note:
            fields["note"] = builder.CreateString(outcome.note)
        passes.append(_table(builder, "Pass", **fields))
    return _offsets(builder, passes)


def _world(file: _File, level: Level) -> int:
    header = level.header
    fields: dict[str, int | float] = {"version": header.version}
    for name, values in header.values.items():
        fields[name] = file.vector(values) if len(values) > 1 else float(values[0])
    return _table(file.builder, "World", **fields)
