"""`jktools lint`."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

import click

from jktools.cli.app import note, problem
from jktools.cli.configured import configured, overridden
from jktools.cli.options import common
from jktools.cli.progress import progress
from jktools.cli.status import Status, fails, of_findings
from jktools.diagnostics import Diagnostic, Severity
from jktools.emit import github, junit, sarif
from jktools.emit import json as json_format
from jktools.emit import text as text_format
from jktools.emit.report import LintReport
from jktools.linter import UnknownRuleError
from jktools.session import Batch, check
from jktools.session.baselines import leave_out_known, record_known
from jktools.session.config import FailOn
from jktools.session.settings import Game
from jktools.session.write import write_report

FORMATS: dict[str, Callable[[LintReport], str]] = {
    "json": json_format.findings,
    "sarif": sarif.findings,
    "github": github.findings,
    "junit": junit.findings,
}
"""All but the text for a terminal, which alone has colours."""


@click.command("lint")
@click.argument("paths", nargs=-1, required=True, metavar="PATH...")
@click.option("--format", "form", type=click.Choice(["text", *FORMATS]), default="text", show_default=True)
@click.option("--output", type=click.Path(dir_okay=False, path_type=Path), help="Write the report to a file.")
@click.option("--select", multiple=True, metavar="CODES", help="Run only these rules: JK201, JK2, a name, or several.")
@click.option("--ignore", multiple=True, metavar="CODES", help="Leave these rules out.")
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning", "info", "never"]),
    default=None,
    help="The least severity that makes the exit status 1. [default: warning]",
)
@click.option(
    "--baseline", type=click.Path(path_type=Path), metavar="FILE",
    help="Leave out the findings that FILE holds.",
)  # fmt: skip
@click.option(
    "--write-baseline", "fresh", type=click.Path(dir_okay=False, path_type=Path), metavar="FILE",
    help="Write what is found to FILE, for --baseline, and report nothing.",
)  # fmt: skip
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
    baseline: Path | None,
    fresh: Path | None,
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
    if fresh and baseline:
        raise click.UsageError("--write-baseline writes all that is found: leave --baseline out")
    whole, failing, notes, status = Batch(), set[Diagnostic](), list[str](), Status.CLEAN
    try:
        with progress("linting") as report:
            for group, found in configured(paths, config):
                settings = overridden(found.settings, game, base, strict_grammar, _split(select), _split(ignore))
                batch = check(group, settings, report, stats=stats)
                known = baseline or found.baseline
                if known and not fresh:
                    notes += leave_out_known(batch, known, settings)
                threshold = _threshold(fail_on or found.fail_on)
                failing.update(d for d in batch.diagnostics if fails(d, threshold))
                status = max(status, of_findings(batch.diagnostics, threshold))
                whole = whole.joined(batch)
    except UnknownRuleError as error:
        raise click.UsageError(str(error)) from error
    if fresh:
        notes.append(record_known(whole, fresh))
    else:
        _write(whole, failing, form, output, color, stats)
    for sentence in notes:
        note(sentence)
    for sentence in whole.problems:
        problem(sentence)
    if fresh and status is Status.FINDINGS:
        status = Status.CLEAN
    return max(status, Status.USAGE if whole.problems else Status.CLEAN)


def _threshold(fail_on: FailOn) -> Severity | None:
    return None if fail_on == "never" else Severity[fail_on.upper()]


def _split(words: tuple[str, ...]) -> tuple[str, ...]:
    """`--select JK2,JK301 --select JK4` as one list."""
    return tuple(part.strip() for word in words for part in word.split(",") if part.strip())


def _write(
    batch: Batch, failing: set[Diagnostic], form: str, output: Path | None, color: str, stats: bool
) -> None:  # fmt: skip
    rows = [(c.kind, c.own, c.base, c.missing, c.unused) for c in batch.stats] if stats else None
    report = LintReport(batch.diagnostics, batch.read, batch.problems, failing, rows)
    if form in FORMATS:
        shown = FORMATS[form](report)
    else:
        shown = text_format.findings(report, colour=output is None and _wants_colour(color))
    if output is None:
        click.echo(shown, nl=False, color=True)
    else:
        write_report(output, shown.encode())


def _wants_colour(color: str) -> bool:
    if color == "auto":
        return sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    return color == "always"
