"""`jktools lint`."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import click

from jktools.cli.app import common, problem
from jktools.cli.configured import configured, overridden
from jktools.cli.progress import progress
from jktools.cli.status import Status, of_findings
from jktools.diagnostics import Severity
from jktools.emit import json as json_format
from jktools.emit import text as text_format
from jktools.linter import UnknownRuleError
from jktools.session import Batch, check
from jktools.session.config import FailOn
from jktools.session.settings import Game
from jktools.session.write import write_report


@click.command("lint")
@click.argument("paths", nargs=-1, required=True, metavar="PATH...")
@click.option("--format", "form", type=click.Choice(["text", "json"]), default="text", show_default=True)
@click.option("--output", type=click.Path(dir_okay=False, path_type=Path), help="Write the report to a file.")
@click.option("--select", multiple=True, metavar="CODES", help="Run only these rules: JK201, JK2, a name, or several.")
@click.option("--ignore", multiple=True, metavar="CODES", help="Leave these rules out.")
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "info", "never"]),
    default=None,
    help="The least severity that makes the exit status 1. [default: warning]",
)
@click.option("--stats", is_flag=True, help="Count the files that are named: found, missing, unused.")
@click.option("--color", type=click.Choice(["auto", "always", "never"]), default="auto", show_default=True)
@common
def command(
    paths: tuple[str, ...],
    form: str,
    output: Path | None,
    select: tuple[str, ...],
    ignore: tuple[str, ...],
    fail_on: FailOn | None,
    stats: bool,
    color: str,
    game: Game | None,
    base: tuple[str, ...],
    config: str | None,
    strict_grammar: bool,
) -> int:
    """Find what is wrong with levels.

    PATH is a level, a folder, a GOB, GOO or zip, or what lies in one: pack.gob!jkl/x.jkl, site.zip!mods/pack.gob.

    Exit status: 0 clean, 1 findings at or above --fail-on, 2 bad usage or a PATH that cannot be read, 3 a bug in
    jktools.
    """
    whole, status = Batch(), Status.CLEAN
    try:
        with progress("linting") as report:
            for group, found in configured(paths, config):
                settings = overridden(found.settings, game, base, strict_grammar, _split(select), _split(ignore))
                batch = check(group, settings, report, stats=stats)
                status = max(status, of_findings(batch.diagnostics, _threshold(fail_on or found.fail_on)))
                whole = whole.joined(batch)
    except UnknownRuleError as error:
        raise click.UsageError(str(error)) from error
    _write(whole, form, output, color, stats)
    for message in whole.problems:
        problem(message)
    return max(status, Status.USAGE if whole.problems else Status.CLEAN)


def _threshold(fail_on: FailOn) -> Severity | None:
    return None if fail_on == "never" else Severity[fail_on.upper()]


def _split(words: tuple[str, ...]) -> tuple[str, ...]:
    """`--select JK2,JK301 --select JK4` as one list."""
    return tuple(part.strip() for word in words for part in word.split(",") if part.strip())


def _write(batch: Batch, form: str, output: Path | None, color: str, stats: bool) -> None:
    rows = [(c.kind, c.own, c.base, c.missing, c.unused) for c in batch.stats] if stats else None
    if form == "json":
        report = json_format.findings(batch.diagnostics, batch.files, rows)
    else:
        colour = output is None and _wants_colour(color)
        blocks = [*text_format.render(batch.diagnostics, colour=colour)]
        tables = [] if rows is None else [text_format.stats(rows) + "\n"]
        report = "\n".join([*blocks, *tables, text_format.summary(batch.diagnostics, batch.files) + "\n"])
    if output is None:
        click.echo(report, nl=False, color=True)
    else:
        write_report(output, report.encode())


def _wants_colour(color: str) -> bool:
    if color == "auto":
        return sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    return color == "always"
