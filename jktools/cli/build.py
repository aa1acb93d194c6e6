"""`jktools build`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import click

from jktools.cli.app import note, problem
from jktools.cli.configured import configured, overridden
from jktools.cli.options import accuracy_option, common, engine_option
from jktools.cli.progress import progress
from jktools.cli.status import Status
from jktools.compiler import CHOICES, CompileSettings
from jktools.emit.printable import printable, printable_step
from jktools.geometry.mesh import Accuracy
from jktools.session import build_all
from jktools.session.settings import Game

_PASS = click.Choice(CHOICES)


@click.command("build")
@click.argument("paths", nargs=-1, required=True, metavar="PATH...")
@click.option(
    "-o", "--output", "out", type=click.Path(path_type=Path), required=True, metavar="OUT",
    help="A folder, or a .jklb file when there is one level.",
)  # fmt: skip
@click.option(
    "--cut-anyway", is_flag=True,
    help="Leave out templates that nothing is known to reach, though not all COGs are at hand to tell.",
)  # fmt: skip
@click.option(
    "--plain", is_flag=True,
    help="Write every column as a plain vector, for engines that read no packed ones; the files get larger.",
)  # fmt: skip
@click.option("--only", multiple=True, type=_PASS, metavar="PASS", help="Run this pass and those that it needs.")
@click.option("--skip", multiple=True, type=_PASS, metavar="PASS", help="Do not run this pass.")
@click.option("--keep-going", is_flag=True, help="Leave out the section of a pass that fails, and compile the rest.")
@engine_option("Whose word counts: the research document's, or the decompiled engine's.")
@accuracy_option("How true and how slow what is computed is.")
@click.option(
    "--jobs", type=click.IntRange(min=0), default=1, show_default=True, metavar="N",
    help="Levels compiled at a time, each in a process of its own; 0 means one a core.",
)  # fmt: skip
@click.option("-v", "--verbose", is_flag=True, help="Tell the seconds that each pass took, by level and in all.")
@click.option("-q", "--quiet", is_flag=True, help="Do not list what was written.")
@common
def command(
    paths: tuple[str, ...],
    out: Path,
    cut_anyway: bool,
    plain: bool,
    only: tuple[str, ...],
    skip: tuple[str, ...],
    keep_going: bool,
    engine: str,
    accuracy: Accuracy,
    jobs: int,
    verbose: bool,
    quiet: bool,
    game: Game | None,
    base: tuple[str, ...],
    config: str | None,
    strict_grammar: bool,
) -> int:
    """Compile every level found to OUT/<name>.jklb.

    A level keeps the templates that it can reach. While a COG that it uses cannot be read, which often lies in the
    game's own files (--base), all of them stay; `jktools inspect` tells.

    Levels of the same name from several packs go to OUT/<pack>/<name>.jklb. A JKL without GEORESOURCE, as
    static.jkl, is skipped with a note. A pass computes one section of the file; `jktools inspect` tells which ran and
    why another did not. What several passes share counts for the first of them.

    Exit status: 0 all written, 1 a level cannot be compiled, 2 bad usage or a PATH that cannot be read, 3 a bug in
    jktools.
    """
    # A level's name in OUT depends on all levels, so one configuration serves them all: that of the first path.
    _, found = next(configured(paths, config))
    settings = overridden(found.settings, game, base, strict_grammar)
    with progress("compiling") as report:
        compiling = CompileSettings(
            engine=engine,
            accuracy=accuracy,
            only=frozenset(only),
            skip=frozenset(skip),
            keep_going=keep_going,
            cut_anyway=cut_anyway,
            plain=plain,
        )
        built = build_all(paths, out, settings, report, compiling, jobs)
    if not quiet:
        for each, times in zip(built.written, built.times, strict=True):
            grid = f", vertices in steps of {printable_step(each.step)} JKU" if each.step else ""
            click.echo(printable(f"{each.level} -> {each.target} ({each.size} bytes{grid})"))
            if verbose:
                click.echo("  " + _seconds(times))
        if verbose and len(built.times) > 1:
            click.echo(f"{len(built.times)} levels: {_seconds(_summed(built.times))}")
    for message in built.skipped:
        note(message)
    for message in (*built.refused, *built.problems, *built.bugs):
        problem(message)
    if built.bugs:
        return Status.BUG
    if built.problems:
        return Status.USAGE
    return Status.FINDINGS if built.refused else Status.CLEAN


def _summed(times: Iterable[Mapping[str, float]]) -> Mapping[str, float]:
    total: dict[str, float] = {}
    for each in times:
        for name, seconds in each.items():
            total[name] = total.get(name, 0.0) + seconds
    return total


def _seconds(times: Mapping[str, float]) -> str:
    steps = ", ".join(f"{name} {seconds:.3f}" for name, seconds in times.items())
    return f"{sum(times.values()):.3f} s: {steps}"
