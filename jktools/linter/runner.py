"""Runs rules over one document: a level, a script or an asset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

from jktools.diagnostics import MALFORMED_SUPPRESSION, UNUSED_SUPPRESSION, Diagnostic, Label, Subject
from jktools.diagnostics.suppression import LINES, apply, suppressions
from jktools.linter.registry import UnknownRuleError, find_rule, rules
from jktools.linter.rule import RULE_FAILED, Document, Facts, Options, Rule, facts_of
from jktools.syntax.assets.asset import Asset
from jktools.syntax.cog import Script


def lint(
    document: Document,
    chosen: Sequence[Rule] | None = None,
    facts: Facts | None = None,
    options: Mapping[str, Options] | None = None,
) -> list[Diagnostic]:
    """Run rules (those that are on, when none are chosen) over a level, a script or an asset and sort what they find.

    Of the rules, those run that look at such a document. `options` holds, by code, what differs from a rule's
    defaults. A rule that raises becomes a finding JK901 about jktools itself, and the others still run.
    """
    facts = facts or facts_of(document)
    options = options or {}
    if chosen is None:
        running: Sequence[Rule] = _default(type(document))  # type: ignore[arg-type]  # every class can be hashed
    else:
        running = [r for r in chosen if isinstance(document, r.looks_at)]
    found: list[Diagnostic] = []
    for each in running:
        _run(each, document, facts, options.get(each.code.id) if options else None, found)
    return sorted(_suppressed(document, found, running), key=lambda d: d.sort_key)


@cache
def _default(kind: type[Document]) -> Sequence[Rule]:
    """The rules that are on and look at such documents."""
    return tuple(r for r in rules() if r.on and issubclass(kind, r.looks_at))


def _suppressed(document: Document, found: list[Diagnostic], running: Sequence[Rule]) -> list[Diagnostic]:
    """Hide what the document's comments hide, and tell of comments that do not work; rules choose what is told."""
    if isinstance(document, Asset) and document.is_binary:
        return found
    styles = document.comment_styles if isinstance(document, Script) else (LINES,)
    comments, faults = suppressions(document.source, styles)
    if not comments and not faults:
        return found
    ran = [each.code for each in running]
    for comment in comments:
        for code in comment.codes:
            try:
                find_rule(code)
            except UnknownRuleError as error:
                faults.append(
                    Diagnostic(
                        MALFORMED_SUPPRESSION, MALFORMED_SUPPRESSION.severity, Label(comment.span),
                        str(error), "name a rule by its code or name",
                    )
                )  # fmt: skip
    kept = apply(found, comments, ran)
    by_comments = {UNUSED_SUPPRESSION, MALFORMED_SUPPRESSION}
    return [d for d in (*kept, *faults) if d.code not in by_comments or d.code in ran]


def _run(each: Rule, document: Document, facts: Facts, options: Options | None, found: list[Diagnostic]) -> None:
    """Add what one rule finds, or that it failed."""
    latest: Subject | None = None
    try:
        for finding in each.run(document, facts, options):
            latest = finding.subject
            if isinstance(finding, Diagnostic):
                found.append(finding)
                continue
            found.append(
                Diagnostic(
                    each.code, finding.severity or each.code.severity, finding.label, finding.message, finding.help,
                    finding.subject, finding.related,
                )
            )  # fmt: skip
    except Exception as error:
        after = f" after {latest.kind} {latest.index}" if latest else ""
        found.append(
            Diagnostic(
                RULE_FAILED, RULE_FAILED.severity, Label(document.source),
                f"rule {each.code} ({each.code.name}) failed{after}: {type(error).__name__}: {error}",
                "this is a bug in jktools; please report it with the file",
            )
        )  # fmt: skip
