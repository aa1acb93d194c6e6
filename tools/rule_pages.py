"""Pages of the rules, `docs/rules/`, from the rules themselves, their counts over real levels, and what reading showed.

`docs/rules/corpus.toml` holds the counts: `count_corpus` makes it where the corpus is at hand. `docs/precision.toml` is
written by people: how many findings of a rule were read in the level, and how many were true.
"""

from __future__ import annotations

import json
import tomllib
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from jktools.diagnostics.wording import counted
from jktools.linter import Rule, rules
from jktools.linter.rule import ANY_DOCUMENT, options_of
from jktools.session import Settings, check, discover
from jktools.session.levels import SCRIPT_EXTENSION
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.reading import ASSET_EXTENSIONS
from jktools.syntax.cog import Script

ROOT = Path(__file__).resolve().parent.parent
CORPUS = ROOT.parent / "shared" / "corpus"
COUNTS = "docs/rules/corpus.toml"
PRECISION = "docs/precision.toml"
REPORTS = "tests/data/broken"
UNCOUNTED = frozenset({"JK830"})
"""A rule that is off and takes the whole visibility of each level."""


def count_corpus(into: Path) -> Path:
    """Count every rule's findings over the corpus, those that are off included."""
    batch = check([str(CORPUS)], Settings(select=tuple(r.code.id for r in rules() if r.code.id not in UNCOUNTED)))
    levels = len(discover(str(CORPUS)))
    scripts = len(discover(str(CORPUS), extensions=(SCRIPT_EXTENSION,)))
    assets = len(discover(str(CORPUS), extensions=ASSET_EXTENSIONS))
    files: dict[str, set[str]] = defaultdict(set)
    findings: dict[str, int] = defaultdict(int)
    for diagnostic in batch.diagnostics:
        findings[diagnostic.code.id] += 1
        files[diagnostic.code.id].add(diagnostic.path)
    lines = [
        "# Made by `make counts` from the corpus of real mods.",
        f"levels = {levels}",
        f"scripts = {scripts}",
        f"assets = {assets}",
    ]
    counted = (rule.code.id for rule in rules() if rule.code.id not in UNCOUNTED)
    lines += [f"{code} = {{ findings = {findings[code]}, files = {len(files[code])} }}" for code in counted]
    target = into / COUNTS
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("\n".join(lines) + "\n")
    return target


def rule_pages(into: Path) -> list[Path]:
    """Write one page a rule and their index."""
    counts = _table(ROOT / COUNTS)
    precision = _table(ROOT / PRECISION)
    said = _said()
    folder = into / "docs/rules"
    folder.mkdir(parents=True, exist_ok=True)
    made = []
    for rule in rules():
        page = folder / f"{rule.code.id}.md"
        page.write_text("\n".join(_page(rule, counts, precision.get(rule.code.id, {}), said.get(rule.code.id))) + "\n")
        made.append(page)
    index = folder / "README.md"
    index.write_text("\n".join(_index(counts)) + "\n")
    return [*made, index]


_PLACE = {"levels": "level", "scripts": "script"}


def _looked_at(rule: Rule, counts: dict[str, Any]) -> tuple[str, int]:
    """What a rule looks at, in words, and how many of them were counted."""
    levels, scripts, assets = (int(counts.get(kind, 0)) for kind in ("levels", "scripts", "assets"))
    if rule.looks_at == ANY_DOCUMENT:
        return "levels, scripts and asset files", levels + scripts + assets
    if all(issubclass(kind, Asset) for kind in rule.looks_at):
        return "asset files", assets
    return ("scripts", scripts) if rule.looks_at == (Script,) else ("levels", levels)


def _table(path: Path) -> dict[str, Any]:
    return tomllib.loads(path.read_text()) if path.exists() else {}


def _said() -> dict[str, dict[str, Any]]:
    """For each rule, the first finding in the kept reports on `fixtures/broken`."""
    found: dict[str, dict[str, Any]] = {}
    for report in sorted((ROOT / REPORTS).glob("*.json")):
        for finding in json.loads(report.read_text("utf-8"))["diagnostics"]:
            found.setdefault(finding["code"], finding)
    return found


def _index(counts: dict[str, Any]) -> Iterator[str]:
    yield "# Rules"
    yield ""
    yield (
        f"Findings are counted over {counts.get('levels', 0)} real levels, {counts.get('scripts', 0)} real scripts and "
        f"{counts.get('assets', 0)} real asset files; rules that are off run when selected."
    )
    yield ""
    yield (
        "Each page has examples. Those of levels are lines laid over a small level of two rooms: a line replaces the "
        "one with its number or name, `- line` takes one away, and `== cog/door.cog` begins a file beside the level. "
        "What a rule says is shown as of `fixtures/broken`, where each rule has something to find."
    )
    yield ""
    yield "| code | name | severity | findings | in files | reports |"
    yield "|---|---|---|---|---|---|"
    for rule in rules():
        count = counts.get(rule.code.id, {})
        state = str(rule.code.severity) + ("" if rule.on else ", off")
        yield (
            f"| [{rule.code.id}]({rule.code.id}.md) | {rule.code.name} | {state} | {count.get('findings', '')} "
            f"| {count.get('files', '')} | {rule.summary.removeprefix('Report ')} |"
        )


def _page(rule: Rule, counts: dict[str, Any], precision: dict[str, Any], said: dict[str, Any] | None) -> Iterator[str]:
    yield f"# {rule.code.id} {rule.code.name}"
    yield ""
    state = "on" if rule.on else "off unless selected"
    yield f"{str(rule.code.severity).capitalize()}, {state}, since {rule.since}."
    yield ""
    yield rule.docs.rstrip()
    if said:
        yield ""
        yield "## What it says"
        yield f"    {said['severity']}[{rule.code.id}]: {said['message']}"
        yield f"      --> {said['path']}" + (f":{said['line']}:{said['column']}" if said["line"] else "")
        if said["help"]:
            yield f"      = help: {said['help']}"
    options = options_of(rule)
    if options:
        yield ""
        yield "## Options"
        for option in options:
            yield f"- `{option.name} = {option.default}`: {option.description}"
    count = counts.get(rule.code.id)
    kind, files = _looked_at(rule, counts)
    if count:
        yield ""
        yield f"## On real {kind}"
        number = counted(count["findings"], "finding")
        yield f"{number} in {count['files']} of {files} {kind}." if count["findings"] else f"None in {files} {kind}."
    if precision:
        read, true, note = precision["read"], precision["true"], precision.get("note", "").rstrip(".")
        if read:
            yield f"Of {read} read in the {_PLACE.get(kind, 'file')}, {true} {'was' if true == 1 else 'were'} true" + (
                f": {note}." if note else "."
            )
        elif note:
            yield f"{note[0].upper()}{note[1:]}."
