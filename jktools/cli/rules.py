"""`jktools rules`."""

from __future__ import annotations

import click

from jktools.linter import rules


@click.command("rules")
def command() -> int:
    """List the rules: code, severity, name and what each reports."""
    known = rules()
    width = max(len(r.code.name) for r in known)
    for rule in known:
        click.echo(f"{rule.code.id}  {rule.code.severity!s:<7}  {rule.code.name:<{width}}  {rule.summary}")
    return 0
