"""The process of one cell: it reads the level, and does what it is told over a pipe."""

from __future__ import annotations

import math
import signal
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any, NamedTuple

from jktools.compiler import CompileError
from jktools.geometry import Accuracy
from jktools.model import Level
from jktools.source import InputError
from jktools.tradeoff import memory
from jktools.tradeoff.passes import PASSES, Asked, NothingToDoError, Run, Scene

LEAST_SECONDS = 0.02
"""Of processor time that one measurement takes at least: what is faster is repeated within it."""
MOST_TIMES = 10_000


class Memory(NamedTuple):
    """Bytes that the whole process held at most, and how many of them came with the computation."""

    peak: int
    added: int


class Timed(NamedTuple):
    """One measurement: processor seconds of one computation."""

    seconds: float
    memory: Memory | None


class Ready(NamedTuple):
    """Done, with nothing to tell."""


class Nothing(NamedTuple):
    """The level calls for nothing of the kind."""

    reason: str


class Failed(NamedTuple):
    """The computation raised."""

    message: str
    is_bug: bool


class _Cell:
    """One pass at one tier."""

    def __init__(self, scene: Scene, name: str) -> None:
        self.scene, self.found = scene, PASSES[name]
        self.run: Run = self.found.begin(scene)
        self.answer: Any = None
        self.times = 1

    def first(self) -> Timed:
        """Compute once, with an eye on memory."""
        held = memory.start()
        seconds = self._once()
        most = memory.peak()
        self.times = min(MOST_TIMES, math.ceil(LEAST_SECONDS / max(seconds, 1e-9)))
        return Timed(seconds, None if held is None or most is None else Memory(most, most - held))

    def again(self) -> Timed:
        """Compute as often as a measurement takes."""
        began = time.process_time()
        for _ in range(self.times):
            self.run()
        return Timed((time.process_time() - began) / self.times, None)

    def _once(self) -> float:
        began = time.process_time()
        self.answer = self.run()
        return time.process_time() - began


def work(pipe: Connection, load: Callable[[], Level], asked: Asked, tier: Accuracy) -> None:
    """Answer what comes over the pipe, until it is closed: begin NAME, first, again, finish."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the process that waits for this one ends it
    scene: Scene | None = None
    cell: _Cell | None = None
    while True:
        try:
            command, name = pipe.recv()
        except EOFError:
            return
        try:
            reply: Any = Ready()
            if command == "begin":
                scene = scene or Scene(load, asked, tier)
                cell = None
                cell = _Cell(scene, name)
            elif cell is not None:
                reply = _done(cell, command)
        except NothingToDoError as error:
            reply = Nothing(str(error))
        except (CompileError, InputError, MemoryError) as error:
            reply = Failed(str(error) or "there is not enough memory", is_bug=False)
        except Exception as error:
            reply = Failed(f"{type(error).__name__}: {error}", is_bug=True)
        try:
            pipe.send(reply)
        except BrokenPipeError:
            return


def _done(cell: _Cell, command: str) -> Any:
    if command == "first":
        return cell.first()
    return cell.again() if command == "again" else cell.found.finish(cell.scene, cell.answer)
