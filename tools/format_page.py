"""`docs/format.md`: the compiled level for those who read it, from the schema and the declaration of its columns."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from jktools.compiler.columns import OMISSION, SECTIONS, STRINGS, TEXT, Column, camel_case
from jktools.compiler.grid import COARSEST_SHORT, FINEST, LIGHT, NORMAL, TEXEL
from jktools.compiler.reader import ALWAYS, FORMAT_MAJOR, FORMAT_MINOR
from jktools.emit.printable import printable_step

ROOT = Path(__file__).resolve().parent.parent
SCHEMA = ROOT / "grammars/level.fbs"
PROSE = ROOT / "tools/format_page.md"
PACKED = "_packed"


@dataclass
class Field:
    """A field of the schema."""

    name: str
    type: str
    doc: str


@dataclass
class Table:
    """A table of the schema."""

    name: str
    doc: str
    fields: list[Field] = field(default_factory=list)


def format_page(into: Path) -> Path:
    """Write the page."""
    target = into / "docs/format.md"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("\n".join(_lines()) + "\n")
    return target


def tables(schema: str) -> dict[str, Table]:
    """The tables of a schema with their doc comments. Raises ValueError for one that has none, or a field without."""
    found: dict[str, Table] = {}
    doc: list[str] = []
    table: Table | None = None
    for line in schema.splitlines():
        words = line.strip()
        if words.startswith("///"):
            doc.append(words.removeprefix("///").strip())
            continue
        begins = re.match(r"table (\w+) {", words)
        holds = re.match(r"(\w+): ([^;]+);", words)
        if (begins or holds) and not doc:
            raise ValueError(f"{words} has no doc comment")
        if begins:
            table = found[begins[1]] = Table(begins[1], " ".join(doc))
        elif holds and table is not None:
            table.fields.append(Field(holds[1], re.sub(r" \(.*\)", "", holds[2]), " ".join(doc)))
        doc = []
    return found


def _lines() -> Iterator[str]:
    known = tables(SCHEMA.read_text())
    yield _prose()
    yield "## Tables\n"
    yield "### Level\n"
    yield from _plain(known["Level"])
    for name in ("Input", "Settings", "Pass", "World"):
        yield from _heading(known[name])
        yield from _plain(known[name])
    yield from _heading(known["Packed"])
    yield from _plain(known["Packed"])
    for name, columns in SECTIONS.items():
        yield from _heading(known[camel_case(name)], "" if name in ALWAYS else " Absent when nothing needs it.")
        yield from _columns(known[camel_case(name)], columns)
    yield from _heading(known["Omission"])
    yield from _plain(Table("", "", [f for f in known["Omission"].fields if f.name not in OMISSION]))
    yield ""
    yield from _columns(known["Omission"], OMISSION)


def _prose() -> str:
    text = PROSE.read_text()
    values = {
        "version": f"{FORMAT_MAJOR}.{FORMAT_MINOR}",
        "finest": printable_step(2.0**FINEST),
        "coarsest": printable_step(2.0**COARSEST_SHORT),
        "widest": f"{2.0**COARSEST_SHORT * (2**16 - 1):.0f}",
        "normal": printable_step(2.0**NORMAL),
        "half_normal": printable_step(2.0**NORMAL / 2),
        "half_texel": printable_step(2.0 ** TEXEL[1] / 2),
        "half_light": printable_step(2.0 ** LIGHT[1] / 2),
    }
    for name, value in values.items():
        text = text.replace("{" + name + "}", value)
    return text


def _heading(table: Table, more: str = "") -> Iterator[str]:
    yield f"\n### {table.name}\n"
    yield f"{table.doc}{more}\n"


def _plain(table: Table) -> Iterator[str]:
    """Fields that are no columns, and columns of the level itself."""
    yield "| field | type | |"
    yield "|---|---|---|"
    for each in table.fields:
        if not each.name.endswith(PACKED) and (table.name != "Level" or each.name not in TEXT):
            yield f"| `{each.name}` | {_type(each.type)} | {each.doc} |"
    if table.name == "Level":
        for each in table.fields:
            if each.name in TEXT:
                yield f"| `{each.name}` | {_type(each.type)} | {each.doc} |"


def _type(kind: str) -> str:
    return kind.replace("[", "\\[").replace("]", "\\]") if kind.startswith("[") else kind


def _columns(table: Table, columns: Mapping[str, Column]) -> Iterator[str]:
    docs = {each.name: each for each in table.fields}
    yield "| column | type | rows | counts | |"
    yield "|---|---|---|---|---|"
    for name, column in columns.items():
        yield (
            f"| `{name}` | {_type(docs[name].type)[2:-2]}{f', {column.width} a row' if column.width > 1 else ''} "
            f"| {_rows(column)} | {_counts(column)} | {_since(column)}{docs[name].doc} |"
        )


def _rows(column: Column) -> str:
    if column.rows_of is None:
        return "its own" if column.cuts is None else "the parts + 1"
    return f"as `{column.rows_of}`" + (" + 1" if column.cuts else "")


def _counts(column: Column) -> str:
    if column.cuts is not None:
        return f"cuts `{column.cuts}`"
    target = "strings" if column.index_of == STRINGS else f"`{column.index_of}`" if column.index_of else ""
    return " ".join([target] * bool(target) + ["or -1"] * column.or_none)


def _since(column: Column) -> str:
    if column.until is not None:
        return f"*{f'{FORMAT_MAJOR}.{column.since} to ' if column.since else 'Up to '}{FORMAT_MAJOR}.{column.until}.* "
    return f"*Since {FORMAT_MAJOR}.{column.since}.* " if column.since else ""
