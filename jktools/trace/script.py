"""The script of a trace: what the player does when, and on what ground.

    floor -1 0               a level floor from y = -1 on, at height 0; a surface name may follow
    floor 2 -0.11 icy        the next one: treads come in ascending order
    0    walk forward        seconds, then what happens; walk, run or slow, one or two directions
    2.5  crouch              and stand; they, jump and surface leave the direction as it is
    3    jump
    4    surface non-floor   every floor becomes this
    4    velocity 0 1 0      JKU/s to the right, forward and up, at once: what SetThingVel does
    4    sector-thrust 0 0 8 JKU/s^2 along the level's x, y, z in its sectors with thrust: what SetSectorThrust does
    4    extra-speed 1       added to the thrust of held keys: what SetActorExtraSpeed does
    5    release             all keys but crouch
    6    end                 where the trace ends; # starts a comment

Without a floor line the ground is one level floor. Surfaces: floor, non-floor, icy, very-icy, shallow-water,
deep-water, very-deep-water.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field

from jktools.engine.ground import SURFACES, Steps, Tread
from jktools.engine.simulation import Phase
from jktools.engine.thrust import Keys

DIRECTIONS = {
    "forward": ("forward", 1.0),
    "back": ("forward", -1.0),
    "left": ("strafe", -1.0),
    "right": ("strafe", 1.0),
}
GAITS = ("walk", "run", "slow")


class ScriptError(ValueError):
    """A line of a script that cannot be read; the message starts with its number."""


@dataclass(frozen=True, slots=True)
class Script:
    """A script that was read."""

    phases: tuple[Phase, ...]
    seconds: float
    ground: Steps


@dataclass(slots=True)
class _Reader:
    treads: list[Tread] = field(default_factory=list)
    phases: list[Phase] = field(default_factory=list)
    keys: Keys = field(default_factory=Keys)
    end: float | None = None

    def read(self, words: list[str]) -> None:
        if self.end is not None:
            raise ScriptError("nothing may follow the end")
        if words[0] == "floor":
            self.floor(words[1:])
            return
        if len(words) < 2:
            raise ScriptError("a time needs an action")
        time = _number(words[0])
        if self.phases and time < self.phases[-1].start:
            raise ScriptError(f"time {time:g} comes before {self.phases[-1].start:g}")
        if time < 0:
            raise ScriptError(f"time {time:g} is before the start")
        self.act(time, words[1], words[2:])

    def floor(self, words: list[str]) -> None:
        if self.phases:
            raise ScriptError("floors come before the first time")
        if not 2 <= len(words) <= 3:
            raise ScriptError("a floor needs its start and height, and may have a surface")
        surface = _surface(words[2]) if len(words) == 3 else SURFACES["floor"]
        tread = Tread(_number(words[0]), _number(words[1]), surface)
        if self.treads and tread.start <= self.treads[-1].start:
            raise ScriptError(f"floor at {tread.start:g} does not come after {self.treads[-1].start:g}")
        self.treads.append(tread)

    def act(self, time: float, action: str, rest: list[str]) -> None:
        ground = None
        if action in GAITS:
            self.keys = _moving(self.keys, action, rest)
        elif action == "surface":
            if len(rest) != 1:
                raise ScriptError("surface takes one name")
            self.treads = [tread._replace(surface=_surface(rest[0])) for tread in self.floors()]
            ground = Steps(tuple(self.treads))
        elif action in ("velocity", "sector-thrust"):
            if len(rest) != 3:
                raise ScriptError(f"{action} takes three numbers")
            vector = (_number(rest[0]), _number(rest[1]), _number(rest[2]))
            blank = Phase(time, self.keys)
            self.phases.append(
                blank._replace(velocity=vector) if action == "velocity" else blank._replace(sector_thrust=vector)
            )
            return
        elif action == "extra-speed":
            if len(rest) != 1:
                raise ScriptError("extra-speed takes one number")
            self.phases.append(Phase(time, self.keys, extra_speed=_number(rest[0])))
            return
        elif rest:
            raise ScriptError(f"{action} takes no {rest[0]}")
        elif action in ("crouch", "stand"):
            self.keys = dataclasses.replace(self.keys, crouch=action == "crouch")
        elif action == "release":
            self.keys = Keys(crouch=self.keys.crouch)
        elif action == "end":
            self.end = time
            return
        elif action != "jump":
            raise ScriptError(f"{action} is no action: {', '.join((*GAITS, *_PLAIN))}")
        self.phases.append(Phase(time, dataclasses.replace(self.keys, jump=action == "jump"), ground))

    def floors(self) -> list[Tread]:
        return self.treads or [Tread(0.0, 0.0)]


_PLAIN = ("release", "crouch", "stand", "jump", "surface", "velocity", "sector-thrust", "extra-speed", "end")


def parse(text: str) -> Script:
    """Read a script. Raises ScriptError with the number of the first line that makes no sense."""
    reader, ground = _Reader(), None
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split("#", 1)[0].split()
        if not words:
            continue
        try:
            # The ground at the start is what stands before any surface change.
            ground = Steps(tuple(reader.floors())) if not reader.phases else ground
            reader.read(words)
        except ScriptError as error:
            raise ScriptError(f"line {number}: {error}") from None
    if reader.end is None or ground is None:
        raise ScriptError("no line says where the trace ends, such as: 10 end")
    return Script(tuple(reader.phases), reader.end, ground)


def _moving(keys: Keys, gait: str, directions: list[str]) -> Keys:
    if not 1 <= len(directions) <= 2 or any(name not in DIRECTIONS for name in directions):
        raise ScriptError(f"{gait} takes one or two of {', '.join(DIRECTIONS)}")
    axes = dict(DIRECTIONS[name] for name in directions)
    forward, strafe = axes.get("forward", 0.0), axes.get("strafe", 0.0)
    return Keys(forward, strafe, run=gait == "run", slow=gait == "slow", crouch=keys.crouch)


def _surface(name: str) -> int:
    if name not in SURFACES:
        raise ScriptError(f"{name} is no surface: {', '.join(SURFACES)}")
    return SURFACES[name]


def _number(word: str) -> float:
    try:
        number = float(word)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ScriptError(f"{word} is no number")
    return number
