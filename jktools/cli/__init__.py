"""The command line: one module a subcommand, each parses, calls and maps to an exit status."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Sequence

from jktools import __version__
from jktools.cli.streams import prepare


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and give its exit status.

    0 clean, 1 findings, 2 bad usage or a path that cannot be read, 3 a bug in jktools; 128 and the number of the
    signal when the run is ended from outside: 130 by Ctrl-C, 141 by a reader that closed the pipe, 143 by a request to
    terminate. `--version` is answered before anything else is imported.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        prepare()
        if words == ["--version"]:
            with contextlib.suppress(OSError):  # which is then met again, and told
                print(f"jktools {__version__}", flush=True)
                return 0
        from jktools.cli.app import run  # noqa: PLC0415 (see above)

        return run(words)
    except KeyboardInterrupt:  # while the modules are imported
        return 130
