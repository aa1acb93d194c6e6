"""A lint run over many files: one that fails never loses the others' results."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from jktools.diagnostics import Diagnostic
from jktools.facts import AssetFacts
from jktools.facts.script import script_facts
from jktools.linter import Selection, lint, select
from jktools.linter.rule import Document, Facts, facts_of
from jktools.model import Level
from jktools.model.resources import Library
from jktools.session.bugs import file_failed
from jktools.session.ignores import unused_ignores, with_settings
from jktools.session.levels import LEVELS, SCRIPT_EXTENSION, read_level, read_member_asset
from jktools.session.members import identity_of, members_of
from jktools.session.progress import Progress, silent
from jktools.session.scripts import bound_scripts, vocabulary_of
from jktools.session.settings import Settings
from jktools.session.usage import MISPLACED_FILE, UNUSED_FILE, KindCount, Usage, added
from jktools.source import InputError, Member
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.reading import ASSET_EXTENSIONS


@dataclass
class Batch:
    """What a lint run found."""

    diagnostics: list[Diagnostic] = field(default_factory=list)
    """In the one order of every output."""
    read: list[str] = field(default_factory=list)
    """The paths of the levels, scripts and assets that were read."""
    problems: list[str] = field(default_factory=list)
    """Paths that could not be read, one sentence each."""
    stats: list[KindCount] = field(default_factory=list)
    """Files that are named, found, missing and unused, when they were asked for."""

    def joined(self, other: Batch) -> Batch:
        """This batch and another as one, in order."""
        found = sorted([*self.diagnostics, *other.diagnostics], key=lambda d: d.sort_key)
        read, problems = [*self.read, *other.read], [*self.problems, *other.problems]
        return Batch(found, read, problems, added(self.stats, other.stats))

    @property
    def files(self) -> int:
        """How many were read."""
        return len(self.read)

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self.diagnostics)

    def __len__(self) -> int:
        return len(self.diagnostics)


def check(
    paths: Sequence[str], settings: Settings | None = None, progress: Progress = silent, *, stats: bool = False
) -> Batch:
    """Lint every level, script and asset that the paths name, and the scripts that those levels bind, each once.

    A path that cannot be read is told in `Batch.problems`, and the rest is linted all the same; `stats` fills
    `Batch.stats`. Raises UnknownRuleError when the settings name a rule that does not exist, InputError when a base
    cannot be opened.
    """
    settings = settings or Settings()
    rules = select(Selection(settings.select, settings.ignore))
    library = Library(settings.base)
    batch = Batch()
    members = members_of(paths, batch.problems, (*LEVELS, SCRIPT_EXTENSION, *sorted(ASSET_EXTENSIONS)))
    known = {identity_of(member) for member in members}
    usage = Usage() if stats or any(r.code in (UNUSED_FILE, MISPLACED_FILE) for r in rules) else None
    used: set[int] = set()
    for done, member in enumerate(members):  # grows by the scripts that levels bind
        progress(done, len(members), member.path)
        try:
            script = (
                script_facts(library, member, vocabulary_of(member, settings))
                if member.extension == SCRIPT_EXTENSION
                else None
            )
            document = _read(member, settings, library) if script is None else script.script
            bound = (
                [m for m in bound_scripts(document) if identity_of(m) not in known]
                if isinstance(document, Level)
                else []
            )
        except InputError as error:
            batch.problems.append(str(error))
            continue
        except Exception as error:
            batch.diagnostics.append(file_failed(member, error))
            continue
        members += bound
        known.update(map(identity_of, bound))
        batch.read.append(member.path)
        resources = document.resources if isinstance(document, Level) else library.resources_of(member)
        facts: Facts
        if script is not None:
            facts = script
        elif isinstance(document, Asset):
            facts = AssetFacts(document, resources)
        else:
            facts = facts_of(document, settings.verbs)
        if usage is not None:
            usage.add(document, resources)
        found = lint(document, rules, facts, settings.options)
        batch.diagnostics += with_settings(found, settings, used)
    if usage is not None:
        chosen = {r.code for r in rules}
        batch.diagnostics += with_settings([d for d in usage.findings() if d.code in chosen], settings, used)
        batch.stats = usage.counts()
    batch.diagnostics += unused_ignores(settings, used, batch.read, [r.code.id for r in rules])
    batch.diagnostics.sort(key=lambda d: d.sort_key)
    return batch


def _read(member: Member, settings: Settings, library: Library) -> Document:
    if member.extension in ASSET_EXTENSIONS:
        return read_member_asset(member, settings)
    return read_level(member, settings, library)
