"""`jktools inspect`."""

from __future__ import annotations

import click

from jktools.compiler import open_compiled
from jktools.emit import compiled


@click.command("inspect")
@click.argument("file", metavar="FILE")
@click.option("--json", "as_json", is_flag=True, help="The same as JSON, with the form of every column.")
@click.option("--columns", is_flag=True, help="Show the form and size of every column.")
@click.option("--verify", is_flag=True, help="Compare the checksum too, which finds every changed byte.")
def command(file: str, as_json: bool, columns: bool, verify: bool) -> int:
    """Show what a compiled level holds: sections, counts, sizes, passes."""
    level = open_compiled(file, verify=verify)
    verified = ["the checksum is that of the file"] if verify else []
    if as_json:
        click.echo(compiled.json(level, verified=verified), nl=False)
    else:
        click.echo("\n".join(compiled.text(level, verified=verified, columns=columns)))
    return 0
