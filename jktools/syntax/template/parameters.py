"""Every parameter of templates and things: the one table behind reading, resolving, rules, command line and docs.

Source: the THINGPARAM list and the handlers of the decompiled engine (sithThing_ParseArg and its kin). For each
`key=value` the engine asks its handlers in the order of `Scope` until one accepts. What none accepts changes nothing,
and nobody is told.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from jktools.syntax.template.values import ValueKind


class Scope(enum.Enum):
    """Which things a handler of the engine serves, in the order in which it asks them."""

    ANY = "any thing"
    ACTOR = "type actor or player"
    WEAPON = "type weapon"
    ITEM = "type item"
    EXPLOSION = "type explosion"
    PARTICLE = "type particle"
    PHYSICS = "move physics"
    PATH = "move path"
    AI = "things with an AI"


class Act(enum.Enum):
    """What accepting a value does."""

    SET = "replaces"
    TYPE = "sets the type, and the control of actors, explosions and particles"
    MOVE = "sets the way to move"
    AI = "gives the thing an AI"
    HEALTH = "raises maxhealth to at least the same"
    MAXHEALTH = "sets health too"
    MOVE_SIZE = "is passed over for actors and players"
    SHAPE = "takes the place of model3d, sprite and particle"
    ADD = "joins those that there are"
    FRAME_COUNT = "counts once"
    FRAME = "is added while there is room"


class Refers(enum.Enum):
    """What a name stands for."""

    TEMPLATE = "template"
    MODEL = "3do"
    SPRITE = "spr"
    PUPPET = "pup"
    SOUND_CLASS = "snd"
    AI_CLASS = "ai"
    COG = "cog"
    PARTICLES = "par"
    MATERIAL = "mat"


@dataclass(frozen=True, slots=True)
class Use:
    """How one handler takes a parameter."""

    scope: Scope
    kind: ValueKind
    unit: str = ""
    least: float | None = None
    most: float | None = None
    act: Act = Act.SET
    sets: tuple[str, ...] = ()
    """Other parameters that get the same value."""
    turns_on: tuple[tuple[str, int], ...] = ()
    """Flags that are switched on in another parameter: its key and the bits."""
    refers: Refers | None = None
    none_clears: bool = False
    """Whether `none` means nothing rather than a file of that name."""
    note: str = ""

    def accepts(self, value: float) -> bool:
        """Whether a number is in range; the engine keeps the old value otherwise."""
        return (self.least is None or value >= self.least) and (self.most is None or value <= self.most)


@dataclass(frozen=True, slots=True)
class Parameter:
    """One key with all that the engine makes of it."""

    key: str
    uses: tuple[Use, ...]
    """In the order in which the engine asks; empty for a key that it knows and has no handler for."""
    game: str = "jk"
    """`mots` for a key that only Mysteries of the Sith knows."""


TYPES = (
    "free", "camera", "actor", "weapon", "debris", "item", "explosion", "cog", "ghost", "corpse", "player", "particle",
)  # fmt: skip
"""In the engine's order; any other word is `free`."""

MOVES = ("none", "physics", "path")
"""In the engine's order; any other word is rejected."""

MOST_DEBRIS = 4
"""Places for debris of one explosion (sithExplosion_ParseArg)."""

MOST_FRAMES = 1024
"""Frames of one thing that are kept. The engine has no such limit; the longest known line of the game has some 90."""

EMITS_LIGHT = 0x1
COG_LINKED = 0x400
BLAST = 0x2
DAMAGES = 0x4
VARIABLE_LIGHT = 0x10

TYPE_SCOPE: Mapping[str, Scope] = MappingProxyType(
    {
        "actor": Scope.ACTOR, "player": Scope.ACTOR, "weapon": Scope.WEAPON, "item": Scope.ITEM,
        "explosion": Scope.EXPLOSION, "particle": Scope.PARTICLE,
    }
)  # fmt: skip
"""The handler of each type that has one. Its values share their memory with those of the others."""

MOVE_SCOPE: Mapping[str, Scope] = MappingProxyType({"physics": Scope.PHYSICS, "path": Scope.PATH})
"""The handler of each way to move. Their values share their memory too."""

_V = ValueKind


def _numbers(scope: Scope, keys: str, unit: str = "", *, least: float | None = None, note: str = "") -> list[Parameter]:
    return [Parameter(key, (Use(scope, _V.FLOAT, unit, least, note=note),)) for key in keys.split()]


def _flags(*scopes: Scope) -> tuple[Use, ...]:
    return tuple(Use(scope, _V.HEX, note="replaces all flags") for scope in scopes)


def _template(*scopes: Scope) -> tuple[Use, ...]:
    return tuple(Use(scope, _V.WORD, refers=Refers.TEMPLATE, none_clears=True) for scope in scopes)


_BLAST = (("typeflags", BLAST),)

_GENERAL = (
    Parameter("type", (Use(Scope.ANY, _V.WORD, act=Act.TYPE, note="one of " + ", ".join(TYPES)),)),
    Parameter("collide", (Use(Scope.ANY, _V.INT, least=0, most=3, note="0 none, 1 sphere, 2 sphere tree, 3 faces"),)),
    Parameter("treesize", (Use(Scope.ANY, _V.FLOAT, "JKU", 0),), game="mots"),
    Parameter("move", (Use(Scope.ANY, _V.WORD, act=Act.MOVE, note="one of " + ", ".join(MOVES)),)),
    Parameter("size", (Use(Scope.ANY, _V.FLOAT, "JKU", 0, sets=("movesize",), note="radius that others touch"),)),
    Parameter("thingflags", _flags(Scope.ANY)),
    Parameter("timer", (Use(Scope.ANY, _V.FLOAT, "s", 0, note="life time"),)),
    Parameter("light", (Use(Scope.ANY, _V.FLOAT, "", 0, turns_on=(("thingflags", EMITS_LIGHT),)),)),
    Parameter("attach", ()),
    Parameter("soundclass", (Use(Scope.ANY, _V.WORD, refers=Refers.SOUND_CLASS, none_clears=True),)),
    Parameter(
        "model3d",
        (Use(Scope.ANY, _V.WORD, act=Act.SHAPE, refers=Refers.MODEL, note="its radius for a size or movesize of 0"),),
    ),
    Parameter("sprite", (Use(Scope.ANY, _V.WORD, act=Act.SHAPE, refers=Refers.SPRITE),)),
    Parameter("puppet", (Use(Scope.ANY, _V.WORD, refers=Refers.PUPPET),)),
    Parameter("aiclass", (Use(Scope.ANY, _V.WORD, act=Act.AI, refers=Refers.AI_CLASS),)),
    Parameter("cog", (Use(Scope.ANY, _V.WORD, refers=Refers.COG, turns_on=(("thingflags", COG_LINKED),)),)),
    Parameter("particle", (Use(Scope.ANY, _V.WORD, act=Act.SHAPE, refers=Refers.PARTICLES),)),
    Parameter("movesize", (Use(Scope.ANY, _V.FLOAT, "JKU", 0, act=Act.MOVE_SIZE, note="radius that moves"),)),
    Parameter("creatething", _template(Scope.ANY)),
    Parameter("orient", (Use(Scope.ANY, _V.VECTOR, "degrees", note="pitch, yaw, roll"),)),
    Parameter("points", ()),
)  # fmt: skip

_TYPED = (
    Parameter("typeflags", _flags(Scope.ACTOR, Scope.WEAPON, Scope.ITEM, Scope.EXPLOSION, Scope.PARTICLE)),
    Parameter("health", (Use(Scope.ACTOR, _V.FLOAT, "", 0, act=Act.HEALTH),)),
    Parameter("maxhealth", (Use(Scope.ACTOR, _V.FLOAT, "", 0, act=Act.MAXHEALTH),)),
    Parameter(
        "maxthrust",
        (Use(Scope.ACTOR, _V.FLOAT, "JKU/s²", 0), Use(Scope.PARTICLE, _V.FLOAT, "1/s", note="speed of expansion")),
    ),
    *_numbers(Scope.ACTOR, "maxrotthrust jumpspeed", least=0),
    Parameter("weapon", _template(Scope.ACTOR)),
    Parameter("weapon2", _template(Scope.ACTOR)),
    Parameter("explode", _template(Scope.ACTOR, Scope.WEAPON)),
    Parameter("eyeoffset", (Use(Scope.ACTOR, _V.VECTOR, "JKU"),)),
    Parameter("fireoffset", (Use(Scope.ACTOR, _V.VECTOR, "JKU"),)),
    Parameter("lightoffset", (Use(Scope.ACTOR, _V.VECTOR, "JKU", turns_on=(("thingflags", EMITS_LIGHT),)),)),
    Parameter("lightintensity", (Use(Scope.ACTOR, _V.FLOAT, turns_on=(("thingflags", EMITS_LIGHT),)),)),
    *_numbers(Scope.ACTOR, "minheadpitch maxheadpitch", "degrees"),
    Parameter("error", (Use(Scope.ACTOR, _V.FLOAT, note="chance, 0 to 1, that a deflected shot is scattered"),)),
    Parameter("fov", (Use(Scope.ACTOR, _V.FLOAT, "cosine", note="of the widest angle at which shots are blocked"),)),
    Parameter("chance", (Use(Scope.ACTOR, _V.FLOAT, note="of blocking, 0 to 1"),)),
    Parameter(
        "damage",
        (
            Use(Scope.WEAPON, _V.FLOAT),
            Use(Scope.EXPLOSION, _V.FLOAT, turns_on=(("typeflags", BLAST | DAMAGES),)),
        ),
    ),
    *_numbers(Scope.WEAPON, "mindamage trailcylradius"),
    *_numbers(Scope.WEAPON, "trailrandangle", "degrees"),
    Parameter("force", (Use(Scope.WEAPON, _V.FLOAT), Use(Scope.EXPLOSION, _V.FLOAT, turns_on=_BLAST))),
    Parameter(
        "range",
        (
            Use(Scope.WEAPON, _V.FLOAT, "JKU", note="length of the ray of an instant hit"),
            Use(Scope.EXPLOSION, _V.FLOAT, "JKU", turns_on=_BLAST, note="radius"),
            Use(Scope.PARTICLE, _V.FLOAT, "JKU", note="greatest radius"),
        ),
    ),
    Parameter(
        "rate",
        (
            Use(Scope.WEAPON, _V.FLOAT, note="damage lost, per JKU of an instant hit, else per second"),
            Use(Scope.PARTICLE, _V.FLOAT),
        ),
    ),
    Parameter(
        "elementsize",
        (Use(Scope.WEAPON, _V.FLOAT, "JKU", note="between parts of a trail"), Use(Scope.PARTICLE, _V.FLOAT, "JKU")),
    ),
    Parameter("damageclass", _flags(Scope.WEAPON, Scope.EXPLOSION)),
    Parameter("fleshhit", _template(Scope.WEAPON)),
    Parameter("trailthing", _template(Scope.WEAPON)),
    Parameter("blasttime", (Use(Scope.EXPLOSION, _V.FLOAT, "s", turns_on=_BLAST),)),
    Parameter("maxlight", (Use(Scope.EXPLOSION, _V.FLOAT, turns_on=(("typeflags", VARIABLE_LIGHT),)),)),
    Parameter("flashrgb", (Use(Scope.EXPLOSION, _V.COLOUR),)),
    Parameter(
        "debris",
        (Use(Scope.EXPLOSION, _V.WORD, act=Act.ADD, refers=Refers.TEMPLATE, none_clears=True, note="4 at most"),),
    ),
    Parameter("respawn", (Use(Scope.ITEM, _V.FLOAT, "s"),)),
    Parameter("respawnfactor", (Use(Scope.ITEM, _V.FLOAT),), game="mots"),
    Parameter("count", (Use(Scope.PARTICLE, _V.INT, note="256 at most are drawn"),)),
    *_numbers(Scope.PARTICLE, "minsize", "JKU"),
    *_numbers(Scope.PARTICLE, "pitchrange yawrange", "degrees"),
    Parameter("material", (Use(Scope.PARTICLE, _V.WORD, refers=Refers.MATERIAL),)),
)

_MOVING = (
    *_numbers(Scope.PHYSICS, "surfdrag airdrag", "1/s", least=0),
    *_numbers(Scope.PHYSICS, "staticdrag", "JKU/s", least=0, note="slower than this, a body stops"),
    *_numbers(Scope.PHYSICS, "mass", least=0, note="0: neither gravity nor applied forces"),
    *_numbers(Scope.PHYSICS, "height", "JKU", least=0, note="of hovering, in place of the model's"),
    Parameter("physflags", _flags(Scope.PHYSICS)),
    *_numbers(Scope.PHYSICS, "maxrotvel orientspeed", "degrees/s", least=0),
    *_numbers(Scope.PHYSICS, "maxvel", "JKU/s", least=0),
    Parameter("vel", (Use(Scope.PHYSICS, _V.VECTOR, "JKU/s"),)),
    Parameter("angvel", (Use(Scope.PHYSICS, _V.VECTOR, "degrees/s"),)),
    *_numbers(Scope.PHYSICS, "buoyancy", note="share of gravity under water"),
    Parameter(
        "numframes",
        (Use(Scope.PATH, _V.INT, least=1, act=Act.FRAME_COUNT), Use(Scope.AI, _V.INT, act=Act.FRAME_COUNT)),
    ),
    Parameter(
        "frame",
        (
            Use(Scope.PATH, _V.FRAME, "JKU, degrees", act=Act.FRAME, note="x/y/z:pitch/yaw/roll"),
            Use(Scope.AI, _V.VECTOR, "JKU", act=Act.FRAME, note="place of a patrol"),
        ),
    ),
)

PARAMETERS: Mapping[str, Parameter] = MappingProxyType({p.key: p for p in (*_GENERAL, *_TYPED, *_MOVING)})
"""By key, in lower case."""

TEMPLATE_KEYS = frozenset(
    p.key for p in PARAMETERS.values() if any(use.refers is Refers.TEMPLATE for use in p.uses)
)  # fmt: skip
"""Parameters whose value is the name of a template."""

FLAG_KEYS = frozenset(p.key for p in PARAMETERS.values() if any(use.kind is ValueKind.HEX for use in p.uses))
"""Parameters that the engine reads with %x."""
