"""The facts of one script."""

from __future__ import annotations

from jktools.syntax.cog import Script


class ScriptFacts:
    """Facts are pulled: nothing is computed that no rule asks for, and nothing twice."""

    def __init__(self, script: Script) -> None:
        """Know nothing yet."""
        self.script = script
