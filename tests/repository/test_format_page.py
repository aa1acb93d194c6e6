"""The page on the file format: every field is told, and its examples run."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from jktools.compiler import compile_level
from jktools.compiler.columns import SECTIONS, camel_case
from tests.support.levels import ROOT, TWO_ROOMS, level_of
from tools.format_page import SCHEMA, tables

PAGE = (ROOT / "docs/format.md").read_text()
EXAMPLES = dict(re.findall(r"^```(cpp|python)\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL))


def test_a_field_without_a_doc_comment_is_refused() -> None:
    with pytest.raises(ValueError, match=r"gravity: float; has no doc comment"):
        tables("/// The header.\ntable World {\n  gravity: float;\n}\n")
    with pytest.raises(ValueError, match=r"table World { has no doc comment"):
        tables("table World {\n}\n")


def test_every_field_is_on_the_page() -> None:
    for table in tables(SCHEMA.read_text()).values():
        assert f"\n### {table.name}\n" in PAGE
        part = PAGE.split(f"\n### {table.name}\n")[1].split("\n### ")[0]
        for field in table.fields:
            assert field.name.endswith("_packed") or f"| `{field.name}` |" in part, f"{table.name}.{field.name}"


def test_the_page_says_what_an_absent_column_holds() -> None:
    """A reader that has the page alone fills a column that is neither plain nor packed with 0, or with -1."""
    for section, columns in SECTIONS.items():
        part = PAGE.split(f"\n### {camel_case(section)}\n")[1].split("\n### ")[0]
        rows = dict(re.findall(r"^\| `(\w+)` \| [^|]* \| [^|]* \| ([^|]*) \|", part, re.MULTILINE))
        told = {name for name, counts in rows.items() if counts.endswith("or -1")}
        assert rows.keys() == columns.keys()
        assert told == {name for name, column in columns.items() if column.or_none}, section


def test_the_python_example_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lagoon.jklb").write_bytes(compile_level(level_of(TWO_ROOMS)))
    exec(compile(EXAMPLES["python"], "docs/format.md", "exec"), {})


def test_the_cpp_example_compiles(tmp_path: Path) -> None:
    compiler = shutil.which("c++")
    if compiler is None:
        pytest.skip("there is no C++ compiler at hand")
    source = tmp_path / "example.cpp"
    source.write_text(EXAMPLES["cpp"])
    includes = [ROOT / "runtime", Path(sys.prefix, "include")]
    done = subprocess.run(
        [compiler, "-std=c++17", "-Wall", "-Wextra", "-fsyntax-only", *(f"-I{each}" for each in includes), str(source)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "example.cpp" not in done.stderr
