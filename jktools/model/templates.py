"""Templates and things as the engine holds them: what each inherits, what its own line changes, what is ignored.

Source: sithTemplate_Parse, sithThing_ParseArg and their kin in the decompiled engine. The engine reads templates from
the first to the last. A template starts as a copy of its parent's whole record, if the parent stands above, and each of
its parameters then changes that copy. A thing starts as a copy of its template.

Values of the types share their memory, as do those of the ways to move. A type without values of its own (cog, ghost)
leaves them be; one with others reads them as something else. Such values are told as lost: what the engine then reads
in their place is not worked out.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Literal, NamedTuple

from jktools.syntax.template.parameters import (
    MOST_DEBRIS,
    MOST_FRAMES,
    MOVE_SCOPE,
    MOVES,
    PARAMETERS,
    TYPE_SCOPE,
    TYPES,
    Act,
    Parameter,
    Refers,
    Scope,
    Use,
)
from jktools.syntax.template.values import Value, scan

if TYPE_CHECKING:
    from jktools.model.objects import Template, Thing
    from jktools.source import Span

NONE = "none"
FREE = TYPES[0]
STILL = MOVES[0]
AI_TYPE = "actor"
BODIES = ("actor", "player")
SHAPES = ("model3d", "sprite", "particle")
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


RadiusOf = Callable[[str], "float | None"]
"""The radius of a model by its name, JKU; None where the model is not at hand."""


def unknown_radius(model: str) -> float | None:  # noqa: ARG001 (a RadiusOf)
    """Know no model."""
    return None


class TemplateSet:
    """The templates of a level, resolved in the engine's order, and its things on demand.

    `base` holds the templates of the game's static.jkl, which is read first: its names win over the level's.
    """

    def __init__(
        self,
        templates: Sequence[Template],
        most: int | None = None,
        *,
        game: str = "jk",
        base: TemplateSet | None = None,
        radius_of: RadiusOf = unknown_radius,
    ) -> None:
        """Resolve every template; `most` is what the heading announces."""
        self.game, self.base, self.radius_of = game, base, radius_of
        self.by_name: dict[str, Resolved] = {} if base is None else dict(base.by_name)
        """Those that the engine keeps, by lower-case name."""
        self.entries: list[Resolved] = []
        """One a template as written, kept or not."""
        kept = 0
        for template in templates:
            entry = self._template(template, full=most is not None and kept >= most)
            self.entries.append(entry)
            if entry.dropped is None:
                kept += 1
                self.by_name[template.name.lower()] = entry

    def __len__(self) -> int:
        return len(self.entries)

    def __getitem__(self, index: int) -> Resolved:
        return self.entries[index]

    def get(self, name: str) -> Resolved | None:
        """The template that a name means in a thing's line or in a parameter (sithTemplate_GetTemplate)."""
        return None if name.lower() == NONE else self.by_name.get(name.lower())

    def thing(self, thing: Thing) -> Resolved:
        """A thing with what its line changes. An unknown template makes it a blank one of type free."""
        parent = self.get(thing.template_name)
        line = _Line(self, thing, parent)
        line.turn(thing.angles.tolist())
        line.read(thing.parameters)
        unknown = parent is None and thing.template_name.lower() != NONE
        return line.resolved(thing.dropped, leaves_level=parent.leaves_level if parent is not None else unknown)

    def _template(self, template: Template, *, full: bool) -> Resolved:
        parent = self.by_name.get(template.parent_name.lower())
        unknown = parent is None and template.parent_name.lower() != NONE
        line = _Line(self, template, parent)
        if not template.broken:
            line.read(template.parameters)
        leaves_level = parent.leaves_level if parent is not None else unknown
        return line.resolved(self._dropped(template, line, full, leaves_level), leaves_level=leaves_level)

    def _dropped(self, template: Template, line: _Line, full: bool, leaves_level: bool) -> str | None:
        first = self.by_name.get(template.name.lower())
        if template.broken:
            return "its line could not be read"
        if first is not None:
            owner = first.owner
            if owner.level is not template.level:
                return f"{owner.level.path} has a template of the same name, and is read first"
            return f"template {owner.index} has the same name and comes first"
        if line.type == FREE and not leaves_level:
            return "its type is free"
        return "the heading announces fewer templates" if full else None


class _Line:
    """The record that one line makes, parameter by parameter."""

    def __init__(self, templates: TemplateSet, owner: Template | Thing, parent: Resolved | None) -> None:
        self.templates, self.owner, self.parent = templates, owner, parent
        self.values: dict[str, Setting] = {} if parent is None else dict(parent.values)
        self.type = FREE if parent is None else parent.type
        self.move = STILL if parent is None else parent.move
        self.has_ai = parent is not None and parent.has_ai
        self.patrol: dict[str, Setting] = {}
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

    def turn(self, angles: Sequence[float]) -> None:
        """Give a thing the orientation of its line's fields."""
        use = PARAMETERS["orient"].uses[0]
        text = "(" + "/".join(f"{angle:g}" for angle in angles) + ")"
        self.values["orient"] = Setting(tuple(angles), text, use, (Origin(self.owner, ANGLES),))

    def read(self, words: Sequence[tuple[str, str]]) -> None:
        """Take the parameters in their order."""
        for place, (key, text) in enumerate(words):
            self._parameter(key.lower(), text, Origin(self.owner, place))

    def _parameter(self, key: str, text: str, origin: Origin) -> None:
        parameter = PARAMETERS.get(key)
        if parameter is None:
            self._ignore(key, text, Reason.UNKNOWN, origin)
        elif parameter.game != "jk" and self.templates.game == "jk":
            self._ignore(key, text, Reason.OTHER_GAME, origin)
        elif not parameter.uses:
            self._ignore(key, text, Reason.NO_HANDLER, origin)
        else:
            self._ask_handlers(parameter, text, origin)

    def _ask_handlers(self, parameter: Parameter, text: str, origin: Origin) -> None:
        reason: Reason | None = Reason.NOT_FOR_THIS
        for use in parameter.uses:
            if not self._serves(use.scope):
                continue
            if use.act is Act.FRAME and not self._has_room(use):
                reason = Reason.FULL
                break
            value = scan(use.kind, text)
            reason = Reason.REJECTED if value is None else self._take(parameter.key, use, value, text, origin)
            if reason is not Reason.REJECTED:
                break
        if reason is not None:
            self._ignore(parameter.key, text, reason, origin)

    def _serves(self, scope: Scope) -> bool:
        if scope is Scope.AI:
            return self.has_ai
        return scope is Scope.ANY or scope in (TYPE_SCOPE.get(self.type), MOVE_SCOPE.get(self.move))

    def _take(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        """Give a handler the value; None when it changes something."""
        if isinstance(value, (int, float)) and not use.accepts(value):
            return Reason.REJECTED
        if use.refers is Refers.TEMPLATE:
            return self._name_template(key, use, text, origin)
        fault = _ACTS[use.act](self, key, use, value, text, origin)
        if fault is not None:
            return fault
        for other in use.sets:
            self.values[other] = Setting(value, text, PARAMETERS[other].uses[0], (origin,))
        for flags, bits in use.turns_on:
            self._turn_on(flags, bits, use.scope, origin)
        return None

    # ---- what accepting a value does

    def _set(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        held = None if use.none_clears and value == NONE else value
        self.values[key] = Setting(held, text, use, (origin,))
        return None

    def _set_type(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        word = str(value) if value in TYPES else FREE
        self._switch("type", TYPE_SCOPE.get(self.type), TYPE_SCOPE.get(word), origin)
        self.type = word
        if word == AI_TYPE:
            self.has_ai = True
        elif word in ("explosion", "particle"):
            self.has_ai = False  # these get a control of their own
        self.values[key] = Setting(word, text, use, (origin,))
        return None

    def _set_move(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        if value not in MOVES:
            return Reason.REJECTED
        self._switch("move", MOVE_SCOPE.get(self.move), MOVE_SCOPE.get(str(value)), origin)
        self.move = str(value)
        return self._set(key, use, value, text, origin)

    def _set_ai(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        self.has_ai = True
        return self._set(key, use, value, text, origin)

    def _set_health(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        self.values[key] = Setting(value, text, use, (origin,))
        most = self.values.get("maxhealth")
        if most is None or not isinstance(most.value, float) or most.value <= float(str(value)):
            self.values["maxhealth"] = Setting(value, text, use, (origin,))
        return None

    def _set_most_health(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        self.values[key] = self.values["health"] = Setting(value, text, use, (origin,))
        return None

    def _set_move_size(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        if self.type in BODIES:
            return Reason.FIXED_SIZE
        return self._set(key, use, value, text, origin)

    def _set_shape(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        for other in SHAPES:
            self.values.pop(other, None)
        self.values[key] = Setting(value, text, use, (origin,))
        if use.refers is Refers.MODEL:
            self._size_from_model(str(value), origin)
        return None

    def _size_from_model(self, model: str, origin: Origin) -> None:
        """A size of 0 becomes the model's radius."""
        for key in ("size", "movesize"):
            at = self.values.get(key)
            if at is None or at.value == 0:
                radius = self.templates.radius_of(model)
                self.values[key] = Setting(radius, f"radius of {model}", PARAMETERS[key].uses[0], (origin,))

    def _name_template(self, key: str, use: Use, text: str, origin: Origin) -> Reason | None:
        found = self.templates.get(text)
        value = None if found is None else text.lower()
        before = self.values.get(key)
        if use.act is Act.ADD:
            if value is not None and before is not None:
                names = before.value if isinstance(before.value, tuple) else ()
                if len(names) >= MOST_DEBRIS:
                    return Reason.FULL
                self.values[key] = Setting(
                    (*names, value), f"{before.text} {text}", use, (*before.origins, origin)
                )  # fmt: skip
            elif value is not None:
                self.values[key] = Setting((value,), text, use, (origin,))
        else:
            self.values[key] = Setting(value, text, use, (origin,))
        return None if found is not None or text.lower() == NONE else Reason.UNRESOLVED

    def _count_frames(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        if use.scope is Scope.AI and self.owner.kind == "template":
            return Reason.BEFORE_BIRTH
        frames = self._frames(use)
        if value == 0 or (key in frames and frames[key].use.scope is use.scope):
            return Reason.REJECTED
        frames[key] = Setting(value, text, use, (origin,))
        return None

    def _frames(self, use: Use) -> dict[str, Setting]:
        """Where frames go: a patrol lies in the AI, apart from a path."""
        return self.patrol if use.scope is Scope.AI else self.values

    def _has_room(self, use: Use) -> bool:
        """Whether a path or patrol has room for another frame."""
        count, frames = self._frames(use).get("numframes"), self._frames(use).get("frame")
        room = count.value if count is not None and count.use.scope is use.scope else 0
        held = frames.value if frames is not None and frames.use.scope is use.scope else ()
        return isinstance(room, int) and isinstance(held, tuple) and len(held) < min(room, MOST_FRAMES)

    def _add_frame(self, key: str, use: Use, value: Value, text: str, origin: Origin) -> Reason | None:
        held = self._frames(use)
        before = held.get(key)
        if before is None or before.use.scope is not use.scope:
            held[key] = Setting((value,), text, use, (origin,))
        else:
            frames = before.value if isinstance(before.value, tuple) else ()
            held[key] = Setting((*frames, value), f"{before.text} {text}", use, (*before.origins, origin))
        return None

    def _turn_on(self, key: str, bits: int, scope: Scope, origin: Origin) -> None:
        before = self.values.get(key)
        use = next((u for u in PARAMETERS[key].uses if u.scope in (scope, Scope.ANY)), PARAMETERS[key].uses[0])
        value = int(before.value) if before is not None and isinstance(before.value, int) else 0
        if before is not None and value & bits == bits:
            return
        origins = (*before.origins, origin) if before is not None else (origin,)
        self.values[key] = Setting(value | bits, f"0x{value | bits:x}", use, origins)

    def _switch(self, memory: Memory, before: Scope | None, after: Scope | None, origin: Origin) -> None:
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

    def _ignore(self, key: str, text: str, reason: Reason, origin: Origin) -> None:
        self.ignored.append(Ignored(key, text, reason, origin, self.type, self.move))


_ACTS: Mapping[Act, Callable[[_Line, str, Use, Value, str, Origin], Reason | None]] = MappingProxyType(
    {
        Act.SET: _Line._set,
        Act.TYPE: _Line._set_type,
        Act.MOVE: _Line._set_move,
        Act.AI: _Line._set_ai,
        Act.HEALTH: _Line._set_health,
        Act.MAXHEALTH: _Line._set_most_health,
        Act.MOVE_SIZE: _Line._set_move_size,
        Act.SHAPE: _Line._set_shape,
        Act.FRAME_COUNT: _Line._count_frames,
        Act.FRAME: _Line._add_frame,
    }
)
