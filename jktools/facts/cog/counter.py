"""How often a run of a handler passes each block, through its loops and the labels that it calls.

A block's passes in `t` seconds with `n` runs of the handler are at most `n * per_run + t * per_second`, and a little
more when messages arrive while the script sleeps. A loop whose end nobody can prove, and which does not sleep in every
turn, makes `per_run` infinite. Why the bounds of loops that sleep hold: `jktools.facts.cog.sleeping`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from jktools.facts.cog.counting import MOST_SEEN, CountingLoops
from jktools.facts.cog.dataflow import Known
from jktools.facts.cog.loops import Effort, components
from jktools.facts.cog.lowering import Flow
from jktools.facts.cog.reach import MOST_FRAMES, Reach
from jktools.facts.cog.repeats import FRAMES_PER_SECOND, NEVER, ONCE, UNBOUNDED, Repeats
from jktools.facts.cog.sleeping import SleepingLoops
from jktools.model.cog.program import Program


class _Loop(NamedTuple):
    header: int
    """-1 for a loop that is entered in several places."""
    tests: Repeats
    """Passes of the header."""
    body: Repeats
    """Passes of each other block, as far as no inner loop holds it."""


class Counter:
    """Counts passes within the code that one start leads to."""

    def __init__(
        self, program: Program, flow: Flow, reach: Reach, known: Known, *, frames: float = FRAMES_PER_SECOND,
        undisturbed: bool = False, most_seen: int = MOST_SEEN,
    ) -> None:  # fmt: skip
        """Count nothing yet; `frames` are the game's a second.

        `undisturbed` takes it that no handler which a verb runs in between starts the list of things in view anew, or
        sets a counter back: the counts are then what is meant, and no longer bounds whatever other scripts do.
        `most_seen` is how many things FirstThingInView can find.
        """
        self.flow = flow
        self.reach = reach
        self.known = known
        self.counting = CountingLoops(program, flow, reach, known, undisturbed=undisturbed, most_seen=most_seen)
        self._effort = Effort()
        self._sleeping = SleepingLoops(flow, reach, known, 1.0 / frames, self._effort)
        self._within: dict[tuple[int, int], Mapping[int, Repeats]] = {}

    def of_handler(self, start: int, *, first: bool = False) -> Mapping[int, Repeats]:
        """Passes of each block in one run of the handler that starts here, through calls too.

        `first` is for one that runs once, and finds no other run of its script unfinished.
        """
        total: dict[int, Repeats] = {}
        level = {start: ONCE}
        for called in range(1 + MOST_FRAMES):
            places = max(MOST_FRAMES - 1 - called, 0) if first else 0
            below: dict[int, Repeats] = {}
            for entry, count in level.items():
                if self._effort.is_spent:
                    return dict.fromkeys(self.reach.blocks_from([start]), UNBOUNDED)
                for index, inner in self.within(entry, places).items():
                    passes = count.around(inner)
                    total[index] = total[index].plus(passes) if index in total else passes
                    callee = self.flow.blocks[index].callee
                    if callee >= 0:
                        below[callee] = below.get(callee, NEVER).plus(passes)
            level = below
            if not level:
                break
        return total

    def within(self, entry: int, places: int) -> Mapping[int, Repeats]:
        """Passes of each block after one start here, not counting what it calls.

        `places` is how many labels, one inside the other, are sure to be called from here and to sleep undisturbed.
        """
        key = (entry, places)
        if key not in self._within:
            inside = frozenset(i for i in self.reach.blocks_from([entry], into_calls=False) if i in self.known.visited)
            found = dict.fromkeys(sorted(inside), ONCE)
            self._effort.add(len(found))
            pending = [(part, ONCE) for part in components(self.flow.blocks, inside)]
            while pending:
                part, outer = pending.pop()
                loop = self._loop(frozenset(part), inside, outer, entry, places)
                for index in part:
                    found[index] = loop.tests if index == loop.header else loop.body
                if loop.header >= 0:
                    pending += [(p, loop.body) for p in components(self.flow.blocks, frozenset(part), cut=loop.header)]
            self._within[key] = found
        return self._within[key]

    def _loop(self, part: frozenset[int], inside: frozenset[int], outer: Repeats, entry: int, places: int) -> _Loop:
        """How often a loop's header and the rest of it are passed."""
        outside = inside - part
        headers = [i for i in sorted(part) if i == entry or outside.intersection(self.flow.blocks[i].predecessors)]
        if len(headers) != 1:
            return _Loop(-1, UNBOUNDED, UNBOUNDED)
        header = headers[0]
        turns, testing = self.counting.turns(header, part)
        if turns < math.inf:
            again = outer.times(turns + 1)
            return _Loop(header, again, outer.times(turns) if testing == header else again)
        pace = self._sleeping.pace(header, part, places)
        if pace <= 0:
            return _Loop(header, UNBOUNDED, UNBOUNDED)
        asked = min(outer.pause, self._sleeping.asked(part))
        passes = Repeats(outer.per_run, outer.per_second + 1 / pace, outer.per_interruption + 1, asked)
        return _Loop(header, passes, passes)
