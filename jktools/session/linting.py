"""Linting one document with what belongs to it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from jktools.diagnostics import Diagnostic
from jktools.linter import Options, Rule
from jktools.linter import lint as lint_document
from jktools.linter.rule import Document
from jktools.model import Level
from jktools.session.scripts import bound_scripts
from jktools.syntax.cog import read_script


def lint(
    document: Document, chosen: Sequence[Rule] | None = None, options: Mapping[str, Options] | None = None
) -> list[Diagnostic]:
    """The findings of a level and of the scripts that it binds, or those of a script, sorted.

    Rules are those that are on, unless some are chosen. Scripts are looked for where the level lies; those that are not
    there, such as the game's own, are left out. Raises InputError when one of them cannot be read.
    """
    found = lint_document(document, chosen, options=options)
    if isinstance(document, Level):
        for member in bound_scripts(document):
            found += lint_document(read_script(member.read(), document.game), chosen, options=options)
    return sorted(found, key=lambda d: d.sort_key)
