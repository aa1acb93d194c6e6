"""The record that one line makes, as it changes from parameter to parameter.

Values of the types share their memory, as do those of the ways to move. A type without values of its own (cog, ghost)
leaves them be; one with others reads them as something else. Such values are told as lost: what the engine then reads
in their place is not worked out.
"""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType
from typing import TYPE_CHECKING, Protocol

from jktools.model.resolved import Ignored, Lost, Memory, Origin, Parked, Resolved, Setting
from jktools.syntax.template.parameters import MOVE_SCOPE, MOVES, PARAMETERS, TYPE_SCOPE, TYPES, Scope, Use

if TYPE_CHECKING:
    from jktools.model.objects import Template, Thing

NONE = "none"
FREE = TYPES[0]
STILL = MOVES[0]

RadiusOf = Callable[[str], "float | None"]
"""The radius of a model by its name, JKU; None where the model is not at hand."""


class Known(Protocol):
    """What a line may ask about what stands above it."""

    radius_of: RadiusOf

    def get(self, name: str) -> Resolved | None:
        """The template that a name means."""


class Record:
    """The memory of a template or thing: at first a copy of its parent's, or blank."""

    def __init__(self, known: Known, owner: Template | Thing, parent: Resolved | None) -> None:
        self.known, self.owner, self.parent = known, owner, parent
        self.values: dict[str, Setting] = {} if parent is None else dict(parent.values)
        self.type = FREE if parent is None else parent.type
        self.move = STILL if parent is None else parent.move
        self.has_ai = parent is not None and parent.has_ai
        self.patrol: dict[str, Setting] = {}
        """Frames that lie in the AI, apart from those of a path."""
        self.parked: dict[Memory, Parked] = {} if parent is None else dict(parent.parked)
        self.ignored: list[Ignored] = []
        self.lost: list[Lost] = []

    def resolved(self, dropped: str | None, *, leaves_level: bool) -> Resolved:
        """What the line made."""
        for key, setting in self.patrol.items():
            self.values.setdefault(key, setting)
        return Resolved(
            self.owner, self.parent, MappingProxyType(self.values), self.type, self.move, self.has_ai,
            tuple(self.ignored), tuple(self.lost), self.parked, leaves_level, dropped,
        )  # fmt: skip

    def serves(self, scope: Scope) -> bool:
        """Whether a handler of that scope is asked."""
        if scope is Scope.AI:
            return self.has_ai
        return scope is Scope.ANY or scope in (TYPE_SCOPE.get(self.type), MOVE_SCOPE.get(self.move))

    def change_type(self, word: str, origin: Origin) -> None:
        """Make it a thing of another type."""
        self._hand_over("type", TYPE_SCOPE.get(self.type), TYPE_SCOPE.get(word), origin)
        self.type = word

    def change_move(self, word: str, origin: Origin) -> None:
        """Make it move in another way."""
        self._hand_over("move", MOVE_SCOPE.get(self.move), MOVE_SCOPE.get(word), origin)
        self.move = word

    def frames_of(self, use: Use) -> dict[str, Setting]:
        """Where frames go."""
        return self.patrol if use.scope is Scope.AI else self.values

    def turn_on(self, key: str, bits: int, scope: Scope, origin: Origin) -> None:
        """Switch flags on that are off."""
        before = self.values.get(key)
        use = next((u for u in PARAMETERS[key].uses if u.scope in (scope, Scope.ANY)), PARAMETERS[key].uses[0])
        value = int(before.value) if before is not None and isinstance(before.value, int) else 0
        if before is not None and value & bits == bits:
            return
        origins = (*before.origins, origin) if before is not None else (origin,)
        self.values[key] = Setting(value | bits, f"0x{value | bits:x}", use, origins)

    def _hand_over(self, memory: Memory, before: Scope | None, after: Scope | None, origin: Origin) -> None:
        """Hand the memory from the values of one scope to those of another."""
        if before is after:
            return
        if before is not None:
            keys = [key for key, setting in self.values.items() if setting.use.scope is before]
            held: Parked | None = Parked(before, {key: self.values.pop(key) for key in keys})
        else:
            held = self.parked.pop(memory, None)
        if held is None:
            return
        if after is None:
            self.parked[memory] = held
        elif after is held.scope:
            self.values.update(held.values)
        else:
            self.lost += [Lost(key, setting, origin) for key, setting in held.values.items()]
