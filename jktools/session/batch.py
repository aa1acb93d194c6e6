"""Runs over many files: one that fails never loses the others' results."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, field, replace
from multiprocessing.context import SpawnContext
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

from jktools.compiler import CompileError, CompileSettings, PassError, compilation
from jktools.diagnostics import Diagnostic, Label
from jktools.facts import AssetFacts
from jktools.facts.script import script_facts
from jktools.linter import Selection, lint, select
from jktools.linter.rule import FILE_FAILED, Document, Facts, facts_of
from jktools.model import Level
from jktools.model.resources import Library
from jktools.session.ignores import unused_ignores, with_settings
from jktools.session.levels import LEVELS, SCRIPT_EXTENSION, discover, read_level, read_member_asset
from jktools.session.scripts import bound_scripts, vocabulary_of
from jktools.session.settings import Settings
from jktools.session.targets import targets
from jktools.session.usage import MISPLACED_FILE, UNUSED_FILE, KindCount, Usage, added
from jktools.session.write import write_atomically
from jktools.source import InputError, Member, Source
from jktools.source.container import PACK_SEPARATOR
from jktools.source.filenames import fault_of
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.reading import ASSET_EXTENSIONS

TRACEBACK_VARIABLE = "JKTOOLS_TRACEBACK"
"""Set in the environment, a bug shows its traceback and ends the run."""

Progress = Callable[[int, int, str], None]
"""Told before each file: how many are done, how many there are, and its path."""


def silent(done: int, total: int, path: str) -> None:
    """Show no progress."""


@dataclass
class Batch:
    """What a lint run found."""

    diagnostics: list[Diagnostic] = field(default_factory=list)
    """In the one order of every output."""
    read: list[str] = field(default_factory=list)
    """The paths of the levels, scripts and assets that were read."""
    problems: list[str] = field(default_factory=list)
    """Paths that could not be read, one sentence each."""
    stats: list[KindCount] = field(default_factory=list)
    """Files that are named, found, missing and unused, when they were asked for."""

    def joined(self, other: Batch) -> Batch:
        """This batch and another as one, in order."""
        found = sorted([*self.diagnostics, *other.diagnostics], key=lambda d: d.sort_key)
        read, problems = [*self.read, *other.read], [*self.problems, *other.problems]
        return Batch(found, read, problems, added(self.stats, other.stats))

    @property
    def files(self) -> int:
        """How many were read."""
        return len(self.read)

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self.diagnostics)

    def __len__(self) -> int:
        return len(self.diagnostics)


def check(
    paths: Sequence[str], settings: Settings | None = None, progress: Progress = silent, *, stats: bool = False
) -> Batch:
    """Lint every level, script and asset that the paths name, and the scripts that those levels bind, each once.

    A path that cannot be read is told in `Batch.problems`, and the rest is linted all the same; `stats` fills
    `Batch.stats`. Raises UnknownRuleError when the settings name a rule that does not exist, InputError when a base
    cannot be opened.
    """
    settings = settings or Settings()
    rules = select(Selection(settings.select, settings.ignore))
    library = Library(settings.base)
    batch = Batch()
    members = members_of(paths, batch.problems, (*LEVELS, SCRIPT_EXTENSION, *sorted(ASSET_EXTENSIONS)))
    known = {_identity(member) for member in members}
    usage = Usage() if stats or any(r.code in (UNUSED_FILE, MISPLACED_FILE) for r in rules) else None
    used: set[int] = set()
    for done, member in enumerate(members):  # grows by the scripts that levels bind
        progress(done, len(members), member.path)
        try:
            script = (
                script_facts(library, member, vocabulary_of(member, settings))
                if member.extension == SCRIPT_EXTENSION
                else None
            )
            document = _read(member, settings, library) if script is None else script.script
            bound = (
                [m for m in bound_scripts(document) if _identity(m) not in known] if isinstance(document, Level) else []
            )
        except InputError as error:
            batch.problems.append(str(error))
            continue
        except Exception as error:
            batch.diagnostics.append(_failed(member, error))
            continue
        members += bound
        known.update(map(_identity, bound))
        batch.read.append(member.path)
        resources = document.resources if isinstance(document, Level) else library.resources_of(member)
        facts: Facts
        if script is not None:
            facts = script
        elif isinstance(document, Asset):
            facts = AssetFacts(document, resources)
        else:
            facts = facts_of(document, settings.verbs)
        if usage is not None:
            usage.add(document, resources)
        found = lint(document, rules, facts, settings.options)
        batch.diagnostics += with_settings(found, settings, used)
    if usage is not None:
        chosen = {r.code for r in rules}
        batch.diagnostics += with_settings([d for d in usage.findings() if d.code in chosen], settings, used)
        batch.stats = usage.counts()
    batch.diagnostics += unused_ignores(settings, used, batch.read, [r.code.id for r in rules])
    batch.diagnostics.sort(key=lambda d: d.sort_key)
    return batch


def _read(member: Member, settings: Settings, library: Library) -> Document:
    if member.extension in ASSET_EXTENSIONS:
        return read_member_asset(member, settings)
    return read_level(member, settings, library)


def _failed(member: Member, error: Exception) -> Diagnostic:
    """A bug in jktools that one file brought to light."""
    if os.environ.get(TRACEBACK_VARIABLE):
        raise error
    return Diagnostic(
        FILE_FAILED, FILE_FAILED.severity, Label(Source(member.path, b"")),
        f"jktools failed on this file: {type(error).__name__}: {error}",
        f"this is a bug in jktools; please report it with the file ({TRACEBACK_VARIABLE}=1 shows where)",
    )  # fmt: skip


def members_of(paths: Sequence[str], problems: list[str], extensions: Collection[str] = LEVELS) -> list[Member]:
    """The levels, or what else has one of the extensions, of all paths, each once."""
    members: dict[str, Member] = {}
    for path in paths:
        try:
            for member in discover(path, problems, extensions):
                members.setdefault(_identity(member), member)
        except InputError as error:
            problems.append(str(error))
    return list(members.values())


def _identity(member: Member) -> str:
    """One name for a file, however the paths to it were typed."""
    outer, separator, inner = member.path.partition(PACK_SEPARATOR)
    return str(member.place.resolve()) if member.place else f"{Path(outer).resolve()}{separator}{inner}"


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


def build_all(
    paths: Sequence[str],
    out: Path,
    settings: Settings | None = None,
    progress: Progress = silent,
    compiling: CompileSettings | None = None,
    jobs: int = 1,
) -> Built:
    """Compile every level that the paths name into files below `out`, or into `out` itself when it names a .jklb.

    What cannot be read, compiled or written is told, and the rest is built. `jobs` levels are compiled at a time, each
    in a process of its own (0: one a core); files and messages do not depend on how many. Raises InputError when `out`
    cannot hold the levels or a base cannot be opened.
    """
    settings = settings or Settings()
    built = Built()
    library = Library(settings.base)
    members = members_of(paths, built.problems)
    places = targets(members, out)
    jobs = min(jobs or os.cpu_count() or 1, len(members))
    if jobs > 1:
        return _built_in_processes(built, paths, members, places, settings, progress, compiling, jobs)
    for done, (member, target) in enumerate(zip(members, places, strict=True)):

        def at_pass(name: str, done: int = done, path: str = member.path) -> None:
            progress(done, len(members), f"{path}: {name}")

        progress(done, len(members), member.path)
        built.add(_build_one(member, target, settings, library, compiling, at_pass))
    return built


def _build_one(
    member: Member,
    target: Path,
    settings: Settings,
    library: Library,
    compiling: CompileSettings | None,
    at_pass: Callable[[str], None],
) -> Built:
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
        built.bugs.append(_bug(error))
    except Exception as error:
        built.bugs.append(f"{member.path}: {_failed(member, error).message}")
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


class _Worker:
    """What a process that compiles levels keeps from one to the next."""

    def __init__(self, paths: Sequence[str], settings: Settings, compiling: CompileSettings | None) -> None:
        self.members = members_of(paths, [])
        self.settings, self.compiling = settings, compiling
        self.library = Library(settings.base)

    def build(self, number: int, target: Path) -> Built:
        member = self.members[number]
        return _build_one(member, target, self.settings, self.library, self.compiling, lambda _: None)


_worker: list[_Worker] = []


def _start_worker(paths: Sequence[str], settings: Settings, compiling: CompileSettings | None) -> None:
    _worker[:] = [_Worker(paths, settings, compiling)]


def _work(number: int, target: Path) -> Built:
    return _worker[0].build(number, target)


def _built_in_processes(
    built: Built,
    paths: Sequence[str],
    members: Sequence[Member],
    places: Sequence[Path],
    settings: Settings,
    progress: Progress,
    compiling: CompileSettings | None,
    jobs: int,
) -> Built:
    # Spawned, not forked: a fork would copy locks that native threads may hold.
    context = multiprocessing.get_context("spawn")
    # What a build reads of the settings, in mappings that can be sent to another process.
    plain = replace(settings, severity={}, options={}, ignores=(), verbs=dict(settings.verbs))
    start = (tuple(paths), plain, compiling)
    with ProcessPoolExecutor(jobs, context, _start_worker, start) as pool:
        waiting = [pool.submit(_work, number, target) for number, target in enumerate(places)]
        for done, (member, each) in enumerate(zip(members, waiting, strict=True)):
            progress(done, len(members), member.path)
            try:
                built.add(each.result())
            except BrokenProcessPool:
                built.add(_built_alone(done, member, places[done], context, start))
    return built


def _built_alone(
    number: int,
    member: Member,
    target: Path,
    context: SpawnContext,
    start: tuple[tuple[str, ...], Settings, CompileSettings | None],
) -> Built:
    """Compile a level in a process of its own, after one that ended took all that were waiting with it."""
    with ProcessPoolExecutor(1, context, _start_worker, start) as pool:
        try:
            return pool.submit(_work, number, target).result()
        except BrokenProcessPool:
            return Built(bugs=[f"{member.path}: the process that compiles it ended; try --jobs 1"])


def _bug(error: PassError) -> str:
    if os.environ.get(TRACEBACK_VARIABLE):
        raise error
    return f"{error}; the rest compiles with --keep-going, and {TRACEBACK_VARIABLE}=1 shows where it failed"
