"""`jktools trace`: simulate a body under a script, or fit a recording."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import click

from jktools.cli.options import Number, base_option, engine_option, need_matplotlib
from jktools.compiler import CompiledLevel
from jktools.engine.attachment import Event
from jktools.engine.body import WALKPLAYER, Body
from jktools.engine.integration import Scheme
from jktools.engine.profile import Engine
from jktools.engine.simulation import History
from jktools.model import Level
from jktools.session.opening import open_level
from jktools.session.write import write_report
from jktools.source import InputError
from jktools.source.container import describe as describe_error
from jktools.source.container import describe_bytes
from jktools.trace import fit, recording, script, trace
from jktools.trace.fitting import Fit, FitError, Interval
from jktools.trace.in_level import body_named, start_at, trace_in_level
from jktools.trace.write import rendered, to_csv

T = TypeVar("T")

PARAMETERS = {field.name for field in dataclasses.fields(Body)}


def _verbatim(text: str | None) -> str:
    """A module's page as help: click would otherwise flow its lines together."""
    return "\n\n".join(f"\b\n{paragraph}" for paragraph in (text or "").strip().split("\n\n"))


@click.group("trace")
def command() -> None:
    """Simulate a body under a script of keys, or fit drag and thrust to a recording."""


@command.command("run", epilog=_verbatim(script.__doc__))
@click.argument("path", metavar="SCRIPT", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(dir_okay=False, path_type=Path),
    help="OUT.csv, .m or .png; CSV goes to standard output without it.",
)
@engine_option("The research document's rules, or those of the decompiled engine.")
@click.option(
    "--scheme", type=click.Choice([s.value for s in Scheme]), help="The integrator. [default: the profile's own]"
)
@click.option("--fps", type=Number(min=0, min_open=True), default=50.0, show_default=True, help="Frames a second.")
@click.option("--set", "settings", metavar="NAME=VALUE", multiple=True, help="Change one of the body's parameters.")
@click.option(
    "--level",
    metavar="PATH",
    help="Walk in this level, a source or a compiled one, on its floors and against its walls; needs --at.",
)
@click.option("--at", "place", metavar="THING|x,y,z,sector", help="Where in the level: a thing's number, or a point.")
@click.option(
    "--body", "template", metavar="TEMPLATE", help="Whose body it is: a template of the level, not walkplayer."
)
@base_option
def run_command(
    path: Path,
    output: Path | None,
    engine: str,
    scheme: str | None,
    fps: float,
    settings: tuple[str, ...],
    level: str | None,
    place: str | None,
    template: str | None,
    base: tuple[str, ...],
) -> None:
    """Simulate walkplayer, or the body of another template, under SCRIPT."""
    if output is not None and output.suffix.lower() not in (".csv", ".m", ".png"):
        raise click.BadParameter(f"{output.name} names no format: .csv, .m or .png", param_hint="--output")
    if output is not None and not output.parent.is_dir():
        raise click.BadParameter(
            f"there is no folder {output.parent} to write {output.name} into", param_hint="--output"
        )
    if output is not None and output.suffix.lower() == ".png":
        need_matplotlib()
    if (level is None) != (place is None):
        raise click.UsageError("--level and --at go together")
    if template is not None and level is None:
        raise click.UsageError("--body names a template of --level")
    try:
        text = _read(path, lambda: path.read_text(encoding="utf-8"))
        loaded = None if level is None else open_level(level, base)
        body = WALKPLAYER if loaded is None or template is None else _body_of(loaded, template)
        options = _Options(_changed(body, settings), Engine(engine), Scheme(scheme) if scheme else None, fps)
        history = trace(text, **options._asdict()) if loaded is None else _in_level(text, loaded, place or "", options)
    except ValueError as error:
        raise click.ClickException(f"{path}: {error}") from None
    if output is None:
        click.echo(to_csv(history), nl=False)
    else:
        write_report(output, rendered(history, output.suffix))
    _tell(history)


def _read(path: Path, reading: Callable[[], T]) -> T:
    try:
        return reading()
    except OSError as error:
        raise InputError(f"cannot read {path}: {describe_error(error)}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"cannot read {path}: {describe_bytes(error)}") from error


class _Options(NamedTuple):
    body: Body
    engine: Engine
    scheme: Scheme | None
    fps: float


def _in_level(text: str, level: Level | CompiledLevel, place: str, options: _Options) -> History:
    try:
        start = start_at(level, place)
    except ValueError as error:
        raise click.BadParameter(f"{level.path}: {error}", param_hint="--at") from None
    return trace_in_level(text, level, start, **options._asdict())


def _body_of(level: Level | CompiledLevel, template: str) -> Body:
    try:
        return body_named(level, template)
    except ValueError as error:
        raise click.BadParameter(f"{level.path}: {error}", param_hint="--body") from None


def _changed(body: Body, settings: tuple[str, ...]) -> Body:
    changes: dict[str, Any] = {}
    for setting in settings:
        name, _, value = setting.partition("=")
        if name not in PARAMETERS:
            raise click.BadParameter(f"{name} is none of {', '.join(sorted(PARAMETERS))}", param_hint="--set")
        try:
            changes[name] = int(value, 16) if name == "physflags" else float(value)
            if not math.isfinite(changes[name]):
                raise ValueError
        except ValueError:
            raise click.BadParameter(f"{value!r} is no value for {name}", param_hint="--set") from None
    return dataclasses.replace(body, **changes)


def _tell(history: History) -> None:
    """Incidents and warnings, on standard error: the trace itself may be on standard output."""
    for warning in history.warnings:
        click.echo(f"jktools: note: {warning}", err=True)
    for incident in history.incidents:
        harm = f", {incident.damage:.1f} points of damage" if incident.damage else ""
        verb = "lands" if incident.event is Event.ATTACHES else "leaves the ground"
        click.echo(f"{incident.time:.3f} s: {verb}{harm}", err=True)


@command.command("fit", epilog=_verbatim(recording.__doc__))
@click.argument("log", type=click.Path(path_type=Path))
@click.option("--from", "start", type=float, default=float("-inf"), help="Seconds; earlier rows are left out.")
@click.option("--to", "end", type=float, default=float("inf"), help="Seconds; later rows are left out.")
@click.option("--drag", "known_drag", type=float, help="The drag that the template states: tells integrators apart.")
def fit_command(log: Path, start: float, end: float, known_drag: float | None) -> None:
    """Fit drag, thrust and integrator to LOG."""
    try:
        found = fit(_read(log, lambda: recording.read(log)).between(start, end), known_drag=known_drag)
    except (recording.RecordingError, FitError) as error:
        raise click.ClickException(f"{log}: {error}") from None
    click.echo("\n".join(describe(found)))


def describe(found: Fit) -> list[str]:
    """Lay a fit out as lines of text."""
    lines = [f"{found.frames} frames of motion; intervals are 95 %", ""]
    lines.append(f"{'integrators':<52}{'drag 1/s':>28}{'part of thrust':>28}{'residual':>12}")
    for candidate in found.candidates:
        thrust = _interval(candidate.thrust) if candidate.thrust else "none logged"
        lines.append(
            f"{', '.join(candidate.schemes):<52}{_interval(candidate.drag):>28}{thrust:>28}{candidate.residual:>12.3g}"
        )
    names = ", ".join(scheme for candidate in found.best for scheme in candidate.schemes)
    lines += ["", f"explained best by: {names}"]
    if found.static is not None:
        lines.append(f"static threshold: at least {found.static[0]:.6g}, below {found.static[1]:.6g} JKU/s")
    return lines


def _interval(interval: Interval) -> str:
    return f"{interval.value:.5g} ({interval.low:.5g} .. {interval.high:.5g})"
