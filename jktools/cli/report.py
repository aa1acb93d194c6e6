"""`jktools report`."""

from __future__ import annotations

from pathlib import Path

import click

from jktools.cli.app import problem
from jktools.cli.configured import configured, overridden
from jktools.cli.options import accuracy_option, common, engine_option
from jktools.cli.progress import progress
from jktools.cli.status import Status
from jktools.compiler import CompileSettings
from jktools.emit.printable import printable
from jktools.geometry.mesh import Accuracy
from jktools.linter import UnknownRuleError
from jktools.session.reporting import report_all
from jktools.session.settings import Game


@click.command("report")
@click.argument("paths", nargs=-1, required=True, metavar="PATH...")
@click.option(
    "-o", "--output", "out", type=click.Path(path_type=Path), required=True, metavar="OUT",
    help="A folder, or an .html file when there is one level.",
)  # fmt: skip
@engine_option("Whose word counts: the research document's, or the decompiled engine's.")
@accuracy_option("How true and how slow what is computed is.")
@common
def command(
    paths: tuple[str, ...],
    out: Path,
    engine: str,
    accuracy: Accuracy,
    game: Game | None,
    base: tuple[str, ...],
    config: str | None,
    strict_grammar: bool,
) -> int:
    """Write a page of every level: seen from above and in space, with findings, ledges, basins and costs.

    A page is one file that needs nothing else and asks the network for nothing. Of several levels each has its own page
    in the folder OUT, and OUT/index.html leads to them. Findings are those of the level and of the scripts that come
    with it; `jktools lint` looks at the pack's other files too. PATH may be one compiled level: no findings.

    Exit status: 0 all written, 2 bad usage or a PATH that cannot be read, 3 a bug in jktools.
    """
    _, found = next(configured(paths, config))
    settings = overridden(found.settings, game, base, strict_grammar)
    try:
        with progress("reporting") as report:
            reported = report_all(paths, out, settings, CompileSettings(engine=engine, accuracy=accuracy), report)
    except UnknownRuleError as error:
        raise click.UsageError(str(error)) from error
    for level, page in reported.written:
        click.echo(printable(f"{level} -> {page}"))
    if reported.index:
        click.echo(printable(f"index -> {reported.index}"))
    for message in (*reported.problems, *reported.bugs):
        problem(message)
    if reported.bugs:
        return Status.BUG
    return Status.USAGE if reported.problems else Status.CLEAN
