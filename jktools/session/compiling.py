"""One level read, compiled and written, and what came of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

from jktools.compiler import CompileError, CompileSettings, PassError, compilation
from jktools.model.resources import Library
from jktools.session.bugs import file_failed, pass_failed
from jktools.session.levels import read_level
from jktools.session.settings import Settings
from jktools.session.write import write_atomically
from jktools.source import InputError, Member
from jktools.source.filenames import fault_of


class Written(NamedTuple):
    """A compiled level that was written."""

    level: str
    target: Path
    size: int
    """Bytes."""
    step: float
    """Of the grid that its vertices were moved onto, JKU; 0 where they are as read."""


Times = Mapping[str, float]
"""Seconds by the name of a step."""


@dataclass
class Built:
    """What a build run wrote."""

    written: list[Written] = field(default_factory=list)
    skipped: list[str] = field(default_factory=list)
    """Files that are no levels, one sentence each."""
    refused: list[str] = field(default_factory=list)
    """Levels that cannot be compiled, one sentence each."""
    problems: list[str] = field(default_factory=list)
    """Paths that could not be read or written, one sentence each."""
    bugs: list[str] = field(default_factory=list)
    """Files on which jktools itself failed, one sentence each."""
    times: list[Times] = field(default_factory=list, compare=False)
    """For each level written, the seconds by step: `read`, the passes in their order, `write`."""

    def add(self, other: Built) -> None:
        """Take in what another run brought, after this one's."""
        self.written += other.written
        self.times += other.times
        self.skipped += other.skipped
        self.refused += other.refused
        self.problems += other.problems
        self.bugs += other.bugs


def build_one(
    member: Member,
    target: Path,
    settings: Settings,
    library: Library,
    compiling: CompileSettings | None,
    at_pass: Callable[[str], None],
) -> Built:
    """Compile one level into one file. What goes wrong is told in what is given back, and nothing is raised."""
    built = Built()
    watch = _Stopwatch("read")
    try:
        level = read_level(member, settings, library)
        if level.document.sections and not level.has_geometry:
            built.skipped.append(f"{member.path}: skipped, it has no GEORESOURCE (resources and templates only)")
            return built
        fault = fault_of(target.name)
        if fault:
            raise InputError(f"cannot write {target}: {fault}")

        def at_step(name: str) -> None:
            watch.turn(name)
            at_pass(name)

        compiled = compilation(level, compiling, progress=at_step)
        write_atomically(target, compiled.data)
        built.times.append(watch.stop())
        built.written.append(Written(member.path, target, len(compiled.data), compiled.step))
        built.bugs += compiled.failures
    except InputError as error:
        built.problems.append(str(error))
    except CompileError as error:
        built.refused.append(str(error))
    except PassError as error:
        built.bugs.append(pass_failed(error))
    except Exception as error:
        built.bugs.append(f"{member.path}: {file_failed(member, error).message}")
    return built


class _Stopwatch:
    """Tells how long each of some steps took, one after the other."""

    def __init__(self, step: str) -> None:
        self.step, self.since = step, perf_counter()
        self.seconds: dict[str, float] = {}

    def turn(self, step: str) -> None:
        """End a step and begin another."""
        now = perf_counter()
        self.seconds[self.step] = self.seconds.get(self.step, 0.0) + now - self.since
        self.step, self.since = step, now

    def stop(self) -> Times:
        self.turn("")
        return self.seconds
