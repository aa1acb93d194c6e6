"""Builds the programs of the runtime with the machine's compiler, once a session."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

from tests.support.levels import ROOT

FLATBUFFERS = Path(sys.prefix) / "include"
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror")
PLAIN = ("-O2",)
SANITIZED = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")


def compiler() -> str | None:
    """The machine's C++ compiler: what CXX names, or c++."""
    return shutil.which(os.environ.get("CXX", "c++"))


@cache
def built(source: str, target: Path, options: tuple[str, ...] = PLAIN) -> Path:
    """Compile one source file of the repository into `target`, without a warning."""
    found = compiler()
    assert found
    command = [
        found, "-std=c++17", *WARNINGS, *options, "-I", str(ROOT / "runtime"), "-isystem", str(FLATBUFFERS),
        str(ROOT / source), "-o", str(target),
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return target
