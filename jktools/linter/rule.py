"""What a rule is: a function that yields findings, with its identity and its docs."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple, get_args, get_type_hints

import msgspec

from jktools.diagnostics import Code, Diagnostic, Label, Severity, Subject
from jktools.facts import AssetFacts, LevelFacts, ScriptFacts
from jktools.model import Level
from jktools.model.cog.program import Vocabulary
from jktools.model.cog.verbs import Verb
from jktools.syntax.assets.asset import Asset
from jktools.syntax.cog import Script


@dataclass(frozen=True, slots=True)
class Finding:
    """What a rule yields; the runner adds the code, and its severity where the finding has none of its own."""

    label: Label
    message: str
    help: str | None = None
    subject: Subject | None = None
    related: tuple[Label, ...] = ()
    severity: Severity | None = None


RULE_FAILED = Code("JK901", "rule-failed", Severity.ERROR)
FILE_FAILED = Code("JK902", "file-failed", Severity.ERROR)
"""Bugs in jktools, not in the level."""


class Options(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What can be set for one rule in `[rules.<code>]` of the configuration; a rule declares its own subclass.

    Each field has a default and says in `msgspec.Meta` what it is, in which unit and within which bounds: help, docs
    and the check of a configuration come from that one declaration.
    """


Document = Level | Script | Asset
"""What rules look at."""

ANY_DOCUMENT: tuple[type[Document], ...] = (Level, Script, Asset)

Facts = LevelFacts | ScriptFacts | AssetFacts
"""What can be known about it."""

Check = Callable[..., Iterable[Finding | Diagnostic]]
"""`check(document, facts)`, or `check(document, facts, options)` for a rule that has options."""


NO_VERBS: Mapping[str, Verb] = MappingProxyType({})


def facts_of(document: Document, own_verbs: Mapping[str, Verb] = NO_VERBS) -> Facts:
    """Facts of the kind that rules on such a document take; `own_verbs` are those of the user's own build."""
    if isinstance(document, Asset):
        return AssetFacts(document)
    vocabulary = Vocabulary(document.game, own_verbs)
    return ScriptFacts(document, vocabulary) if isinstance(document, Script) else LevelFacts(document, vocabulary)


@dataclass(frozen=True, slots=True)
class Example:
    """A fragment of a level or a script in a rule's docs; tests lay it over a whole one and lint that."""

    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Rule:
    """A check with its code, and since when it exists. Its docs are its function's docstring."""

    code: Code
    since: str
    check: Check
    options: type[Options] | None = None
    on: bool = True
    """Whether it runs unless selected or ignored; what is noisy on real files is off."""
    looks_at: tuple[type[Document], ...] = (Level,)
    """The kinds of documents that it checks."""

    def run(self, document: Document, facts: Facts, options: Options | None = None) -> Iterable[Finding | Diagnostic]:
        """Check a document of a kind that it looks at, with these options or the defaults."""
        if self.options is None:
            return self.check(document, facts)
        return self.check(document, facts, options if options is not None else self.options())

    @property
    def module(self) -> str:
        """Where it is written."""
        return self.check.__module__

    @property
    def docs(self) -> str:
        """The docstring."""
        return inspect.getdoc(self.check) or ""

    @property
    def summary(self) -> str:
        """The first sentence of the docs."""
        return self.docs.partition("\n")[0]

    @property
    def reason(self) -> str:
        """What the docs say below `## Why it matters`, as one line."""
        told = re.search(r"^## Why it matters\n((?:(?!## ).*\n?)*)", self.docs, re.MULTILINE)
        return " ".join(told[1].split()) if told else ""

    @property
    def bad(self) -> list[Example]:
        """Fragments that the rule reports."""
        return list(self._examples("Bad"))

    @property
    def good(self) -> list[Example]:
        """Fragments that it does not."""
        return list(self._examples("Good"))

    def _examples(self, heading: str) -> Iterator[Example]:
        """Indented blocks below `## Bad` or `## Good`."""
        for title, body in re.findall(r"^## (.+)\n((?:(?!## ).*\n?)*)", self.docs, re.MULTILINE):
            if title.strip() == heading:
                for block in re.findall(r"(?:^    .*\n?)+", body, re.MULTILINE):
                    yield Example(tuple(line[4:] for line in block.splitlines()))


def rule(
    code: str,
    name: str,
    *,
    severity: Severity,
    since: str,
    options: type[Options] | None = None,
    on: bool = True,
    looks_at: type[Document] = Level,
) -> Callable[[Check], Rule]:
    """Make a rule of a function `check(level, facts)`, or `check(script, facts)`, that yields findings.

    `looks_at` is the kind of document that it takes: `Level` with `LevelFacts`, `Script` with `ScriptFacts`, or `Asset`
    (or one kind of them) with `AssetFacts`. With
    `options` the function takes an instance of them as its third argument.
    """

    def make(check: Check) -> Rule:
        return Rule(Code(code, name, severity), since, check, options, on, (looks_at,))

    return make


def reading_rule(
    code: Code, *, since: str, looks_at: tuple[type[Document], ...] = (Level,), on: bool = True
) -> Callable[[Callable[[], None]], Rule]:
    """Make a rule of what reading a document tells under a code; the function carries only the docs."""

    def make(documented: Callable[[], None]) -> Rule:
        def check(document: Document, facts: Facts) -> Iterator[Diagnostic]:  # noqa: ARG001
            return (d for d in document.diagnostics if d.code == code)

        check.__doc__, check.__module__ = documented.__doc__, documented.__module__
        return Rule(code, since, check, on=on, looks_at=looks_at)

    return make


class Described(NamedTuple):
    """An option as docs and help show it."""

    name: str
    default: Any
    description: str


def options_of(each: Rule) -> list[Described]:
    """The options of a rule, from its one declaration."""
    if each.options is None:
        return []
    hints = get_type_hints(each.options, include_extras=True)
    return [
        Described(
            f.name, f.default, next(m.description for m in get_args(hints[f.name]) if isinstance(m, msgspec.Meta)) or ""
        )
        for f in msgspec.structs.fields(each.options)
    ]
