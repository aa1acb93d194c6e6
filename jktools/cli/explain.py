"""`jktools explain`."""

from __future__ import annotations

import click

from jktools.linter import UnknownRuleError, find_rule
from jktools.linter.rule import options_of


@click.command("explain")
@click.argument("code", metavar="CODE")
def command(code: str) -> int:
    """Show the documentation of a rule, by its code (JK201) or name."""
    try:
        rule = find_rule(code)
    except UnknownRuleError as error:
        raise click.UsageError(str(error)) from error
    click.echo(f"{rule.code.id} {rule.code.name} ({rule.code.severity}, since {rule.since})\n\n{rule.docs}")
    for option in options_of(rule):
        click.echo(f"\n{option.name} = {option.default}: {option.description}")
    return 0
