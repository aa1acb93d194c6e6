"""`make demo` is what newcomers run first."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from tests.support.levels import ROOT


def test_the_demonstration_runs_to_its_end(tmp_path: Path) -> None:
    (tmp_path / "fixtures").symlink_to(ROOT / "fixtures")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    ran = subprocess.run(
        [str(ROOT / "fixtures/demo.sh")], cwd=tmp_path, env={**os.environ, "PATH": path}, capture_output=True, text=True
    )
    assert (ran.returncode, "error" in ran.stderr) == (0, False), ran.stderr
    assert (tmp_path / "out/smithdev.jklb").exists() and (tmp_path / "out/smithdev.html").exists()
    assert ran.stdout.rstrip().endswith("with what was found.")
