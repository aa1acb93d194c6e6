"""Measures every pass of a level at every tier: each cell in a process of its own, the tiers in turn."""

from __future__ import annotations

import multiprocessing
import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerContext, SpawnContext
from typing import Any

from jktools.geometry import Accuracy
from jktools.model import Level
from jktools.tradeoff.errors import Error
from jktools.tradeoff.passes import PASSES, TIERS, Asked, Pass, Result
from jktools.tradeoff.worker import Failed, Memory, Nothing, Timed, work

RUNS = 5
"""Measurements of each cell; their median counts."""
EXACT: Accuracy = "exact"

Progress = Callable[[int, int, str], None]
"""Told before each cell: how many are done, how many there are, and its name."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What is to be measured."""

    asked: Asked
    passes: tuple[str, ...] = tuple(PASSES)
    tiers: tuple[Accuracy, ...] = TIERS
    time_limit: float = 60.0
    """Seconds that a cell may take to make ready, and again for its answer."""
    repeat_seconds: float = 10.0
    """Seconds after which a cell is measured no more; it is once in any case."""


@dataclass(slots=True)
class Cell:
    """One pass at one tier."""

    tier: Accuracy
    seconds: list[float] = field(default_factory=list)
    """Processor seconds of each measurement, in their order."""
    memory: Memory | None = None
    bytes: int | None = None
    seconds_at_edges: float | None = None
    error: Error | None = None
    not_measured: str = ""
    """Why there is nothing, or nothing but this."""
    no_error: str = ""
    """Why the error is not known."""
    is_bug: bool = False
    answer: Any = None

    @property
    def median(self) -> float:
        """Processor seconds."""
        return statistics.median(self.seconds)


@dataclass(frozen=True, slots=True)
class Row:
    """One pass at every tier that was asked for."""

    found: Pass
    cells: tuple[Cell, ...]
    nothing: str = ""
    """Why the level does not call for it."""


def measure(load: Callable[[], Level], plan: Plan, progress: Progress = lambda *_: None) -> list[Row]:
    """Measure a level; `load` reads it, in other processes too, so that it must be something that can be sent there.

    A cell that takes longer than the limit, or fails, says so, and the rest is measured.
    """
    chosen = [found for name, found in PASSES.items() if name in plan.passes]
    done, rows = 0, []
    for group in _groups(chosen):
        with _Crew(load, plan) as crew:
            for found in group:
                begun = done

                def report(tier: str, begun: int = begun, found: Pass = found) -> None:
                    at = begun + plan.tiers.index(tier)
                    progress(at, len(chosen) * len(plan.tiers), f"{found.name} {tier}")

                rows.append(crew.row(found, report))
                done += len(plan.tiers)
    return rows


def _groups(chosen: Sequence[Pass]) -> Iterator[list[Pass]]:
    """Passes that share their processes."""
    groups: list[list[Pass]] = []
    for found in chosen:
        if groups and found.after and groups[-1][-1].name == found.after:
            groups[-1].append(found)
        else:
            groups.append([found])
    yield from groups


class _LateError(Exception):
    """Nothing came in time."""


class _EndedError(Exception):
    """The process is gone."""


def _context() -> SpawnContext | ForkServerContext:
    """How processes are made: never as forks of this one, which holds a level and may have native threads.

    Where there is a server to fork from, it imports what all of them need once.
    """
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([work.__module__])
    return context


class _Worker:
    """The process of one tier."""

    def __init__(self, load: Callable[[], Level], plan: Plan, tier: Accuracy) -> None:
        context = _context()
        ours, theirs = context.Pipe()
        self.pipe: Connection = ours
        self.process = context.Process(target=work, args=(theirs, load, plan.asked, tier), daemon=True)
        self.process.start()
        theirs.close()
        self.limit = plan.time_limit
        self.gone = ""
        """Why the process is no more."""

    def ask(self, command: str, name: str = "") -> Any:
        """Tell it something and wait for its answer."""
        try:
            self.pipe.send((command, name))
            if not self.pipe.poll(self.limit):
                self.end(f"takes longer than {self.limit:g} s")
                raise _LateError
            return self.pipe.recv()
        except (EOFError, OSError) as error:
            self.process.join(1)
            self.end(f"its process ended with status {self.process.exitcode}")
            raise _EndedError from error

    def end(self, why: str = "") -> None:
        """Stop it, whatever it does."""
        self.gone = self.gone or why
        self.process.kill()
        self.process.join()
        self.pipe.close()


class _Crew:
    """The processes of the passes that share them, one a tier."""

    def __init__(self, load: Callable[[], Level], plan: Plan) -> None:
        self.plan = plan
        self.workers: dict[Accuracy, _Worker] = {}
        self.load = load

    def __enter__(self) -> _Crew:
        self.workers = {tier: _Worker(self.load, self.plan, tier) for tier in self.plan.tiers}
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self.workers.values():
            if not worker.gone:
                worker.end()

    def row(self, found: Pass, report: Callable[[str], None]) -> Row:
        """Measure one pass."""
        cells = {tier: Cell(tier) for tier in self.plan.tiers}
        spent: dict[Accuracy, float] = {}
        nothing = ""
        for tier, cell in cells.items():
            report(tier)
            began = time.monotonic()
            nothing = self._first(found, cell) or nothing
            spent[tier] = time.monotonic() - began
            if nothing:
                return Row(found, tuple(cells.values()), nothing)
        for turn in range(RUNS):
            for tier in _rotated(self.plan.tiers, turn):
                self._again(cells[tier], turn, spent)
        for cell in cells.values():
            self._finish(cell)
        _compare(found, cells)
        return Row(found, tuple(cells.values()))

    def _first(self, found: Pass, cell: Cell) -> str:
        """Make ready and compute once; gives the reason why there is nothing to do."""
        worker = self.workers[cell.tier]
        if worker.gone:
            cell.not_measured = f"needs {found.after}, which is not measured"
            return ""
        reply = self._reply(cell, "begin", found.name)
        if isinstance(reply, Nothing):
            return reply.reason
        if not cell.not_measured:
            reply = self._reply(cell, "first")
            if isinstance(reply, Timed):
                cell.seconds, cell.memory = [reply.seconds], reply.memory
        return ""

    def _again(self, cell: Cell, turn: int, spent: dict[Accuracy, float]) -> None:
        """Measure again, unless that takes too long; the first computation counts only where it is the only one."""
        if cell.not_measured or spent[cell.tier] + max(cell.seconds) > self.plan.repeat_seconds:
            return
        began = time.monotonic()
        reply = self._reply(cell, "again")
        spent[cell.tier] += time.monotonic() - began
        if isinstance(reply, Timed):
            cell.seconds = [reply.seconds] if turn == 0 else [*cell.seconds, reply.seconds]

    def _finish(self, cell: Cell) -> None:
        if cell.not_measured:
            return
        reply = self._reply(cell, "finish")
        if isinstance(reply, Result):
            cell.answer, cell.bytes, cell.seconds_at_edges = reply

    def _reply(self, cell: Cell, command: str, name: str = "") -> Any:
        worker = self.workers[cell.tier]
        try:
            reply = worker.ask(command, name)
        except (_LateError, _EndedError):
            cell.not_measured = worker.gone
            return None
        if isinstance(reply, Failed):
            cell.not_measured, cell.is_bug = reply.message, reply.is_bug
        return reply


def _rotated(tiers: Sequence[Accuracy], turn: int) -> Sequence[Accuracy]:
    first = turn % len(tiers)
    return [*tiers[first:], *tiers[:first]]


def _compare(found: Pass, cells: Mapping[Accuracy, Cell]) -> None:
    """Set each tier's answer against that of `exact`."""
    true = cells.get(EXACT)
    for cell in cells.values():
        if cell.not_measured or found.compare is None:
            continue
        if true is None:
            cell.no_error = "exact was not asked for"
        elif true.not_measured:
            cell.no_error = "exact is not measured"
        else:
            cell.error = found.compare(cell.answer, true.answer)
    for cell in cells.values():
        cell.answer = None
