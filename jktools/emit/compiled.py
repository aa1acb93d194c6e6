"""What `inspect` says of a compiled level, as text and as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from jktools import __version__
from jktools.compiler import CompiledLevel
from jktools.compiler.columns import SECTIONS
from jktools.compiler.packing import Stored
from jktools.emit.json import dump
from jktools.emit.printable import printable, printable_step

VERSION = 1
"""Of the shape of the JSON; grows when a reader would have to change."""

NAMED = 8
"""Names of left out records in the text."""


def text(
    level: CompiledLevel, *, verified: Sequence[str] = (), columns: bool = False, inputs: bool = False
) -> Iterator[str]:
    """The lines for a terminal; `columns` tells the form of each column, `inputs` every file that it was made from."""
    yield f"{level.path}: compiled level, format {level.format}, {level.data.nbytes} bytes"
    yield f"  written by jktools {level.tool_version} for " + ", ".join(f"{k} {v}" for k, v in level.settings.items())
    path, digest = level.source
    yield f"  from {printable(path)} (sha256 {digest})"
    yield from _inputs(level, whole=inputs)
    yield f"  checksum {level.checksum}"
    for sentence in verified:
        yield f"  {printable(sentence)}"
    step = level.vertex_step
    yield "  vertices: " + (
        f"in steps of {printable_step(step)} JKU, moved by at most {printable_step(step / 2)} on each axis"
        if step
        else "float32, as read"
    )
    yield "  counts: " + ", ".join(f"{count} {kind.replace('_', ' ')}" for kind, count in level.counts.items())
    visible = level.visible_sectors
    if visible is not None and len(visible):
        yield f"  visibility: {visible.sum(axis=1).mean():.1f} of {len(visible)} sectors from a sector, on average"
    yield "  sections:"
    for name, state in level.passes.items():
        section = level.sections.get(name)
        size = f"{section.nbytes:>10} bytes {section.nbytes / level.data.nbytes:6.1%}" if section else _state(state)
        yield f"    {name:<15}{size}" + (f"  ({printable(state['note'])})" if state["note"] else "")
        if section and columns:
            for key, stored in section.stored.items():
                yield f"      {key:<27}{_bytes(stored):>8}  {_form(stored)}"
    for name, octets in rest(level).items():
        yield f"    {name:<15}{octets:>10} bytes {octets / level.data.nbytes:6.1%}"
    for each in level.omissions:
        names = [printable(name) for name in each["name"][:NAMED]]
        more = len(each["name"]) - len(names)
        yield (
            f"  left out of {each['section']}, because {each['reason']}: {' '.join(names)}"
            + (f" and {more} more" if more else "")
        )  # fmt: skip


def _inputs(level: CompiledLevel, *, whole: bool) -> Iterator[str]:
    """The files beside the source; lines of files as sha256sum writes them."""
    others, missing = level.inputs[1:], level.missing_inputs
    if level.files is None:
        return
    if not whole:
        yield f"  and from {_counted(others)}; {len(missing)} more looked for and not found (--inputs)"
        return
    yield f"  and from {_counted(others)}:"
    yield from (f"    {digest}  {printable(path)}" for path, digest in others)
    yield f"  and {len(missing)} more looked for and not found:"
    yield from (f"    {printable(path)}" for path in missing)


def _counted(others: Sequence[object]) -> str:
    return f"{len(others)} other file" + ("" if len(others) == 1 else "s")


def _state(state: Mapping[str, Any]) -> str:
    """In place of a size."""
    return "    failed" if state["failed"] else "   not run"


def rest(level: CompiledLevel) -> dict[str, int]:
    """The bytes that no section has: the strings, and all that is no column."""
    strings = level.text_bytes
    return {
        "strings": strings,
        "other": level.data.nbytes - strings - sum(section.nbytes for section in level.sections.values()),
    }


def json(level: CompiledLevel, *, verified: Sequence[str] = (), fault: str | None = None) -> str:
    """The same as JSON; its shape is docs/inspect.schema.json. `fault` is what verifying found."""
    step = level.vertex_step
    return dump(
        {
            "version": VERSION,
            "tool": {"name": "jktools", "version": __version__},
            "format": level.format,
            "level": {
                "tool_version": level.tool_version,
                "bytes": level.data.nbytes,
                "checksum": level.checksum,
                "inputs": [{"path": path, "sha256": digest} for path, digest in level.inputs],
                "missing_inputs": level.missing_inputs,
            },
            "settings": level.settings,
            "grid": {"step": step, "moved_at_most": step / 2} if step else None,
            "verified": list(verified),
            "fault": fault,
            "sections": {
                name: {
                    "bytes": section.nbytes,
                    "count": len(section.stored),
                    "columns": {key: _column(name, key, stored) for key, stored in section.stored.items()},
                }
                for name, section in level.sections.items()
            },
            "rest": rest(level),
            "counts": level.counts,
            "passes": level.passes,
            "omissions": level.omissions,
        }
    )


def _column(section: str, name: str, stored: Stored) -> dict[str, Any]:
    return {
        "rows": len(stored),
        "width": SECTIONS[section][name].width,
        "bytes": _bytes(stored),
        "form": _form(stored),
    }


def _bytes(stored: Stored) -> int:
    return sum(part.nbytes for part in stored.vectors)


def _form(stored: Stored) -> str:
    """How a column lies in the file, in a few words."""
    if not stored.in_file:
        return f"absent: {len(stored)} times the same"
    if stored.values is None:
        return f"run: {stored.count} from {stored.first}"
    form = stored.values.dtype.name
    if stored.step:
        form += f" steps of {printable_step(stored.step)}"
    if stored.count:
        return f"{form}: one for {stored.count}"
    if stored.index is not None:
        return f"{form}: {len(stored.values)} for {len(stored)}, {stored.index.dtype.name}"
    return f"{form}: {len(stored)}"
