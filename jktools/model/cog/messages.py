"""The messages that the engine sends and scripts send each other (facts of sithCog in the decompiled engine)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import NamedTuple


class Message(NamedTuple):
    """A message by its name; two names can share an id."""

    id: int
    name: str
    games: frozenset[str]


_SHARED = """
activate=1 activated=1 removed=2 startup=3 timer=4 blocked=5 entered=6 exited=7 crossed=8 sighted=9 damaged=10
arrived=11 killed=12 pulse=13 touched=14 created=15 loading=16 selected=17 deselected=18 autoselect=19 changed=20
deactivated=21 shutdown=22 respawn=23 aievent=24 skill=25 taken=26 user0=27 user1=28 user2=29 user3=30 user4=31
user5=32 user6=33 user7=34 newplayer=35 fire=36 join=37 leave=38 splash=39 trigger=40
"""
_MOTS = "preblock=41 escaped=42 attachkilled=43 playeraction=44 enterbubble=45 exitbubble=46"


def _read(text: str, games: frozenset[str]) -> list[Message]:
    pairs = (word.split("=") for word in text.split())
    return [Message(int(number), name, games) for name, number in pairs]


@cache
def messages_of(game: str) -> Mapping[str, Message]:
    """The messages of a game, by lower-case name."""
    return {m.name: m for m in ALL_MESSAGES if game in m.games}


ALL_MESSAGES = [*_read(_SHARED, frozenset({"jk", "mots"})), *_read(_MOTS, frozenset({"mots"}))]

FROM_PLAYER_OR_WORLD = frozenset(
    {"activate", "entered", "exited", "crossed", "touched", "damaged", "sighted", "blocked", "arrived", "killed"}
)

LAST_SENDABLE = {"jk": 40, "mots": 46}
"""The greatest id that SendMessage and SendMessageEx pass on."""

ONCE = frozenset({"startup", "loading", "shutdown"})
"""Sent once in the life of a level."""

GLOBALS = tuple(f"global{i}" for i in range(16))
"""Variables that all scripts share."""

PARAMETERS = 4
"""What a message carries: GetParam and SetParam take 0 to 3."""
