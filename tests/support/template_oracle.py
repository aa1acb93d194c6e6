"""The engine's reading of templates and things, taken literally: one record, one handler after the other.

Written from the facts about the engine alone, apart from jktools and as plainly as possible. Where the engine would
read the memory of one type's values as another's, the memory is taken as cleared, as jktools documents.
"""

from __future__ import annotations

import copy
import struct
from dataclasses import dataclass, field
from typing import Any

TYPES = """free camera actor weapon debris item explosion cog ghost corpse player particle
""".split()  # noqa: SIM905 (a list of words, as the ones below)
FAMILY = {"actor": "A", "player": "A", "weapon": "W", "item": "I", "explosion": "E", "particle": "P"}
GENERAL = """type collide move size thingflags timer light attach soundclass model3d sprite puppet aiclass cog particle
movesize creatething orient points""".split()  # noqa: SIM905
OTHERS = """typeflags health maxhealth maxthrust maxrotthrust jumpspeed weapon weapon2 explode eyeoffset fireoffset
lightoffset lightintensity minheadpitch maxheadpitch error fov chance damage mindamage force range rate elementsize
trailcylradius trailrandangle damageclass fleshhit trailthing blasttime maxlight flashrgb debris respawn count minsize
pitchrange yawrange material surfdrag airdrag staticdrag mass height physflags maxrotvel maxvel orientspeed vel angvel
buoyancy numframes frame""".split()  # noqa: SIM905
MOTS = ["treesize", "respawnfactor"]


def single(value: float) -> float:
    try:
        return float(struct.unpack("f", struct.pack("f", value))[0])
    except OverflowError:
        return float("inf") if value > 0 else float("-inf")


def scan_float(text: str, at: int) -> tuple[float, int] | None:
    """What scanf's %f takes at a place: the value and where it ends."""
    start = at
    if at < len(text) and text[at] in "+-":
        at += 1
    digits = 0
    while at < len(text) and text[at] in "0123456789":
        at, digits = at + 1, digits + 1
    if at < len(text) and text[at] == ".":
        at += 1
        while at < len(text) and text[at] in "0123456789":
            at, digits = at + 1, digits + 1
    if not digits:
        return None
    end = at
    if at < len(text) and text[at] in "eE":
        at += 1
        if at < len(text) and text[at] in "+-":
            at += 1
        if at < len(text) and text[at] in "0123456789":
            while at < len(text) and text[at] in "0123456789":
                at += 1
            end = at
    return single(float(text[start:end])), end


def scan_int(text: str, at: int) -> tuple[int, int] | None:
    start = at
    if at < len(text) and text[at] in "+-":
        at += 1
    first = at
    while at < len(text) and text[at] in "0123456789":
        at += 1
    return (max(-(2**31), min(2**31 - 1, int(text[start:at]))), at) if at > first else None


def scan_hex(text: str) -> int | None:
    at, minus = 0, False
    if text[:1] in ("+", "-"):
        at, minus = 1, text[0] == "-"
    digits = "0123456789abcdef"
    if text[at : at + 2].lower() == "0x" and text[at + 2 : at + 3].lower() in list(digits):
        at += 2
    first = at
    while at < len(text) and text[at].lower() in digits:
        at += 1
    if at == first:
        return None
    value = int(text[first:at], 16) % 2**32
    return (2**32 - value) % 2**32 if minus else value


def atof(text: str) -> float:
    found = scan_float(text, 0)
    return found[0] if found else 0.0


def atoi(text: str) -> int:
    found = scan_int(text, 0)
    return found[0] if found else 0


def scan_bracket(text: str, separators: str, whole: bool = False) -> tuple[Any, ...] | None:
    """scanf of "(%f/%f/%f" and the like; what follows the last number does not matter."""
    at = 0
    values = []
    for separator in "(" + separators:
        if text[at : at + 1] != separator:
            return None
        found = scan_int(text, at + 1) if whole else scan_float(text, at + 1)
        if found is None:
            return None
        values.append(found[0])
        at = found[1]
    return tuple(values)


@dataclass
class Record:
    """A thing as the engine holds it; an absent field is 0."""

    general: dict[str, Any] = field(default_factory=dict)
    typed: dict[str, Any] = field(default_factory=dict)
    typed_as: str | None = None
    """Whose values the memory holds."""
    moving: dict[str, Any] = field(default_factory=dict)
    moving_as: str | None = None
    patrol: dict[str, Any] = field(default_factory=dict)
    type: str = "free"
    move: str = "none"
    control: str = ""

    def fields(self) -> dict[str, Any]:
        """Everything that this type and this way to move read, with the writer of each."""
        found = dict(self.patrol)
        found.update(self.general)
        if FAMILY.get(self.type) is not None and self.typed_as == FAMILY[self.type]:
            found.update(self.typed)
        if self.move != "none" and self.moving_as == self.move:
            found.update(self.moving)
        return found


class Engine:
    """Reads templates, then things."""

    def __init__(self, game: str, most: int | None) -> None:
        self.game, self.most = game, most
        self.known: dict[str, Record] = {}
        self.keys = {*GENERAL, *OTHERS, *(MOTS if game == "mots" else [])}

    def template(self, name: str, parent: str, words: list[tuple[str, str]], who: str) -> tuple[Record, bool]:
        """Parse one line; whether the engine keeps it."""
        record = copy.deepcopy(self.known.get(parent.lower(), Record()))
        for place, (key, text) in enumerate(words):
            self.parse(record, key.lower(), text.lower(), (who, place), on_thing=False)
        kept = name.lower() not in self.known and record.type != "free"
        kept = kept and not (self.most is not None and len(self.known) >= self.most)
        if kept:
            self.known[name.lower()] = record
        return record, kept

    def thing(self, template: str, angles: tuple[float, ...], words: list[tuple[str, str]], who: str) -> Record:
        base = None if template.lower() == "none" else self.known.get(template.lower())
        record = copy.deepcopy(base or Record())
        record.general["orient"] = (angles, (who, -1))
        for place, (key, text) in enumerate(words):
            self.parse(record, key.lower(), text.lower(), (who, place), on_thing=True)
        return record

    def parse(self, r: Record, key: str, text: str, by: tuple[str, int], on_thing: bool) -> None:
        if key not in self.keys:
            return
        if self.general(r, key, text, by):
            return
        family = FAMILY.get(r.type)
        if family is not None:
            handler = {"A": self.actor, "W": self.weapon, "I": self.item, "E": self.explosion, "P": self.particle}
            if handler[family](r, r.typed, key, text, by):
                return
        if r.move == "physics":
            if self.physics(r.moving, key, text, by):
                return
        elif r.move == "path" and self.path(r.moving, key, text, by):
            return
        if r.control == "ai" and on_thing:
            self.ai(r.patrol, key, text, by)

    def named(self, text: str) -> str | None:
        return text if text != "none" and text in self.known else None

    def general(self, r: Record, key: str, text: str, by: tuple[str, int]) -> bool:
        g = r.general
        if key == "type":
            r.type = text if text in TYPES else "free"
            g["type"] = (r.type, by)
            if r.type == "actor":
                r.control = "ai"
            elif r.type in ("explosion", "particle"):
                r.control = r.type
            family = FAMILY.get(r.type)
            if family is not None and r.typed_as != family:
                r.typed, r.typed_as = {}, family
            return True
        if key == "collide":
            if not 0 <= atoi(text) <= 3:
                return False
            g[key] = (atoi(text), by)
            return True
        if key == "move":
            if text not in ("physics", "path", "none"):
                return False
            r.move = text
            g[key] = (text, by)
            if text != "none" and r.moving_as != text:
                r.moving, r.moving_as = {}, text
            return True
        if key in ("treesize", "timer", "light", "size"):
            if atof(text) < 0:
                return False
            g[key] = (atof(text), by)
            if key == "size":
                g["movesize"] = (atof(text), by)
            if key == "light":
                self.switch(g, "thingflags", 0x1, by)
            return True
        if key == "thingflags":
            if scan_hex(text) is None:
                return False
            g[key] = (scan_hex(text), by)
            return True
        if key == "soundclass":
            g[key] = (None if text == "none" else text, by)
            return True
        if key in ("model3d", "sprite", "particle"):
            for other in ("model3d", "sprite", "particle"):
                g.pop(other, None)
            g[key] = (text, by)
            if key == "model3d":
                for size in ("size", "movesize"):
                    if g.get(size, (0.0, by))[0] == 0:
                        g[size] = (None, by)
            return True
        if key in ("puppet", "aiclass", "cog"):
            g[key] = (text, by)
            if key == "aiclass":
                r.control = "ai"
            if key == "cog":
                self.switch(g, "thingflags", 0x400, by)
            return True
        if key == "movesize":
            if r.type in ("actor", "player"):
                return True
            if atof(text) < 0:
                return False
            g[key] = (atof(text), by)
            return True
        if key == "creatething":
            g[key] = (self.named(text), by)
            return True
        if key == "orient":
            if scan_bracket(text, "//") is None:
                return False
            g[key] = (scan_bracket(text, "//"), by)
            return True
        return False

    def switch(self, values: dict[str, Any], key: str, bits: int, by: tuple[str, int]) -> None:
        old, writer = values.get(key, (0, by))
        values[key] = (old | bits, writer)

    def flags(self, values: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if scan_hex(text) is None:
            return False
        values[key] = (scan_hex(text), by)
        return True

    def actor(self, r: Record, v: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if key == "typeflags":
            return self.flags(v, key, text, by)
        if key in ("health", "maxhealth", "maxthrust", "maxrotthrust", "jumpspeed"):
            if atof(text) < 0:
                return False
            v[key] = (atof(text), by)
            if key == "health" and ("maxhealth" not in v or v["maxhealth"][0] <= atof(text)):
                v["maxhealth"] = (atof(text), by)
            if key == "maxhealth":
                v["health"] = (atof(text), by)
            return True
        if key in ("weapon", "weapon2", "explode"):
            v[key] = (self.named(text), by)
            return True
        if key in ("eyeoffset", "fireoffset", "lightoffset"):
            if scan_bracket(text, "//") is None:
                return False
            v[key] = (scan_bracket(text, "//"), by)
            if key == "lightoffset":
                self.switch(r.general, "thingflags", 0x1, by)
            return True
        if key in ("lightintensity", "minheadpitch", "maxheadpitch", "error", "fov", "chance"):
            v[key] = (atof(text), by)
            if key == "lightintensity":
                self.switch(r.general, "thingflags", 0x1, by)
            return True
        return False

    def weapon(self, r: Record, v: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if key in ("typeflags", "damageclass"):
            self.flags(v, key, text, by)
            return True
        if key in ("damage", "mindamage", "force", "range", "rate", "elementsize", "trailcylradius", "trailrandangle"):
            v[key] = (atof(text), by)
            return True
        if key in ("explode", "fleshhit", "trailthing"):
            v[key] = (self.named(text), by)
            return True
        return False

    def item(self, r: Record, v: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if key == "typeflags":
            return self.flags(v, key, text, by)
        if key in ("respawn", "respawnfactor"):
            v[key] = (atof(text), by)
            return True
        return False

    def explosion(self, r: Record, v: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if key in ("typeflags", "damageclass"):
            return self.flags(v, key, text, by)
        bits = {"damage": 0x6, "blasttime": 0x2, "force": 0x2, "range": 0x2, "maxlight": 0x10}
        if key in bits:
            v[key] = (atof(text), by)
            self.switch(v, "typeflags", bits[key], by)
            return True
        if key == "flashrgb":
            if scan_bracket(text, "//", whole=True) is None:
                return False
            v[key] = (scan_bracket(text, "//", whole=True), by)
            return True
        if key == "debris":
            pieces, writer = v.get(key, ((), by))
            if len(pieces) < 4 and self.named(text) is not None:
                v[key] = ((*pieces, text), writer)
            return True
        return False

    def particle(self, r: Record, v: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if key == "typeflags":
            return self.flags(v, key, text, by)
        if key in ("maxthrust", "range", "rate", "elementsize", "minsize", "pitchrange", "yawrange"):
            v[key] = (atof(text), by)
            return True
        if key == "count":
            v[key] = (atoi(text), by)
            return True
        if key == "material":
            v[key] = (text, by)
            return True
        return False

    def physics(self, v: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if key == "physflags":
            return self.flags(v, key, text, by)
        least = {"surfdrag", "airdrag", "staticdrag", "mass", "height", "maxrotvel", "maxvel", "orientspeed"}
        if key in least or key == "buoyancy":
            if key in least and atof(text) < 0:
                return False
            v[key] = (atof(text), by)
            return True
        if key in ("vel", "angvel"):
            if scan_bracket(text, "//") is None:
                return False
            v[key] = (scan_bracket(text, "//"), by)
            return True
        return False

    def path(self, v: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if key == "numframes":
            if "numframes" in v or atoi(text) < 1:
                return False
            v[key] = (atoi(text), by)
            return True
        if key == "frame":
            frames, writer = v.get(key, ((), by))
            if len(frames) < v.get("numframes", (0, by))[0]:
                values = scan_bracket(text, "//:" + "//")
                if values is None:
                    return False
                v[key] = ((*frames, values), writer)
            return True
        return False

    def ai(self, v: dict[str, Any], key: str, text: str, by: tuple[str, int]) -> bool:
        if key == "numframes":
            if "numframes" in v or atoi(text) == 0:
                return False
            v[key] = (atoi(text), by)
            return True
        if key == "frame":
            frames, writer = v.get(key, ((), by))
            values = scan_bracket(text, "//")
            if len(frames) < v.get("numframes", (0, by))[0] and values is not None:
                v[key] = ((*frames, values), writer)
                return True
        return False
