"""JK410: a parameter that the engine does not know."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.spelling import did_you_mean
from jktools.model import Level
from jktools.model.resolved import Ignored, Reason
from jktools.syntax.template.parameters import PARAMETERS

WITHOUT_CURE = "remove it; docs/parameters.md lists those that there are"

MOST_CURES = 200
"""Different words for which the nearest key is sought; a file with more is no level."""

MOST_TOLD = 1000
"""Findings of one file; how many more there are is told with the last."""

LEAST_START = 3
"""Letters of the only parameter that begins like a short word, as `pup` of `puppet`."""


@rule("JK410", "unknown-parameter", severity=Severity.WARNING, since="0.1.0")
def unknown_parameter(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a parameter of a template or thing whose key the engine does not know.

    ## Why it matters
    The engine passes over it without a word: the flags are not set, the puppet does not move. Mostly the key is
    misspelt, or the `=` behind it is missing.

    ## Bad
        World templates 4
        lamp none type=cog thingflags0x400

    ## Bad
        World templates 4
        guard none type=actor pup=st.pup

    ## Good
        World templates 4
        guard none type=actor puppet=st.pup thingflags=0x400
    """
    cures: dict[tuple[str, str], str] = {}
    unknown = [
        (held.owner, ignored)
        for held in (*level.resolved_templates.entries, *level.resolved_things)
        for ignored in held.ignored
        if ignored.reason is Reason.UNKNOWN
    ]
    for count, (owner, ignored) in enumerate(unknown[:MOST_TOLD], 1):
        word = (ignored.key, ignored.text)
        if len(cures) < MOST_CURES:
            cures.setdefault(word, _cure(ignored))
        left = len(unknown) - count if count == MOST_TOLD else 0
        yield Finding(
            Label(ignored.origin.span),
            f"{owner.title} has {ignored.origin.span.text}, but the engine knows no such parameter"
            + (f"; the file has {left} more of them" if left else ""),
            cures.get(word, WITHOUT_CURE),
            owner.subject,
        )


def _cure(ignored: Ignored) -> str:
    key = ignored.key
    joined = next((known for known in sorted(PARAMETERS, key=len, reverse=True) if key.startswith(known)), None)
    if ignored.text == ignored.origin.span.text and joined is not None and key != joined:
        return f'write "{joined}={ignored.text[len(joined) :]}" if you mean that'
    begun = [known for known in PARAMETERS if len(key) >= LEAST_START and known.startswith(key)]
    if len(begun) == 1:
        return f'did you mean "{begun[0]}"?'
    return did_you_mean(key, PARAMETERS) or WITHOUT_CURE
