"""`jktools cog`."""

from __future__ import annotations

import click

from jktools.cli.app import note, problem
from jktools.cli.configured import configured
from jktools.cli.options import base_option, game_option
from jktools.cli.status import Status
from jktools.emit import cog as report
from jktools.facts import LevelFacts, ScriptFacts
from jktools.facts.cog.summary import summarise
from jktools.facts.hotspots import summarise_costs
from jktools.model.cog.program import Vocabulary
from jktools.session import discover, game_of, load
from jktools.session.levels import SCRIPT_EXTENSION
from jktools.session.settings import Game
from jktools.source import InputError
from jktools.syntax.cog import read_script

MOST_NAMED = 3
"""Scripts that a note names."""


@click.command("cog")
@click.argument("paths", nargs=-1, required=True, metavar="PATH...")
@click.option("--json", "as_json", is_flag=True, help="The same as JSON; its shape is docs/cog.schema.json.")
@game_option
@click.option("--config", metavar="FILE", default=None, help="The configuration to use, or none for none.")
@click.option("--level", metavar="LEVEL", default=None, help="Tell what tests of sight cost in this level.")
@base_option
def command(
    paths: tuple[str, ...], as_json: bool, game: Game | None, config: str | None, level: str | None,
    base: tuple[str, ...],
) -> int:  # fmt: skip
    """Show what COG scripts hold: symbols, messages and how often they come, calls, verbs.

    PATH is a script, a folder, a GOB, GOO or zip, or what lies in one: pack.gob!cog/x.cog. What is wrong with a script
    is `jktools lint`'s to say; here only whether the engine refuses it, and where, and the exit status is then 1.
    --level adds, for scripts that run in that level, how often each test of sight is made there and what it costs:
    sectors entered and surfaces tested.
    """
    costs = None
    if level is not None:
        loaded = load(level, base, game)
        level_facts = LevelFacts(loaded)
        costs = summarise_costs(loaded.path, level_facts.hotspots)
        unread = [each.name for each in level_facts.reach.unread] if costs else []
        if unread:
            left = len(unread) - MOST_NAMED
            named = ", ".join(unread[:MOST_NAMED]) + f" and {left} more" * (left > 0)
            note(f"{loaded.path}: what these may send is not counted, since they are not at hand (--base): {named}")
    told: list[report.Told] = []
    problems: list[str] = []
    for group, found in configured(paths, config):
        for path in group:
            try:
                members = discover(path, problems, (SCRIPT_EXTENSION,))
            except InputError as error:
                problems.append(str(error))
                continue
            for member in members:
                try:
                    script = read_script(member.read(), game_of(member, game or found.settings.game))
                except InputError as error:
                    problems.append(str(error))
                    continue
                facts = ScriptFacts(script, Vocabulary(script.game, found.settings.verbs))
                told.append((summarise(facts), script.faults))
    if told:
        click.echo(report.as_json(told, costs) if as_json else report.as_text(told, costs), nl=False)
    for message in problems:
        problem(message)
    if problems:
        return Status.USAGE
    return Status.FINDINGS if any(summary.rejected for summary, _ in told) else Status.CLEAN
