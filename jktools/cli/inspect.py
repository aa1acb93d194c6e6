"""`jktools inspect`."""

from __future__ import annotations

import click

from jktools.cli.app import problem
from jktools.cli.options import base_option
from jktools.cli.status import Status
from jktools.compiler import open_compiled
from jktools.emit import compiled


@click.command("inspect")
@click.argument("file", metavar="FILE")
@click.option("--json", "as_json", is_flag=True, help="The same as JSON, with the form of every column.")
@click.option("--columns", is_flag=True, help="Show the form and size of every column.")
@click.option("--inputs", is_flag=True, help="List every file that it was compiled from, and the names not found.")
@click.option(
    "--verify", is_flag=True,
    help="Compare the checksum, compile the level again with the settings that the file records, and compare inputs "
    "and contents.",
)  # fmt: skip
@click.option(
    "--source", metavar="PATH",
    help="What --verify compiles: a level, or what it lies in; else it is looked for beside FILE and in the bases.",
)  # fmt: skip
@base_option
def command(
    file: str, as_json: bool, columns: bool, inputs: bool, verify: bool, source: str | None, base: tuple[str, ...]
) -> int:
    """Show what a compiled level holds: sections, counts, sizes, passes.

    --verify needs what the level was compiled with: the same --base, and its source. Without the source it checks what
    follows from the file itself, and says that the rest could not be verified.

    Exit status: 0, 1 when --verify finds a difference or an input that changed, 2 bad usage, a file that cannot be
    read, or a source that is not at hand.
    """
    if (source or base) and not verify:
        raise click.UsageError("--source and --base are for --verify")
    level = open_compiled(file, verify=verify)
    verified, fault = [], None
    if verify:
        from jktools.session.verifying import verify as verified_level  # noqa: PLC0415 (inspect alone compiles nothing)

        verdict = verified_level(level, source, base)
        verified, fault = ["the checksum is that of the file", *verdict.told], verdict.fault
    if as_json:
        click.echo(compiled.json(level, verified=verified, fault=fault), nl=False)
    else:
        click.echo("\n".join(compiled.text(level, verified=verified, columns=columns, inputs=inputs)))
    if not verify:
        return Status.CLEAN
    if fault is not None:
        problem(f"{file} is {'out of date' if verdict.is_stale else 'not what it was compiled from'}: {fault}")
        return Status.FINDINGS
    if not verdict.has_source:
        problem(f"cannot verify {file}: its source {level.source[0]} is not at hand; name it with --source PATH")
        return Status.USAGE
    return Status.CLEAN
