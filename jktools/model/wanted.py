"""What the engine would take in place of a value that it rejects, in words."""

from __future__ import annotations

from jktools.model.resolved import Ignored
from jktools.syntax.template.parameters import PARAMETERS
from jktools.syntax.template.values import ValueKind, scan


def wanted_value(ignored: Ignored) -> str:
    """For messages: `0 or more`, `three numbers, (x/y/z)`."""
    uses = PARAMETERS[ignored.key].uses
    if ignored.key == "move":
        return uses[0].note
    if ignored.key == "numframes":
        return "it once, and 1 or more"
    bounded = next((use for use in uses if use.least is not None), None)
    if bounded is not None and scan(bounded.kind, ignored.text) is not None:
        return f"{bounded.least:g} to {bounded.most:g}" if bounded.most is not None else f"{bounded.least:g} or more"
    return " or ".join(dict.fromkeys(use.kind.form for use in uses if use.kind is not ValueKind.WORD))
