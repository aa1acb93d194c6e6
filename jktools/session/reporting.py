"""Pages of levels: linted, compiled and drawn."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path

from jktools.compiler import CompiledLevel, CompileError, CompileSettings, PassError, compilation, open_compiled
from jktools.compiler.mapping import is_compiled
from jktools.emit.html import LevelPage, Link, index_page, level_page, link_to
from jktools.facts import LevelFacts
from jktools.facts.hotspots import summarise_costs
from jktools.facts.script import script_facts
from jktools.linter import Rule, Selection, lint, select
from jktools.model import Level
from jktools.model.cog.program import Vocabulary
from jktools.model.resources import Library
from jktools.session.bugs import file_failed
from jktools.session.ignores import with_settings
from jktools.session.levels import LEVEL_EXTENSION, read_level
from jktools.session.members import members_of
from jktools.session.progress import Progress, silent
from jktools.session.scripts import bound_scripts
from jktools.session.settings import Settings
from jktools.session.targets import targets
from jktools.session.write import write_atomically
from jktools.source import InputError

PAGE_SUFFIX = ".html"
INDEX = "index.html"


@dataclass
class Reported:
    """What a run wrote."""

    written: list[tuple[str, Path]] = field(default_factory=list)
    """Level and page."""
    index: Path | None = None
    """The page that leads to them, where there are several."""
    problems: list[str] = field(default_factory=list)
    """Paths that could not be read or written, one sentence each."""
    bugs: list[str] = field(default_factory=list)
    """Files on which jktools itself failed, one sentence each."""


def report_all(
    paths: Sequence[str],
    out: Path,
    settings: Settings | None = None,
    compiling: CompileSettings | None = None,
    progress: Progress = silent,
) -> Reported:
    """Write a page of every level that the paths name into `out`, or below it, and one that leads to them.

    A compiled level that is the only path is drawn as it is. What cannot be read or written is told, and the rest is
    reported all the same; a level that cannot be compiled has a page with its findings. Raises InputError when `out`
    cannot hold the pages or a base cannot be opened, UnknownRuleError when the settings name an unknown rule.
    """
    settings, reported = settings or Settings(), Reported()
    if len(paths) == 1 and is_compiled(paths[0]):
        place = out if out.suffix.lower() == PAGE_SUFFIX else out / f"{Path(paths[0]).stem}{PAGE_SUFFIX}"
        _write(LevelPage(paths[0], open_compiled(paths[0])), place, reported)
        return reported
    rules = select(Selection(settings.select, settings.ignore))
    library = Library(settings.base)
    members = [m for m in members_of(paths, reported.problems) if m.extension == LEVEL_EXTENSION]
    links: list[Link] = []
    for done, (member, place) in enumerate(zip(members, targets(members, out, PAGE_SUFFIX), strict=True)):
        progress(done, len(members), member.path)
        try:
            level = read_level(member, settings, library)
            if level.has_geometry or not level.document.sections:
                page = page_of(level, rules, settings, compiling)
                if _write(page, place, reported):
                    links.append(link_to(page, os.path.relpath(place, out).replace(os.sep, "/")))
        except InputError as error:
            reported.problems.append(str(error))
        except Exception as error:
            reported.bugs.append(f"{member.path}: {file_failed(member, error).message}")
    if len(links) > 1:
        reported.index = out / INDEX
        write_atomically(reported.index, index_page(", ".join(paths), links).encode())
    return reported


def page_of(
    level: Level, rules: Sequence[Rule], settings: Settings, compiling: CompileSettings | None = None
) -> LevelPage:
    """What there is to show of a level: it and the scripts that come with it are linted, then it is compiled."""
    facts = LevelFacts(level, Vocabulary(level.game, settings.verbs))
    found, scripts = lint(level, rules, facts, settings.options), 0
    for member in bound_scripts(level):
        script = script_facts(level.resources.library, member, facts.vocabulary)
        found += lint(script.script, rules, script, settings.options)
        scripts += 1
    found = sorted(with_settings(found, settings, set()), key=lambda d: d.sort_key)
    compiled, fault = None, ""
    try:
        compiled = CompiledLevel(compilation(level, compiling, facts).data, level.path)
    except (CompileError, PassError) as error:
        fault = str(error)
    costs = () if compiled is None else [*chain(*summarise_costs(level.path, facts.hotspots).values())]
    return LevelPage(level.path, compiled, fault, found, costs, scripts)


def _write(page: LevelPage, place: Path, reported: Reported) -> bool:
    try:
        write_atomically(place, level_page(page).encode())
    except InputError as error:
        reported.problems.append(str(error))
        return False
    reported.written.append((page.path, place))
    return True
