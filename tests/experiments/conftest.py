"""Compiles smithdev.gob with the command, in a process of its own, and opens what it wrote."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path

import pytest

from fixtures.smithdev.pack import GOB
from jktools.compiler import open_compiled
from tests.experiments.smithdev import Experiment
from tests.experiments.tracing import Run, run_trace

Compile = Callable[..., Experiment]


@pytest.fixture(scope="session")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Compile:
    """Gives the level as `jktools build` writes it, by options such as `"--engine", "openjkdf2"`; each built once."""

    @cache
    def build(*options: str) -> Experiment:
        path = tmp_path_factory.mktemp("smithdev") / "smithdev.jklb"
        command = [Path(sys.executable).parent / "jktools", "build", GOB, "-o", path, "--config", "none", *options]
        subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True, timeout=900)
        return Experiment(path, open_compiled(path, verify=True))

    return build


@pytest.fixture(scope="session")
def smithdev(compiled: Compile) -> Experiment:
    """The level at the default settings."""
    return compiled()


@pytest.fixture
def trace(smithdev: Experiment, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs `jktools trace run` in the compiled level: a script, a start, options."""
    return partial(run_trace, smithdev.path, tmp_path, capsys)
