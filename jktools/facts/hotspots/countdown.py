"""Pulses that count themselves down: `count = count - 1; if (!count) SetPulse(0);`.

The handler is run step by step from each value that the variable can have there. Where every run leads to one other
value, and every row of them ends with a run that turns the pulse off, the pulse comes so many times at most for each
time that it is set. Proven for a variable

- whose every assignment in the handler gives one number, on each way through it, before anything else can run;
- that nothing else assigns, but beside a call that sets the pulse, so that each setting begins a row of its own.

Where the pulse is set without the variable, a row may begin anywhere, behind the end of another too: a variable that
then goes on below 0 proves nothing. But for a pulse that is set once, as the level starts.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.dataflow import state_behind, ways_out
from jktools.facts.cog.lowering import Block, Op
from jktools.facts.cog.ranges import Range
from jktools.facts.hotspots.clocks import lets_run, may_wait
from jktools.model.cog.messages import GLOBALS
from jktools.syntax.cog.nodes import Call

MOST_STEPS = 20_000
"""Blocks that are run for one pulse: some thousand values of its variable."""


def most_beats(
    analysis: Analysis, label: str, off: frozenset[Call], setting: Iterable[Call], *, alone: bool, once: bool
) -> float:
    """The most runs of a pulse's handler for each time that the pulse is set; infinite where nothing is proven.

    `off` are the calls in the handler that turn it off, none of which may set it; `setting` those of the script that
    set it, `alone` whether nothing else does. With `once` it is set once at most, before the first run.
    """
    calls = frozenset(setting)
    inside = frozenset(analysis.reach.blocks_from([analysis.flow.label_block[label]]))
    code = [(i, op, arg) for i in analysis.known.visited for op, arg, _ in analysis.flow.blocks[i].code]
    if not off or any(op is Op.STORE_AT for _, op, _ in code):
        return math.inf
    slots = sorted({arg for i, op, arg in code if op is Op.STORE and i in inside})
    shared = {slot.index for slot in analysis.program.slots if slot.name in GLOBALS}
    own = [slot for slot in slots if slot not in shared]
    counting = (_Counting(analysis, label, slot, off, calls, alone=alone, once=once) for slot in own)
    return min((each.beats() for each in counting), default=math.inf)


class _Run(NamedTuple):
    """What the variable is behind a run that began with one value of it."""

    going: frozenset[Range]
    """With the pulse still set."""
    ended: frozenset[Range]


class _Counting:
    def __init__(
        self,
        analysis: Analysis,
        label: str,
        slot: int,
        off: frozenset[Call],
        setting: frozenset[Call],
        *,
        alone: bool,
        once: bool,
    ) -> None:
        self.analysis, self.slot, self.off, self.setting = analysis, slot, off, setting
        self.alone, self.once = alone, once
        self.blocks = analysis.flow.blocks
        self.start = analysis.flow.label_block[label]
        self.inside = frozenset(analysis.reach.blocks_from([self.start]))
        self.label = label
        self.steps = 0

    def beats(self) -> float:
        """The longest row of runs until the pulse is off."""
        starts = self._starts()
        if starts is None:
            return math.inf
        begun, anywhere = starts
        runs: dict[Range, _Run] = {}
        pending = list(begun)
        while pending:
            value = pending.pop()
            if value in runs:
                continue
            run = self._run(value)
            if run is None:
                return math.inf
            runs[value] = run
            pending += run.going | run.ended if anywhere else run.going
        return _longest({value: run.going for value, run in runs.items()})

    # ---- where rows begin

    def _starts(self) -> tuple[set[Range], bool] | None:
        """The values with which rows begin, and whether any that the variable ever has may be one."""
        storing = {i for i in self.analysis.known.visited if any(self._stores(self.blocks[i]))}
        others = (b for h, b in self.analysis.reach.handler_blocks.items() if h != self.label)
        if any(storing & self.inside & blocks for blocks in others):
            return None  # another handler takes steps of its own
        found: set[Range] = set()
        beside: set[Call] = set()
        for index in sorted(storing - self.inside):
            block = self.blocks[index]
            calls = {node for _, _, node in block.code if node in self.setting}
            value = self._set_beside(block) if calls else None
            if value is None:
                return None
            found.add(value)
            beside |= calls
        if self.alone and beside == self.setting:
            return found, False
        first = self.analysis.start_range(self.slot)
        if first.number is None:
            return None
        return found | {first}, not self.once

    def _set_beside(self, block: Block) -> Range | None:
        """The value that a block gives the variable while it sets the pulse; None where others can run in between."""
        at = [k for k, (_, _, node) in enumerate(block.code) if node in self.setting]
        at += self._stores(block)
        between = block.code[min(at) : max(at) + 1]
        if any(op is Op.CALL and lets_run(arg) for op, arg, _ in between):
            return None
        return self._number(state_behind(self.analysis.known, block.code[: max(at) + 1], {}))

    # ---- one run

    def _run(self, value: Range) -> _Run | None:
        """Follow every way through the handler; None where it cannot be told what the variable is behind it."""
        known = self.analysis.known
        going: set[Range] = set()
        ended: set[Range] = set()
        pending = [(self.start, value, False)]
        seen = set(pending)
        while pending:
            index, held, is_off = pending.pop()
            self.steps += 1
            if self.steps > MOST_STEPS:
                return None
            block = self.blocks[index]
            state = {self.slot: held}
            stop = next((k for k, (op, arg, _) in enumerate(block.code) if op is Op.CALL and lets_run(arg)), None)
            code = block.code if stop is None else block.code[:stop]
            is_off |= any(node in self.off for _, _, node in code)
            behind = self._number(state_behind(known, code, state))
            waits = stop is not None or (block.callee >= 0 and may_wait(self.analysis, block.callee))
            if behind is None or (waits and self._assigns_behind(block, stop)) or self._callee_assigns(block):
                return None
            if waits or block.returns:
                (ended if is_off else going).add(behind)
            if waits:
                continue
            for successor, found in ways_out(self.analysis.program, self.analysis.flow, known, block, state):
                number = self._number(found)
                if number is None:
                    return None
                way = (successor, number, is_off)
                if way not in seen:
                    seen.add(way)
                    pending.append(way)
        return _Run(frozenset(going), frozenset(ended))

    def _number(self, state: Mapping[int, Range]) -> Range | None:
        found = state.get(self.slot)
        return found if found is not None and found.number is not None else None

    def _stores(self, block: Block, first: int = 0) -> list[int]:
        return [k for k, (op, arg, _) in enumerate(block.code) if k >= first and op is Op.STORE and arg == self.slot]

    def _callee_assigns(self, block: Block) -> bool:
        return block.callee >= 0 and self._assigned_from([block.callee])

    def _assigns_behind(self, block: Block, stop: int | None) -> bool:
        """Whether the handler assigns the variable once others could run."""
        return (stop is not None and bool(self._stores(block, stop))) or self._assigned_from(block.successors)

    def _assigned_from(self, starts: Sequence[int]) -> bool:
        return any(self._stores(self.blocks[i]) for i in self.analysis.reach.blocks_from(starts))


def _longest(ways: Mapping[Range, frozenset[Range]]) -> float:
    """The most vertices of a way through a graph; infinite where it has a circle."""
    waiting = dict.fromkeys(ways, 0)
    for following in ways.values():
        for each in following:
            waiting[each] += 1
    length = dict.fromkeys(ways, 1)
    ready = [value for value, count in waiting.items() if not count]
    done = 0
    while ready:
        value = ready.pop()
        done += 1
        for each in ways[value]:
            length[each] = max(length[each], length[value] + 1)
            waiting[each] -= 1
            if not waiting[each]:
                ready.append(each)
    return float(max(length.values(), default=1)) if done == len(ways) else math.inf
