"""Linting one document with what belongs to it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from jktools.diagnostics import Diagnostic
from jktools.facts import LevelFacts
from jktools.facts.script import script_facts
from jktools.linter import Options, Rule
from jktools.linter import lint as lint_document
from jktools.linter.rule import Document, facts_of
from jktools.session.scripts import bound_scripts


def lint(
    document: Document, chosen: Sequence[Rule] | None = None, options: Mapping[str, Options] | None = None
) -> list[Diagnostic]:
    """The findings of a level and of the scripts that it binds, or those of a script, sorted.

    Rules are those that are on, unless some are chosen. Scripts are looked for where the level lies; those that are not
    there, such as the game's own, are left out. Raises InputError when one of them cannot be read.
    """
    facts = facts_of(document)
    found = lint_document(document, chosen, facts, options)
    if isinstance(facts, LevelFacts):
        for member in bound_scripts(facts.level):
            script = script_facts(facts.level.resources.library, member, facts.vocabulary)
            found += lint_document(script.script, chosen, script, options)
    return sorted(found, key=lambda d: d.sort_key)
