"""Loops that sleep: how often they turn, by the time that a turn takes at least.

How the engine runs a script (sithCogExec_ExecCog, sithCogExec_Call, sithCogExec_Ret and sithCogScript_Tick in the
decompiled engine):

- A script goes on in one place, and remembers 4 to come back to. A message to one that is not idle puts the place where
  it is into one of these, and its handler runs on top. When that ends, the script is what it was before: asleep, until
  the same time. `call` takes one of the same 4.
- Each frame lets the topmost run go on, once its sleep is over, and none below it.
- Where all 4 are taken, a `call` is passed over, and the handler of a message runs in the stead of what goes on: that
  is lost. Where it was a label, the end of the handler leads back to who called it, before the label is done.

So take a loop whose every turn sleeps so many seconds in its own code, and call what one run does between its way in
and its way out a visit:

1. Two passes in a row of a visit lie that far apart: nothing ends a sleep early but what ends the visit.
2. Visits lie inside each other, as runs do: one that begins while another sleeps is over before that goes on.
3. Give each pass but the first of its visit the time since the one before. Two such times overlap only where a run came
   to the loop while another slept in it, so leave out, for each run that did, the one pass that waited for it. The rest
   lie side by side, and each is as long as a turn sleeps.

In t seconds there is thus at most one pass for each visit, one for each message that found the loop asleep and led to
it, and t divided by what a turn sleeps.

What a label sleeps that the loop calls counts only where the call is sure to be made, and nothing can come in the stead
of the label: in a run that finds all 4 places free, for labels that leave one for the next message, so no deeper than
3 calls. A handler that can come twice finds them taken: two runs that sleep in a label have all 4, and the third turns
without a sleep.
"""

from __future__ import annotations

import math
from collections.abc import Set as AbstractSet
from heapq import heappop, heappush

from jktools.facts.cog import ranges
from jktools.facts.cog.dataflow import Known
from jktools.facts.cog.loops import Effort
from jktools.facts.cog.lowering import Block, Flow, Op
from jktools.facts.cog.reach import Reach

SHORTEST_SLEEP = 0.1
"""What a sleep of 0 seconds or less lasts."""
_END = -1


class SleepingLoops:
    """Of one script."""

    def __init__(self, flow: Flow, reach: Reach, known: Known, frame: float, effort: Effort) -> None:
        """`frame` is the least time, in seconds, between two frames: none sleeps for less."""
        self.flow, self.reach, self.known, self.frame, self.effort = flow, reach, known, frame, effort
        self._in_label: dict[tuple[int, int], float] = {}

    def pace(self, header: int, part: frozenset[int], places: int) -> float:
        """The least time that a turn takes by its sleeps; 0 when a turn may not sleep at all.

        A turn is a way from a block of the loop to itself: from `header`, or from any other that stands in its place.
        `places` is how many labels, one inside the other, are sure to be called and to sleep undisturbed.
        """
        lasting = self._sleeps(header, places)
        starts = [(lasting, s) for s in self.flow.blocks[header].successors if s in part]
        return self._search(starts, part - {header}, header, places)

    def _search(self, starts: list[tuple[float, int]], inside: AbstractSet[int], goal: int, places: int) -> float:
        """The least time asleep on a way through blocks to a goal, `_END` for the end of a label's code."""
        blocks = self.flow.blocks
        done: set[int] = set()
        pending = sorted(starts)
        while pending:
            so_far, index = heappop(pending)
            if index == goal:
                return so_far
            if index in done or index not in inside:
                continue
            done.add(index)
            self.effort.add(1)
            so_far += self._sleeps(index, places)
            if goal == _END and blocks[index].returns:
                heappush(pending, (so_far, goal))
            for successor in blocks[index].successors:
                heappush(pending, (so_far, successor))
        return math.inf

    def _sleeps(self, index: int, places: int) -> float:
        """How long a pass of a block sleeps at least, in what it is sure to call too."""
        block = self.flow.blocks[index]
        total = math.fsum(max(least_sleep(seconds), self.frame) for seconds in self._sleep_arguments(block))
        return total + self._sleeps_in(block.callee, places - 1) if block.callee >= 0 and places > 0 else total

    def _sleeps_in(self, entry: int, places: int) -> float:
        """How long the code of a label sleeps at least before it returns; `places` more are sure to be called."""
        key = (entry, places)
        if key not in self._in_label:
            inside = self.known.visited.intersection(self.reach.blocks_from([entry], into_calls=False))
            free = self.effort.is_spent
            self._in_label[key] = 0.0 if free else self._search([(0.0, entry)], inside, _END, places)
        return self._in_label[key]

    def _sleep_arguments(self, block: Block) -> list[ranges.Range]:
        return [
            self.known.arguments[node][0]
            for op, arg, node in block.code
            if op is Op.CALL and arg.name == "sleep" and node in self.known.arguments
        ]

    def asked(self, part: frozenset[int]) -> float:
        """What a turn asks to sleep, at most: all sleeps of a loop together, and of what it calls."""
        blocks = self.flow.blocks
        called = self.reach.blocks_from(blocks[i].callee for i in part if blocks[i].callee >= 0)
        return math.fsum(
            most_sleep(seconds) for i in part | frozenset(called) for seconds in self._sleep_arguments(blocks[i])
        )


def least_sleep(seconds: ranges.Range) -> float:
    """How long `Sleep` asks to sleep at least: 0 or less is 0.1 s."""
    low, high = ranges.as_flex(seconds)
    if low > 0:
        return low
    return SHORTEST_SLEEP if high <= 0 else 0.0


def most_sleep(seconds: ranges.Range) -> float:
    """How long `Sleep` asks to sleep at most."""
    low, high = ranges.as_flex(seconds)
    return high if low > 0 else max(high, SHORTEST_SLEEP)
