"""`jktools tradeoff`."""

from __future__ import annotations

import functools
import shutil
import sys
from pathlib import Path

import click

from jktools.cli.app import note, problem
from jktools.cli.options import Number, base_option, engine_option, game_option, need_matplotlib
from jktools.cli.progress import progress
from jktools.cli.status import Status
from jktools.compiler import CHOICES, CompileError, CompileSettings, compile_level
from jktools.emit.printable import printable
from jktools.engine.profile import Engine
from jktools.session import load
from jktools.session.settings import Game
from jktools.session.write import write_atomically
from jktools.tradeoff import PASSES, TIERS, Asked, Plan, measure
from jktools.tradeoff.plot import FORMATS, points_of, to_plot
from jktools.tradeoff.write import WIDTH, to_json, to_table

MOST_QUERIES = 10_000_000


class Several(click.ParamType[tuple[str, ...]]):
    """Words between commas, each one of a few."""

    def __init__(self, choices: tuple[str, ...]) -> None:
        self.choices = choices
        self.name = "several"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, ...]:
        """The words, each once, in the order of the choices."""
        words = value if isinstance(value, tuple) else tuple(word.strip() for word in str(value).split(","))
        for word in words:
            if word not in self.choices:
                self.fail(f"{word!r} is none of {', '.join(self.choices)}", param, ctx)
        return tuple(choice for choice in self.choices if choice in words)


@click.command("tradeoff")
@click.argument("level", metavar="LEVEL")
@click.option(
    "--passes", type=Several(tuple(PASSES)), default=tuple(PASSES), metavar="PASS,...",
    help=f"What to measure. [default: all of {', '.join(PASSES)}]",
)  # fmt: skip
@click.option(
    "--tiers", type=Several(TIERS), default=TIERS, metavar="TIER,...",
    help="At which tiers; errors are known with exact among them. [default: fast, balanced, exact]",
)  # fmt: skip
@click.option(
    "--queries", type=click.IntRange(1, MOST_QUERIES), default=20_000, show_default=True, metavar="N",
    help="Queries of location, sight and drop, each.",
)  # fmt: skip
@click.option(
    "--seed", type=click.IntRange(min=0), default=1997, show_default=True, metavar="N", help="Of the queries."
)
@click.option(
    "--time-limit", type=Number(0, min_open=True), default=60.0, show_default=True, metavar="SECONDS",
    help="What takes longer to make ready, or to answer once, is not measured.",
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="The same as JSON (docs/tradeoff.schema.json).")
@click.option(
    "-o", "--output", type=click.Path(dir_okay=False, path_type=Path), metavar="FILE",
    help="Plot time against error, one panel a pass: a .png or .svg. Needs the extra plot.",
)  # fmt: skip
@engine_option("Whose word counts for ledges, basins and motion; the rest is the same in both.")
@game_option
@base_option
def command(
    level: str,
    passes: tuple[str, ...],
    tiers: tuple[str, ...],
    queries: int,
    seed: int,
    time_limit: float,
    as_json: bool,
    output: Path | None,
    engine: str,
    game: Game | None,
    base: tuple[str, ...],
) -> int:
    """Measure what accuracy costs in LEVEL.

    For each pass and each tier: processor time, memory, bytes in the file, and the error against exact. The tiers
    take turns in one run, so that their times compare; each runs in a process of its own, one at a time. Errors are the
    same at every run.

    Exit status: 0 measured (or said why not), 1 the engine would refuse the level, 2 bad usage or a LEVEL that cannot
    be read, 3 a bug in jktools.
    """
    suffix = "" if output is None else _suffix(output)
    reading = functools.partial(load, level, base, game)
    loaded = reading()
    try:
        compile_level(loaded, CompileSettings(engine, skip=frozenset(CHOICES)))
    except CompileError as error:
        problem(str(error))
        return Status.FINDINGS
    plan = Plan(
        Asked(Engine(engine), queries, seed), passes, tuple(tier for tier in TIERS if tier in tiers), time_limit
    )
    with progress("measuring") as report:
        rows = measure(reading, plan, report)
    if as_json:
        click.echo(to_json(loaded, plan, rows), nl=False)
    else:
        terminal = sys.stdout.isatty()
        width = shutil.get_terminal_size((WIDTH, 24)).columns if terminal else WIDTH
        click.echo("\n".join(map(printable, to_table(loaded, plan, rows, width=width).splitlines())))
    if output is not None and not any(points_of(row) for row in rows):
        note(f"{output} is not written: there is no pass whose time and error are known")
    elif output is not None:
        write_atomically(output, to_plot(rows, loaded.path, suffix))
    bugs = [(row.found.name, cell) for row in rows for cell in row.cells if cell.is_bug]
    for name, cell in bugs:
        problem(f"{loaded.path}: {name} at {cell.tier} failed: {cell.not_measured}")
    return Status.BUG if bugs else Status.CLEAN


def _suffix(output: Path) -> str:
    """The plot's format. Raises before anything is measured."""
    suffix = output.suffix.lower().removeprefix(".")
    if suffix not in FORMATS:
        raise click.BadParameter(f"{output.name} names no format: .png or .svg", param_hint="--output")
    if not output.parent.is_dir():
        raise click.BadParameter(
            f"there is no folder {output.parent} to write {output.name} into", param_hint="--output"
        )
    need_matplotlib()
    return suffix
