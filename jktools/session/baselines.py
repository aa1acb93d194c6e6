"""Baselines on disk: JSON, with paths from the file's own folder."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Literal

import msgspec

from jktools import __version__
from jktools.diagnostics.baseline import Known, compare, known_of
from jktools.emit.json import dump
from jktools.linter import Selection, select
from jktools.session.checking import Batch
from jktools.session.settings import Settings
from jktools.session.write import write_report
from jktools.source import InputError
from jktools.source.container import describe
from jktools.source.path import split_on_disk

VERSION = 1
"""Of the shape of the file; grows when a reader would have to change."""


class _Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    path: str
    code: str
    identity: str
    times: int
    message: str = ""


class _File(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: Literal[1]
    findings: list[_Entry]
    tool: dict[str, str] = {}


def leave_out_known(batch: Batch, path: Path, settings: Settings) -> list[str]:
    """Take out of a run the findings that a baseline holds; what is worth saying of it, a sentence each.

    Raises InputError when the baseline cannot be read.
    """
    entries = _read(path)
    fresh, gone = compare(batch.diagnostics, entries, lambda shown: _from_folder(path, shown))
    hidden = len(batch.diagnostics) - len(fresh)
    batch.diagnostics = fresh
    ran = {rule.code.id for rule in select(Selection(settings.select, settings.ignore))}
    read = {_from_folder(path, shown) for shown in batch.read}
    stale = sum(entry.times for entry in gone if entry.code in ran and entry.path in read)
    told = [f"{_findings(hidden)} in the baseline {path} left out"] if hidden else []
    if stale:
        told.append(f"{_findings(stale)} in the baseline {path} no longer there: --write-baseline {path} drops them")
    return told


def record_known(batch: Batch, path: Path) -> str:
    """Write what a run found as a baseline, and say so. Raises InputError."""
    known = known_of(batch.diagnostics, lambda shown: _from_folder(path, shown))
    report = {
        "version": VERSION,
        "tool": {"name": "jktools", "version": __version__},
        "findings": [entry._asdict() for entry in known],
    }
    write_report(path, dump(report).encode())
    return f"{_findings(sum(entry.times for entry in known))} written to the baseline {path}"


def _findings(count: int) -> str:
    return f"{count} finding{'s' * (count != 1)}"


def _read(path: Path) -> list[Known]:
    try:
        file = msgspec.json.decode(path.read_bytes(), type=_File)
    except OSError as error:
        cure = "; --write-baseline makes one" if isinstance(error, FileNotFoundError) else ""
        raise InputError(f"cannot read the baseline {path}: {describe(error)}{cure}") from error
    except msgspec.DecodeError as error:
        raise InputError(f"cannot read the baseline {path}: {error}; --write-baseline makes a new one") from error
    return [Known(e.path, e.code, e.identity, e.times, e.message) for e in file.findings]


def _from_folder(baseline: Path, shown: str) -> str:
    """The path of a finding from the baseline's folder, so that it holds wherever one runs."""
    outer, inner = split_on_disk(shown)
    place = Path(outer).absolute()
    try:
        named = os.path.relpath(place, baseline.absolute().parent)
    except ValueError:  # another drive
        named = str(place)
    return named.replace(os.sep, "/") + inner
