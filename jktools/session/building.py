"""A build over many levels: one that fails never loses the others."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from jktools.compiler import CompileSettings
from jktools.model.resources import Library
from jktools.session.compiling import Built, build_one
from jktools.session.jobs import Start, built_in_processes
from jktools.session.members import members_of
from jktools.session.progress import Progress, silent
from jktools.session.settings import Settings
from jktools.session.targets import targets


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
        start = Start(tuple(paths), settings, compiling)
        built.add(built_in_processes(start, members, places, jobs, progress))
        return built
    for done, (member, target) in enumerate(zip(members, places, strict=True)):

        def at_pass(name: str, done: int = done, path: str = member.path) -> None:
            progress(done, len(members), f"{path}: {name}")

        progress(done, len(members), member.path)
        built.add(build_one(member, target, settings, library, compiling, at_pass))
    return built
