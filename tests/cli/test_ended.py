"""Runs that are ended from outside: no traceback, no process left behind, no half-written file."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from jktools.session.jobs import Start, _Worker
from jktools.session.settings import Settings
from jktools.session.write import write_parts
from tests.support.levels import TWO_ROOMS

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")

LEVELS = 120
"""Far more than are compiled while a signal is on its way."""


@contextlib.contextmanager
def started(folder: Path, jobs: int) -> Iterator[subprocess.Popen[bytes]]:
    """A build of many levels that has written one."""
    (folder / "mod").mkdir()
    for number in range(LEVELS):
        (folder / f"mod/{number}.jkl").write_text(TWO_ROOMS)
    run = subprocess.Popen(
        [sys.executable, "-m", "jktools", "build", "mod", "-o", "out", "--jobs", str(jobs)],
        cwd=folder, start_new_session=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    until = time.monotonic() + 60
    try:
        while not list(folder.glob("out/*.jklb")):
            assert run.poll() is None and time.monotonic() < until
            time.sleep(0.01)
        yield run
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(run.pid, signal.SIGKILL)
        run.communicate()


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize(("sent", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.parametrize("to_all", [True, False], ids=["the whole group", "the first process"])
def test_a_build_that_is_ended(tmp_path: Path, jobs: int, sent: signal.Signals, status: int, to_all: bool) -> None:
    with started(tmp_path, jobs) as run:
        (os.killpg if to_all else os.kill)(run.pid, sent)
        _, said = run.communicate(timeout=30)  # until the last process has let go of the pipe
    assert run.returncode == status
    assert said.strip() == b""
    files = [path.name for path in (tmp_path / "out").iterdir()]
    assert len(files) < LEVELS // 2
    assert not [name for name in files if name.startswith(".")]


def test_a_process_that_is_told_twice_to_end_tidies_up_between(tmp_path: Path) -> None:
    """Ctrl-C reaches it first, then what the first process sends: the second must not break into the tidying."""
    target = tmp_path / "x.jklb"

    def pieces() -> Iterator[bytes]:
        yield b"half"
        worker.stop(signal.SIGINT, None)

    worker = _Worker(Start((), Settings(), None))
    worker.at_work = True
    unlink = Path.unlink

    def interrupted(path: Path, missing_ok: bool = False) -> None:
        worker.stop(signal.SIGTERM, None)
        unlink(path, missing_ok)

    with pytest.MonkeyPatch.context() as patch, pytest.raises(KeyboardInterrupt):
        patch.setattr(Path, "unlink", interrupted)
        write_parts(target, pieces())
    assert list(tmp_path.iterdir()) == []


def test_processes_end_with_one_that_is_killed(tmp_path: Path) -> None:
    with started(tmp_path, 2) as run:
        run.kill()
        run.communicate(timeout=30)
    assert run.returncode == -signal.SIGKILL


def test_an_end_while_modules_are_imported() -> None:
    code = (
        "import sys, jktools.cli;"
        "sys.meta_path.insert(0, type('', (), {'find_spec': lambda *_: (_ for _ in ()).throw(KeyboardInterrupt)})());"
        "sys.exit(jktools.cli.main(['rules']))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (130, b"")
