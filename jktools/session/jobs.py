"""Levels compiled several at a time, each in a process of its own; no process outlives the run."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import replace
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from types import FrameType
from typing import NamedTuple

from jktools.compiler import CompileSettings
from jktools.model.resources import Library
from jktools.session.compiling import Built, build_one
from jktools.session.members import members_of
from jktools.session.progress import Progress
from jktools.session.settings import Settings
from jktools.source import Member


class Start(NamedTuple):
    """What a process is given once: it finds the same levels under the same numbers."""

    paths: tuple[str, ...]
    settings: Settings
    compiling: CompileSettings | None


def built_in_processes(
    start: Start, members: Sequence[Member], targets: Sequence[Path], jobs: int, progress: Progress
) -> Built:
    """Compile the levels that `start` names, `jobs` at a time, and tell what came of them in their order.

    A process that ends costs its own level only. When this is ended by an exception, as by Ctrl-C, levels that wait
    are given up, and those at work leave no half-written file.
    """
    # What a build reads of the settings, in mappings that can be sent to another process.
    settings = start.settings
    start = start._replace(settings=replace(settings, severity={}, options={}, ignores=(), verbs=dict(settings.verbs)))
    built = Built()
    with _pool(jobs, start) as pool:
        with _signals_held_back():
            waiting = [pool.submit(_work, number, target) for number, target in enumerate(targets)]
        for done, (member, each) in enumerate(zip(members, waiting, strict=True)):
            progress(done, len(members), member.path)
            try:
                built.add(each.result())
            except BrokenProcessPool:
                built.add(_built_alone(done, member, targets[done], start))
    return built


def _built_alone(number: int, member: Member, target: Path, start: Start) -> Built:
    """Compile a level in a process of its own, after one that ended took all that were waiting with it."""
    with _pool(1, start) as pool:
        try:
            with _signals_held_back():
                waiting = pool.submit(_work, number, target)
            return waiting.result()
        except BrokenProcessPool:
            return Built(bugs=[f"{member.path}: the process that compiles it ended; try --jobs 1"])


@contextmanager
def _pool(jobs: int, start: Start) -> Iterator[ProcessPoolExecutor]:
    others = set(multiprocessing.active_children())
    # Spawned, not forked: a fork would copy locks that native threads may hold.
    pool = ProcessPoolExecutor(jobs, multiprocessing.get_context("spawn"), _start_process, start)
    try:
        yield pool
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for process in _children_but(others):
            process.terminate()
        raise
    finally:
        pool.shutdown()


def _children_but(others: set[BaseProcess]) -> set[BaseProcess]:
    return set(multiprocessing.active_children()) - others


@contextmanager
def _signals_held_back() -> Iterator[None]:
    """Let processes start with these signals held back, until they know what to do on them."""
    if sys.platform == "win32":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _ENDING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


_ENDING = (signal.SIGINT, signal.SIGTERM)


class _Worker:
    """What a process that compiles levels keeps from one to the next."""

    def __init__(self, start: Start) -> None:
        self.start = start
        self.members = members_of(start.paths, [])
        self.library = Library(start.settings.base)
        self.at_work = self.stopped = False

    def build(self, number: int, target: Path) -> Built:
        """Compile one level, unless the run has been ended."""
        self.at_work = True
        try:
            if self.stopped:
                return Built()
            return build_one(
                self.members[number], target, self.start.settings, self.library, self.start.compiling, lambda _: None
            )
        finally:
            self.at_work = False

    def stop(self, _: int, __: FrameType | None) -> None:
        """Give up the level at work, and those that are still sent here: a pool hands some out in advance.

        Once: Ctrl-C reaches each process, and then comes the end that the first one sends. What gives up is let tidy.
        """
        if self.stopped:
            return
        self.stopped = True
        if self.at_work:
            raise KeyboardInterrupt


_worker: list[_Worker] = []


def _start_process(paths: tuple[str, ...], settings: Settings, compiling: CompileSettings | None) -> None:
    worker = _Worker(Start(paths, settings, compiling))
    _worker[:] = [worker]
    parent = multiprocessing.parent_process()
    if parent is None:
        return
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()
    for each in _ENDING:
        signal.signal(each, worker.stop)
    if sys.platform != "win32":
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDING)


def _end_with(parent: BaseProcess) -> None:
    """A pool's process would wait for work for ever when the one that hands it out was killed."""
    wait([parent.sentinel])
    os._exit(1)


def _work(number: int, target: Path) -> Built:
    return _worker[0].build(number, target)
