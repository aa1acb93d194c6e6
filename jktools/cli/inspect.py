"""`jktools inspect`."""

from __future__ import annotations

from collections.abc import Iterator

import click

from jktools.compiler import CompiledLevel, open_compiled
from jktools.emit import json as json_format


@click.command("inspect")
@click.argument("file", metavar="FILE")
@click.option("--json", "as_json", is_flag=True, help="The same as JSON.")
@click.option("--verify", is_flag=True, help="Compare the checksum too, which finds every changed byte.")
def command(file: str, as_json: bool, verify: bool) -> int:
    """Show what a compiled level holds: sections, counts, sizes, passes."""
    level = open_compiled(file, verify=verify)
    if as_json:
        click.echo(json_format.compiled(level), nl=False)
    else:
        click.echo("\n".join(_lines(level, verify)))
    return 0


def _lines(level: CompiledLevel, verify: bool) -> Iterator[str]:
    yield f"{level.path}: compiled level, format {level.format}, {level.data.nbytes} bytes"
    yield f"  written by jktools {level.tool_version} for " + ", ".join(f"{k} {v}" for k, v in level.settings.items())
    for path, digest in level.inputs:
        yield f"  from {path} (sha256 {digest})"
    yield f"  checksum {level.checksum}" + (" (verified)" if verify else "")
    yield "  counts: " + ", ".join(f"{count} {kind.replace('_', ' ')}" for kind, count in level.counts.items())
    visible = level.visible_sectors
    if visible is not None and len(visible):
        yield f"  visibility: {visible.sum(axis=1).mean():.1f} of {len(visible)} sectors from a sector, on average"
    yield "  passes:"
    for name, state in level.passes.items():
        section = level.sections.get(name)
        size = f"{section.nbytes:>10} bytes" if section else "   not run"
        yield f"    {name:<15}{size}" + (f"  ({state['note']})" if state["note"] else "")
    for each in level.omissions:
        yield f"  left out of {each['section']}, because {each['reason']}: {' '.join(each['name'])}"
