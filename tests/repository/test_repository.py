"""The repository itself: what is generated is current, and nothing names a machine."""

from __future__ import annotations

import re
import subprocess
import tomllib
from pathlib import Path

from jktools.linter import find_rule
from tests.support.levels import ROOT
from tools.generate import generate
from tools.rule_pages import PRECISION, count_corpus


def tracked() -> list[Path]:
    done = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    return [ROOT / name for name in done.stdout.split("\n") if name and (ROOT / name).exists()]


def test_generated_files_are_current(tmp_path: Path) -> None:
    made = generate(tmp_path)
    assert made
    for path in made:
        kept = ROOT / path.relative_to(tmp_path)
        assert kept.read_bytes() == path.read_bytes(), f"{kept}: run make generate"


def test_the_counts_over_the_corpus_are_current(corpus: Path, tmp_path: Path) -> None:
    made = count_corpus(tmp_path)
    assert (ROOT / made.relative_to(tmp_path)).read_text() == made.read_text(), "run make counts"


def test_every_rule_that_is_on_is_precise_where_it_was_read() -> None:
    judged = tomllib.loads((ROOT / PRECISION).read_text())
    for code, verdict in judged.items():
        rule = find_rule(code)
        assert verdict["true"] <= verdict["read"]
        assert not rule.on or verdict["true"] >= 0.95 * verdict["read"], code


def test_no_file_names_a_machine() -> None:
    pattern = re.compile(rb"(?<![\w.])/(work|root|home|tmp)/\w")
    assert [str(p) for p in tracked() if pattern.search(p.read_bytes())] == []


def test_rule_pages_hold_no_stray_code() -> None:
    codes = re.findall(
        r'@rule\("(JK\d+)"', "".join(p.read_text() for p in (ROOT / "jktools/linter/rules").rglob("*.py"))
    )
    assert len(codes) == len(set(codes))
