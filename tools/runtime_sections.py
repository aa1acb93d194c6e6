"""The columns of the compiled level for C++, with their range check: runtime/jklb/sections_generated.hpp."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from jktools.compiler.columns import OMISSION, SECTIONS, STRINGS, TEXT, Column, camel_case
from jktools.compiler.reader import FORMAT_MAJOR, FORMAT_MINOR, TEXT_SINCE

TARGET = "runtime/jklb/sections_generated.hpp"
SCHEMA = Path(__file__).resolve().parent.parent / "grammars/level.fbs"
TYPES = {"u1": "std::uint8_t", "i4": "std::int32_t", "u4": "std::uint32_t", "f4": "float", "f8": "double"}
KEYWORDS = ("template",)
HEAD = f"""\
// The sections of a compiled level as columns, and their range check. Made by tools/generate.py from what
// jktools/compiler/columns.py declares, which a test holds to the schema's index_of and or_none; do not edit.
//
// A column that the file's minor version does not have has no rows. grammars/level.fbs says what each column holds.
#pragma once

#include <optional>
#include <string>

#include "columns.hpp"

namespace jklb {{

// Files of this major version are read, of later minor versions what was there before.
inline constexpr unsigned kFormatMajor = {FORMAT_MAJOR}, kFormatMinor = {FORMAT_MINOR};

// The minor version that brought Level.text and the columns of omissions.
inline constexpr unsigned kTextSince = {TEXT_SINCE};
"""


def runtime_sections(into: Path) -> Path:
    """Write the header beneath `into`."""
    tables = {"level": TEXT, "omission": OMISSION, **SECTIONS}
    parts = [HEAD]
    parts += [_struct(name, columns) for name, columns in tables.items()]
    parts.append(_sections())
    parts += [_check(name, columns) for name, columns in tables.items()]
    parts.append(_check_all())
    parts.append("}  // namespace jklb\n")
    target = into / TARGET
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("\n".join(parts))
    return target


def _field(name: str) -> str:
    return f"{name}_" if name in KEYWORDS else name


def _type(section: str) -> str:
    return "Text" if section == "level" else camel_case(section)


def _struct(section: str, declared: Mapping[str, Column]) -> str:
    # Those that count the rows of others are made first.
    columns = dict(sorted(declared.items(), key=lambda item: item[1].rows_of is not None))
    fields = "".join(f"    Column<{TYPES[column.type]}> {_field(name)};\n" for name, column in columns.items())
    made = ",\n          ".join(_made(name, column) for name, column in columns.items())
    minor = " minor" if any(column.since or column.until is not None for column in columns.values()) else ""
    return (
        f"struct {_type(section)} {{\n{fields}\n"
        f"    {_type(section)}() = default;\n"
        f"    {_type(section)}(const jktools::{camel_case(section)}& table, unsigned{minor})\n"
        f"        : {made} {{}}\n}};\n"
    )


def _made(name: str, column: Column) -> str:
    """The initialiser of a column."""
    field = _field(name)
    packed = f"table.{name}_packed()" if f" {name}_packed: Packed;" in SCHEMA.read_text() else "nullptr"
    rows = f"{_field(column.rows_of)}.rows()" if column.rows_of else "0"
    fill = ", -1" if column.or_none else ""
    made = f"column<{TYPES[column.type]}>(table.{field}(), {packed}, {column.width}, {rows}{fill})"
    there = _there(column)
    return f"{field}({made if there is None else f'{there} ? {made} : Column<{TYPES[column.type]}>()'})"


def _there(column: Column) -> str | None:
    """Whether the file's minor version has a column, in C++; None where every one has."""
    tests = [f"minor >= {column.since}"] if column.since else []
    tests += [f"minor <= {column.until}"] if column.until is not None else []
    return " && ".join(tests) or None


def _sections() -> str:
    fields = "".join(f"    std::optional<{_type(name)}> {name};\n" for name in SECTIONS)
    made = "".join(
        f"        if (const auto* table = level.{name}()) {name}.emplace(*table, minor);\n" for name in SECTIONS
    )
    return (
        "// Absent is what the level did not need; resources and geometry never are.\n"
        f"struct Sections {{\n{fields}\n    Sections() = default;\n"
        "    explicit Sections(const jktools::Level& level) {\n"
        f"        const unsigned minor = level.format_minor();\n{made}    }}\n}};\n"
    )


def _check(section: str, columns: Mapping[str, Column]) -> str:
    lines = list(_lines(section, columns))
    body = "\n".join(f"    {line}" for line in lines)
    uses_all = "(all." in body
    timed = "minor" in body
    arguments = ", ".join(
        [
            "Checks& check",
            f"const {_type(section)}& own",
            *(["const Sections& all"] if uses_all else []),
            *(["std::size_t strings"] if "strings, " in body else []),
            *(["unsigned minor"] if timed else []),
        ]
    )
    return f"inline void check_{section}({arguments}) {{\n{body}\n}}\n"


def _lines(section: str, columns: Mapping[str, Column]) -> Iterator[str]:
    for name, column in columns.items():
        field, title = f"own.{_field(name)}", f'"{section}.{name}"'
        calls = [f"check.form({title}, {field});"]
        if column.cuts is not None:
            calls.append(f"check.cuts({title}, {field}, own.{_field(column.cuts)}.rows());")
        if column.rows_of:
            rows = f"own.{_field(column.rows_of)}.rows()" + (" + 1" if column.cuts is not None else "")
            calls.append(f"check.rows({title}, {field}, {rows});")
        if column.index_of:
            least = -1 if column.or_none else 0
            calls.append(f'check.indices({title}, {field}, {least}, {_count(column.index_of)}, "{column.index_of}");')
        there = _there(column)
        if there is None:
            yield from calls
        elif len(calls) == 1:
            yield f"if ({there}) {calls[0]}"
        else:
            yield f"if ({there}) {{"
            yield from (f"    {call}" for call in calls)
            yield "}"


def _count(target: str) -> str:
    """How many there are of what an index names, in C++."""
    if target == STRINGS:
        return "strings"
    owner, _, name = target.rpartition(".")
    if name.endswith("_start"):
        return f"std::max<std::size_t>(own.{_field(name)}.rows(), 1) - 1"
    return f"(all.{owner} ? all.{owner}->{_field(name)}.rows() : 0)" if owner else f"own.{_field(name)}.rows()"


def _check_all() -> str:
    calls = []
    for name, columns in SECTIONS.items():
        body = "\n".join(_lines(name, columns))
        arguments = ["check", f"*all.{name}"]
        arguments += ["all"] if "(all." in body else []
        arguments += ["strings"] if "strings, " in body else []
        arguments += ["minor"] if "minor" in body else []
        calls.append(f"    if (all.{name}) check_{name}({', '.join(arguments)});\n")
    return (
        "// The range check of every section. What it leaves without a fault leads nowhere outside its arrays.\n"
        "inline void check_sections(Checks& check, const Sections& all, std::size_t strings, unsigned minor) {\n"
        f"{''.join(calls)}}}\n"
    )
