"""What the engine's handlers do with a value that they accept (sithThing_ParseArg and its kin)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

from jktools.model.resolved import Origin, Reason, Setting
from jktools.model.template_record import FREE, NONE, Record
from jktools.syntax.template.parameters import (
    MOST_DEBRIS,
    MOST_FRAMES,
    MOVES,
    PARAMETERS,
    TYPES,
    Act,
    Refers,
    Scope,
    Use,
)
from jktools.syntax.template.values import Value

AI_TYPE = "actor"
BODIES = ("actor", "player")
SHAPES = ("model3d", "sprite", "particle")


class Given(NamedTuple):
    """A value on its way to a handler."""

    key: str
    use: Use
    value: Value
    text: str
    origin: Origin

    def setting(self) -> Setting:
        """The value as what the record holds."""
        return Setting(self.value, self.text, self.use, (self.origin,))


def take(record: Record, given: Given) -> Reason | None:
    """Give a handler a value; None when it changes something."""
    use, value, text, origin = given.use, given.value, given.text, given.origin
    if isinstance(value, (int, float)) and not use.accepts(value):
        return Reason.REJECTED
    if use.refers is Refers.TEMPLATE:
        return _name_template(record, given)
    fault = _ACTS[use.act](record, given)
    if fault is not None:
        return fault
    for other in use.sets:
        record.values[other] = Setting(value, text, PARAMETERS[other].uses[0], (origin,))
    for flags, bits in use.turns_on:
        record.turn_on(flags, bits, use.scope, origin)
    return None


def _set(record: Record, given: Given) -> None:
    held = None if given.use.none_clears and given.value == NONE else given.value
    record.values[given.key] = given.setting()._replace(value=held)


def _set_type(record: Record, given: Given) -> None:
    word = str(given.value) if given.value in TYPES else FREE
    record.change_type(word, given.origin)
    if word == AI_TYPE:
        record.has_ai = True
    elif word in ("explosion", "particle"):
        record.has_ai = False  # these get a control of their own
    record.values[given.key] = given.setting()._replace(value=word)


def _set_move(record: Record, given: Given) -> Reason | None:
    if given.value not in MOVES:
        return Reason.REJECTED
    record.change_move(str(given.value), given.origin)
    _set(record, given)
    return None


def _set_ai(record: Record, given: Given) -> None:
    record.has_ai = True
    _set(record, given)


def _set_health(record: Record, given: Given) -> None:
    record.values[given.key] = given.setting()
    most = record.values.get("maxhealth")
    if most is None or not isinstance(most.value, float) or most.value <= float(str(given.value)):
        record.values["maxhealth"] = given.setting()


def _set_most_health(record: Record, given: Given) -> None:
    record.values[given.key] = record.values["health"] = given.setting()


def _set_move_size(record: Record, given: Given) -> Reason | None:
    if record.type in BODIES:
        return Reason.FIXED_SIZE
    _set(record, given)
    return None


def _set_shape(record: Record, given: Given) -> None:
    for other in SHAPES:
        record.values.pop(other, None)
    record.values[given.key] = given.setting()
    if given.use.refers is Refers.MODEL:
        _size_from_model(record, str(given.value), given.origin)


def _size_from_model(record: Record, model: str, origin: Origin) -> None:
    """A size of 0 becomes the model's radius."""
    for key in ("size", "movesize"):
        at = record.values.get(key)
        if at is None or at.value == 0:
            radius = record.known.radius_of(model)
            record.values[key] = Setting(radius, f"radius of {model}", PARAMETERS[key].uses[0], (origin,))


def _name_template(record: Record, given: Given) -> Reason | None:
    key, use, text, origin = given.key, given.use, given.text, given.origin
    found = record.known.get(text)
    value = None if found is None else text.lower()
    before = record.values.get(key)
    if use.act is not Act.ADD:
        record.values[key] = Setting(value, text, use, (origin,))
    elif value is not None and before is None:
        record.values[key] = Setting((value,), text, use, (origin,))
    elif value is not None and before is not None:
        names = before.value if isinstance(before.value, tuple) else ()
        if len(names) >= MOST_DEBRIS:
            return Reason.FULL
        record.values[key] = Setting((*names, value), f"{before.text} {text}", use, (*before.origins, origin))
    return None if found is not None or text.lower() == NONE else Reason.UNRESOLVED


def _count_frames(record: Record, given: Given) -> Reason | None:
    if given.use.scope is Scope.AI and record.owner.kind == "template":
        return Reason.BEFORE_BIRTH
    frames = record.frames_of(given.use)
    if given.value == 0 or (given.key in frames and frames[given.key].use.scope is given.use.scope):
        return Reason.REJECTED
    frames[given.key] = given.setting()
    return None


def has_room(record: Record, use: Use) -> bool:
    """Whether a path or patrol has room for another frame."""
    count, frames = record.frames_of(use).get("numframes"), record.frames_of(use).get("frame")
    room = count.value if count is not None and count.use.scope is use.scope else 0
    held = frames.value if frames is not None and frames.use.scope is use.scope else ()
    return isinstance(room, int) and isinstance(held, tuple) and len(held) < min(room, MOST_FRAMES)


def _add_frame(record: Record, given: Given) -> None:
    held = record.frames_of(given.use)
    before = held.get(given.key)
    if before is None or before.use.scope is not given.use.scope:
        held[given.key] = given.setting()._replace(value=(given.value,))
    else:
        frames = before.value if isinstance(before.value, tuple) else ()
        held[given.key] = Setting(
            (*frames, given.value), f"{before.text} {given.text}", given.use, (*before.origins, given.origin)
        )


_ACTS: Mapping[Act, Callable[[Record, Given], Reason | None]] = MappingProxyType(
    {
        Act.SET: _set,
        Act.TYPE: _set_type,
        Act.MOVE: _set_move,
        Act.AI: _set_ai,
        Act.HEALTH: _set_health,
        Act.MAXHEALTH: _set_most_health,
        Act.MOVE_SIZE: _set_move_size,
        Act.SHAPE: _set_shape,
        Act.FRAME_COUNT: _count_frames,
        Act.FRAME: _add_frame,
    }
)
