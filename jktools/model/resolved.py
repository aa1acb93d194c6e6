"""A template or thing as the engine holds it: every value with who set it, and what the engine makes nothing of.

How it comes about: `templates.py`.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple

from jktools.syntax.template.parameters import Refers, Scope, Use
from jktools.syntax.template.values import Value

if TYPE_CHECKING:
    from jktools.model.objects import Template, Thing
    from jktools.source import Span

ANGLES = -1
"""In place of a parameter: pitch, yaw and roll of a thing's line."""

Memory = Literal["type", "move"]
"""What shares memory."""


class Reason(enum.Enum):
    """Why the engine makes nothing of a parameter."""

    UNKNOWN = "the engine knows no such parameter"
    OTHER_GAME = "only Mysteries of the Sith knows it"
    NO_HANDLER = "the engine does nothing with it"
    NOT_FOR_THIS = "it is not for things like this"
    REJECTED = "the engine does not take the value"
    FIXED_SIZE = "the engine passes it over for actors and players"
    FULL = "there is no room for it"
    UNRESOLVED = "no template of that name stands above"
    BEFORE_BIRTH = "a template has no AI yet that could hold it"


class Origin(NamedTuple):
    """Where something was written: whose line, and which of its parameters."""

    owner: Template | Thing
    place: int
    """Of the parameter among those of the line, or `ANGLES`."""

    @property
    def span(self) -> Span:
        """The bytes."""
        return self.owner.field_span("pitch") if self.place == ANGLES else self.owner.parameter_span(self.place)


class Setting(NamedTuple):
    """A parameter's value, and all who had a part in it."""

    value: Value | tuple[Value, ...] | None
    """As `ValueKind` reads it; None for nothing (`none`, a template that does not exist) and for a size that only a
    model at hand would tell; a tuple of names for debris, of frames for frames."""
    text: str
    use: Use
    origins: tuple[Origin, ...]
    """The first set it; further ones added to it or switched on flags."""


class Ignored(NamedTuple):
    """A parameter of which the engine makes nothing, or only nothing (`UNRESOLVED`)."""

    key: str
    text: str
    reason: Reason
    origin: Origin
    type: str
    move: str
    """At that point of the line."""


class Lost(NamedTuple):
    """An inherited value whose memory a change of `type` or `move` gives to other values."""

    key: str
    setting: Setting
    origin: Origin


class Parked(NamedTuple):
    """Values that a type or a way to move without values of its own leaves in memory."""

    scope: Scope
    values: Mapping[str, Setting]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Resolved:
    """A template or thing as the engine holds it."""

    owner: Template | Thing
    parent: Resolved | None
    """The template that it copies; None for a blank base."""
    values: Mapping[str, Setting]
    """By key; what is missing is 0 or nothing."""
    type: str
    move: str
    has_ai: bool
    ignored: tuple[Ignored, ...]
    """Of its own line."""
    lost: tuple[Lost, ...]
    """Through its own line."""
    parked: Mapping[Memory, Parked]
    """What lies in memory unused."""
    leaves_level: bool
    """Whether it, or an ancestor, copies a template that is not at hand: the game's own may hold anything."""
    dropped: str | None
    """Why the engine does not keep it."""

    @property
    def chain(self) -> Iterator[Resolved]:
        """Itself, then its ancestors."""
        at: Resolved | None = self
        while at is not None:
            yield at
            at = at.parent

    @property
    def knows_type(self) -> bool:
        """Whether the level alone says the type; a template that is not at hand may give another."""
        return not self.leaves_level or "type" in self.values

    def number(self, key: str) -> float:
        """A number that a parameter holds; 0 where nothing sets it or only a model would tell."""
        setting = self.values.get(key)
        value = None if setting is None else setting.value
        return value if isinstance(value, (int, float)) else 0

    def flags(self, key: str) -> int:
        """The flags of `thingflags`, `typeflags`, `physflags` or `damageclass`."""
        return int(self.number(key))

    def name_in(self, key: str) -> str | None:
        """The name that a parameter holds, in lower case."""
        setting = self.values.get(key)
        return setting.value if setting is not None and isinstance(setting.value, str) else None

    @property
    def templates(self) -> Iterator[tuple[str, str, Setting]]:
        """Each parameter that names a template, with the name in lower case."""
        for key, setting in self.values.items():
            if setting.use.refers is Refers.TEMPLATE and setting.value is not None:
                names = setting.value if isinstance(setting.value, tuple) else (setting.value,)
                for name in names:
                    yield key, str(name), setting
