"""The command line: one module a subcommand, each parses, calls and maps to an exit status."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from jktools import __version__


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and give its exit status.

    0 clean, 1 findings, 2 bad usage or a path that cannot be read, 3 a bug in jktools. `--version` is answered
    before anything else is imported.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words == ["--version"]:
        print(f"jktools {__version__}")
        return 0
    from jktools.cli.app import run  # noqa: PLC0415 (see above)

    return run(words)
