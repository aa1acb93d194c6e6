"""`jktools pack`."""

from __future__ import annotations

from pathlib import Path

import click

from jktools.cli.app import problem
from jktools.cli.progress import progress
from jktools.cli.status import Status
from jktools.emit import json as json_format
from jktools.emit.printable import printable
from jktools.session.packs import create, extract, open_container
from jktools.source import Member


@click.group("pack")
def command() -> None:
    """List, extract and create packs.

    PATH is a GOB, GOO, zip or folder, or a pack inside another as mods.zip!mod.gob.
    """


@command.command("list")
@click.argument("path", metavar="PATH")
@click.option("--json", "as_json", is_flag=True, help="The same as JSON.")
def list_files(path: str, as_json: bool) -> int:
    """List the files of a pack with their sizes in bytes, in the pack's order."""
    container = open_container(path)
    if as_json:
        click.echo(json_format.pack(container), nl=False)
        return Status.CLEAN
    for member in container.members:
        click.echo(_line(member))
    total = sum(member.size for member in container.members)
    click.echo(f"{_files(len(container.members))}, {total} bytes")
    return Status.CLEAN


def _line(member: Member) -> str:
    cut = f"  (cut off, should be {member.declared} bytes)" if member.size != member.declared else ""
    return f"{member.size:>10}  {printable(member.name)}{cut}"


@command.command("extract")
@click.argument("path", metavar="PATH")
@click.argument("patterns", nargs=-1, metavar="[NAME]...")
@click.option("-o", "--output", "folder", type=click.Path(path_type=Path), required=True, metavar="FOLDER")
@click.option("-q", "--quiet", is_flag=True, help="Do not say what was written.")
def extract_files(path: str, patterns: tuple[str, ...], folder: Path, quiet: bool) -> int:
    """Write the files of a pack below FOLDER: all, or those that a NAME matches.

    NAME is a file's name or a pattern as 'jkl/*' or '*.mat'; case does not matter, and * crosses folders. Files
    already there are replaced. A name that leads out of FOLDER or that some system cannot hold is refused.

    Exit status: 0 all written, 2 a file was refused or cannot be read.
    """
    with progress("extracting") as report:
        done = extract(path, folder, patterns, report)
    if not quiet:
        total = sum(size for *_, size in done.written)
        click.echo(f"{path} -> {folder} ({_files(len(done.written))}, {total} bytes)")
    for message in done.problems:
        problem(message)
    return Status.USAGE if done.problems else Status.CLEAN


@command.command("create")
@click.argument("out", type=click.Path(path_type=Path), metavar="OUT.gob")
@click.argument("path", metavar="FOLDER|PACK")
@click.option("-q", "--quiet", is_flag=True, help="Do not say what was written.")
def create_pack(out: Path, path: str, quiet: bool) -> int:
    """Write a GOB with all files of a folder or of another pack.

    Files of folders and zips are sorted by name; a GOB keeps its own order and spelling. The same input gives the
    same bytes.
    """
    count, size = create(out, path)
    if not quiet:
        click.echo(f"{path} -> {out} ({_files(count)}, {size} bytes)")
    return Status.CLEAN


def _files(count: int) -> str:
    return f"{count} file" + ("s" if count != 1 else "")
