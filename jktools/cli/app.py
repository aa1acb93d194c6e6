"""The command group: subcommands are imported when they are called."""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from types import FrameType

import click

from jktools import __version__
from jktools.cli.status import Status
from jktools.cli.streams import let_go, tell
from jktools.emit.printable import printable

COMMANDS = {
    "lint": "find what is wrong with levels and scripts",
    "build": "compile levels to binary files",
    "inspect": "show what a compiled level holds",
    "report": "draw levels with their findings as pages",
    "diff": "tell what differs between two levels",
    "cog": "show what COG scripts hold",
    "sight": "explain whether one point of a level sees another",
    "drop": "tell what is straight below a point of a level",
    "tradeoff": "measure what accuracy costs in a level",
    "template": "explain where a template's or thing's values come from",
    "pack": "list, extract and create GOB packs",
    "explain": "show a rule's documentation",
    "rules": "list the rules",
    "trace": "simulate a body, or fit a recorded one",
}


class LazyGroup(click.Group):
    """Imports a subcommand's module when it is called; the list of them needs none."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 (click's signature)
        """Every subcommand, in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Import one subcommand."""
        if cmd_name not in COMMANDS:
            return None
        command: click.Command = importlib.import_module(f"jktools.cli.{cmd_name}").command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """List the subcommands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="jktools", message="%(prog)s %(version)s")
def cli() -> None:
    """Level compiler and static analyser for Jedi Knight and Mysteries of the Sith."""


def problem(message: str) -> None:
    """Tell a problem of the run, as opposed to a finding, on standard error."""
    tell(f"jktools: error: {printable(message)}")


def note(message: str) -> None:
    """Tell something that is no problem, on standard error."""
    tell(f"jktools: note: {printable(message)}")


def run(words: Sequence[str]) -> int:
    """Run a command line and give its exit status; nobody sees a traceback unless they ask for one."""
    from jktools.source import InputError  # noqa: PLC0415 (numpy comes with it; --help needs none)

    try:
        with _terminated_as_by_keyboard():
            return int(cli.main(list(words), prog_name="jktools", standalone_mode=False) or Status.CLEAN)
    except click.UsageError as error:
        try:
            error.show()
        except OSError:
            let_go(sys.stderr)
        return Status.USAGE
    except (click.ClickException, InputError) as error:
        problem(error.message if isinstance(error, click.ClickException) else str(error))
        return Status.USAGE
    except _TerminatedError:
        return Status.TERMINATED
    except (click.Abort, KeyboardInterrupt):
        return Status.INTERRUPTED
    except (BrokenPipeError, SystemExit):  # click makes an exit of a closed pipe
        let_go(sys.stdout)
        return Status.CLOSED_PIPE
    except OSError as error:
        let_go(sys.stdout)
        problem(f"cannot write the output: {(error.strerror or str(error)).lower()}")
        return Status.USAGE
    except Exception as error:
        if os.environ.get("JKTOOLS_TRACEBACK"):
            raise
        problem(f"a bug in jktools: {type(error).__name__}: {error} (JKTOOLS_TRACEBACK=1 shows where)")
        return Status.BUG


class _TerminatedError(BaseException):
    """The system asked for an end: files that are half written go away as on Ctrl-C."""


@contextlib.contextmanager
def _terminated_as_by_keyboard() -> Iterator[None]:
    """Raise on a request to terminate, so that it cleans up; another thread than the main one cannot ask for that."""

    def terminate(_: int, __: FrameType | None) -> None:
        raise _TerminatedError

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
