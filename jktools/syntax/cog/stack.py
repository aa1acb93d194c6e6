"""The stack of the parser."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(slots=True)
class Stack:
    """One entry for each symbol read, the first for none."""

    states: list[int]
    values: list[Any]
    """Nodes, lists of nodes, or the text of a token."""
    starts: list[int]
    """Byte offset at which each symbol starts."""
    end: int = 0
    """Where the last token read ends."""

    def cut(self, length: int) -> None:
        """Forget what lies above."""
        del self.states[length:], self.values[length:], self.starts[length:]
