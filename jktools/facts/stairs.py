"""Flights of stairs: steps down that are each seamless, but follow so fast that a body cannot settle between them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from jktools.engine.integration import steady_speed
from jktools.engine.profile import Engine
from jktools.engine.reattach import walk_down
from jktools.engine.thrust import Keys, player_thrust
from jktools.facts.bodies import Walker
from jktools.facts.ledges import Kind, Ledges

PARALLEL = 0.99
"""Cosine from which on two edges count as steps of one flight."""
MOST_TREAD = 1.0
"""JKU: after a tread as long as this a running body has settled from any step (0.75 s at 0.5 JKU/s)."""
MOST_STEPS = 256
LEAST_WIDTH = 0.2
"""JKU: narrower edges are not what bodies go down by."""


@dataclass(frozen=True, slots=True)
class Flight:
    """Steps down one after another, from the highest."""

    rows: tuple[int, ...]
    """Of `Ledges`."""
    drops: tuple[float, ...]
    treads: tuple[float, ...]
    """After each step, JKU; the last counts as endless."""
    gives_way: int
    """The first step at which the body falls."""
    gait: str
    speed: float
    """JKU/s."""


def speeds(walker: Walker, engine: Engine) -> dict[str, float]:
    """How fast a player goes on a floor, JKU/s: where drag balances thrust."""
    found = {}
    for name, keys in (("walk", Keys(forward=1.0)), ("run", Keys(forward=1.0, run=True))):
        thrust = float(np.linalg.norm(player_thrust(walker.body, keys, engine=engine)))
        found[name] = float(steady_speed(thrust, walker.body.surfdrag))
    return found


def falling_flights(ledges: Ledges) -> list[Flight]:
    """The flights on which a player falls although each step alone is seamless, at the slowest gait that does."""
    engine, walker = ledges.engine, ledges.walker
    flights = list(_flights(ledges))
    openjk = engine is Engine.OPENJKDF2
    found = []
    for rows, drops, treads in flights:
        for gait, speed in speeds(walker, engine).items():
            if not 0 < speed < np.inf:
                continue
            judged = walk_down(
                drops, treads, speed, walker.reattach(engine),
                edge_limit=walker.hover(engine) if openjk else np.inf,
                overhang=walker.body.movesize if openjk else 0.0,
            )  # fmt: skip
            if not judged.seamless.all():
                at = int(np.flatnonzero(~judged.seamless)[0])
                found.append(Flight(rows, drops, treads, at, gait, speed))
                break
    return found


def _flights(ledges: Ledges) -> Iterator[tuple[tuple[int, ...], tuple[float, ...], tuple[float, ...]]]:
    """Chains of steps, each from the first step that no other leads to."""
    even = np.abs(ledges.drop_start - ledges.drop_end) <= 0.01
    between = ledges.of_level & (ledges.below >= 0) & (ledges.kind == Kind.SEAMLESS) & ~ledges.narrow
    steps = np.flatnonzero(between & even & (ledges.least > 0) & (ledges.length >= LEAST_WIDTH)).tolist()
    here, there = ledges.edges.ends(ledges.edge)
    along = there - here
    out = np.stack([along[:, 1], -along[:, 0]], axis=1)
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-12)
    middle = here + along * ((ledges.start + ledges.end) / 2)[:, None]
    by_floor: dict[int, list[int]] = defaultdict(list)
    surface, below = ledges.surface, ledges.below
    for row in steps:
        by_floor[int(surface[row])].append(row)
    after: dict[int, tuple[int, float]] = {}
    for row in steps:
        ways = []
        for other in by_floor[int(below[row])]:
            tread = float((middle[other, :2] - middle[row, :2]) @ out[row])
            if float(out[row] @ out[other]) >= PARALLEL and 0 < tread <= MOST_TREAD:
                ways.append((tread, other))
        if ways:
            tread, other = min(ways)
            after[row] = (other, tread)
    led_to = {other for other, _ in after.values()}
    for first in steps:
        if first in led_to or first not in after:
            continue
        rows, treads = [first], []
        while rows[-1] in after and len(rows) < MOST_STEPS:
            other, tread = after[rows[-1]]
            rows.append(other)
            treads.append(tread)
        drops = tuple(float(ledges.drop_start[row] + ledges.drop_end[row]) / 2 for row in rows)
        yield tuple(rows), drops, (*treads, 1e6)
