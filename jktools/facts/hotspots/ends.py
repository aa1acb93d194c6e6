"""Between which things a script looks: what the expressions that it hands to a verb can stand for."""

from __future__ import annotations

from typing import Literal, NamedTuple

from jktools.facts.cog.rates import Site
from jktools.facts.cog.stack import written
from jktools.facts.hotspots.runners import Runner
from jktools.facts.hotspots.traces import Leaf, leaves

ANY_TYPE = 0xFFFFFFFF

Kind = Literal["thing", "carrier", "player", "seen", "any"]

_CARRIER = frozenset({"getsenderref"})
_PLAYER = frozenset({"getlocalplayerthing", "jkgetlocalplayer"})
FLOODS = frozenset({"firstthinginview", "firstthingincone"})
NEXT = frozenset({"nextthinginview", "nextthingincone"})


class End(NamedTuple):
    """One thing, or some of a kind, at an end of a sight test."""

    kind: Kind
    """`carrier`: whoever sent the message; `seen`: what FirstThingInView found; `any`: not known."""
    number: int = -1
    """Of a `thing`."""
    mask: int = 0
    """Types of what is `seen`, one bit a type."""


def ends(runner: Runner, site: Site, argument: int) -> frozenset[End]:
    """What an argument of a call can be; empty where it is always none."""
    number = site.arguments[argument].number
    if number is not None:
        return frozenset({End("thing", int(number))}) if number >= 0 else frozenset()
    given = written(runner.analysis.program, site.call)[argument]
    if given is None:
        return frozenset({End("any")})
    found = leaves(runner.analysis, given)
    return frozenset(_end(runner, leaf) for leaf in found if not isinstance(leaf, int) or leaf >= 0)


def _end(runner: Runner, leaf: Leaf) -> End:
    if isinstance(leaf, int):
        return End("thing", leaf)
    verb = runner.analysis.program.verb_of(leaf) if leaf is not None else None
    name = verb.name if verb is not None else ""
    if name in _CARRIER:
        return End("carrier")
    if name in _PLAYER:
        return End("player")
    return End("seen", mask=seen_mask(runner)) if name in FLOODS or name in NEXT else End("any")


def seen_mask(runner: Runner) -> int:
    """The types that the script looks for with FirstThingInView, one bit a type."""
    mask = 0
    for site in runner.analysis.rates.sites:
        if site.verb.name in FLOODS and len(site.arguments) > 3:
            number = site.arguments[3].number
            mask |= ANY_TYPE if number is None else int(number) & ANY_TYPE
    return mask
