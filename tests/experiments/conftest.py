"""Compiles smithdev.gob with the command, in a process of its own, and opens what it wrote."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any

import pytest

from fixtures.smithdev.pack import GOB
from jktools.compiler import open_compiled
from tests.experiments.smithdev import HANDLE, Experiment
from tests.experiments.tracing import Run, run_trace

Compile = Callable[..., Experiment]


CompileFiles = Callable[..., Experiment]


def _build(pack: Path, folder: Path, handles: dict[str, Any], *options: str) -> Experiment:
    path = folder / "smithdev.jklb"
    command = [Path(sys.executable).parent / "jktools", "build", pack, "-o", path, "--config", "none", *options]
    subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True, timeout=900)
    return Experiment(path, open_compiled(path, verify=True), handles)


@pytest.fixture(scope="session")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Compile:
    """Gives the level as `jktools build` writes it, by options such as `"--engine", "openjkdf2"`; each built once."""

    @cache
    def build(*options: str) -> Experiment:
        return _build(GOB, tmp_path_factory.mktemp("smithdev"), HANDLE, *options)

    return build


@pytest.fixture
def compile_files(tmp_path: Path) -> CompileFiles:
    """Does the same to other files that the generator made."""

    def build(files: dict[str, bytes], *options: str) -> Experiment:
        pack = tmp_path / "made.gob"
        pack.write_bytes(files["smithdev.gob"])
        return _build(pack, tmp_path, json.loads(files["handles.json"]), *options)

    return build


@pytest.fixture(scope="session")
def smithdev(compiled: Compile) -> Experiment:
    """The level at the default settings."""
    return compiled()


@pytest.fixture
def trace(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs `jktools trace run` in the level: a script, a start, options."""
    return partial(run_trace, tmp_path, capsys)
