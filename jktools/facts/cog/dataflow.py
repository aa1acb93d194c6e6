"""What each variable, argument and condition of a script can be, whatever the engine sends it and when.

Two steps. First an *invariant* for each symbol: everything that it starts as and that any reachable assignment gives
it, in whatever order. Then, block by block, what is known more sharply since the handler began or the last time that
other code could run: a sleep, a call, a verb that delivers messages throws that away for what the script assigns.
Both end after a bounded number of rounds, since ends that keep moving are let go (`ranges.widen`, and here: a symbol
that keeps changing falls back on its invariant).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import pairwise
from typing import NamedTuple

from jktools.facts.cog import ranges
from jktools.facts.cog.lowering import Block, Flow, Instruction, Op
from jktools.facts.cog.ranges import ANY, ANY_INT, FALSE, Range
from jktools.facts.cog.stack import is_plain
from jktools.model.cog import values
from jktools.model.cog.program import Program
from jktools.model.cog.values import Value
from jktools.syntax.cog.nodes import Binary, Call, Expression, Name, Node, Unary

MOST_ROUNDS = 12
"""Rounds over the assignments before the ranges of what they give are let go."""
MOST_VISITS = 4
"""Visits of a block before what keeps changing falls back on its invariant."""
MOST_ARRAY_STORES = 100_000
"""Assignments of arrays times symbols before the ranges of all symbols are let go at once."""
LAST_VISIT = 12
"""Visits of a block before everything does."""

_PUSH, _LOAD, _LOAD_AT, _STORE, _STORE_AT, _UNKNOWN, _UNARY, _BINARY, _CALL, _DROP = Op

State = dict[int, Range]
"""What is known more sharply than the invariant, by slot."""


@dataclass(slots=True)
class Known:
    """The result, for one way of binding the symbols."""

    invariant: list[Range]
    """Of each slot, at any time."""
    arguments: dict[Call, tuple[Range, ...]] = field(default_factory=dict)
    """Of each reachable call of a verb, as the verb reads its stack."""
    operands: dict[Node, tuple[Range, ...]] = field(default_factory=dict)
    """Of each reachable operator."""
    conditions: dict[int, Range] = field(default_factory=dict)
    """By block: what decides its way out."""
    stored: dict[Node, Range] = field(default_factory=dict)
    """What each reachable assignment gives its symbol."""
    indices: dict[Node, Range] = field(default_factory=dict)
    """Of each reachable `name[i]`."""
    visited: set[int] = field(default_factory=set)
    """Blocks that can run, as far as the conditions tell."""


def initial_ranges(program: Program, bound: Mapping[int, Value] | None) -> list[Range]:
    """What each slot starts as: with `bound`, the values of one placed script; else those of any."""
    found = []
    for slot in program.slots:
        if slot.text is not None:
            found.append(ranges.A_STRING)
        elif slot.declared is None:
            found.append(ranges.ZERO)
        elif slot.type == "message":
            message = program.vocabulary.messages.get(slot.declared.default or slot.name)
            found.append(ANY_INT if message is None else ranges.of_value(message.id))
        elif bound is not None and slot.index in bound:
            found.append(ranges.of_value(bound[slot.index]))
        elif (bound is None and slot.takes_value) or slot.type not in (
            "int",
            "flex",
            "float",
            "thing",
            "surface",
            "sector",
            "cog",
        ):
            found.append(_of_type(slot.type))
        else:
            found.append(ranges.of_value(default_value(slot.type, slot.declared.default)))
    return found


def _of_type(kind: str) -> Range:
    if kind == "vector":
        return ranges.A_VECTOR
    if kind in ("flex", "float"):
        return ranges.ANY_FLEX
    return ANY_INT


def default_value(kind: str, text: str | None) -> Value:
    """What a symbol without a value of its own starts as; resources are -1 here, since nothing is loaded."""
    if kind == "vector":
        return values.ZERO_VECTOR
    if kind in ("flex", "float"):
        return values.flex(_number(text or "", whole=False))
    if kind in ("int", "thing", "surface", "sector", "cog"):
        return values.int32(int(_number(text or "", whole=True)))
    return -1 if text else 0


def _number(text: str, *, whole: bool) -> float:
    """As C's atoi and atof: the longest start that is a number, 0 without one."""
    at = 1 if text[:1] in ("+", "-") else 0
    allowed = "0123456789" if whole else "0123456789.eE+-"
    while at < len(text) and text[at] in allowed:
        at += 1
    while at:
        try:
            return int(text[:at]) if whole else float(text[:at])
        except ValueError:
            at -= 1
    return 0


def analyse(program: Program, flow: Flow, reachable: Sequence[int], bound: Mapping[int, Value] | None = None) -> Known:
    """Run both steps over the blocks that a handler can reach."""
    blocks = [flow.blocks[i] for i in reachable]
    known = Known(initial_ranges(program, bound))
    if not known.invariant:
        known.invariant.append(ranges.ZERO)  # slot 0 of an empty table, so that nothing else need care
    storing = _storing(blocks, len(known.invariant))
    _invariants(known, storing)
    _Sharpening(program, flow, known, storing.slots).run()
    return known


def state_behind(known: Known, code: Sequence[Instruction], state: State) -> State:
    """What is known behind operations that begin with a state, if nothing else runs in between."""
    found = dict(state)
    _run(code, found, known.invariant, Known(known.invariant), frozenset())
    return found


def ways_out(program: Program, flow: Flow, known: Known, block: Block, state: State) -> list[tuple[int, State]]:
    """Where a block leads that begins with a state, and what is then known, if nothing else runs in between.

    A `call` at its end is taken to change nothing.
    """
    alone = _Sharpening(program, flow, Known(known.invariant), frozenset())
    alone.entry[block.index] = state
    ways = alone.leave(block)
    return ways[1:] if block.callee >= 0 else ways


def _invariants(known: Known, storing: _Storing) -> None:
    invariant = known.invariant
    rounds = MOST_ROUNDS if storing.arrays * len(invariant) < MOST_ARRAY_STORES else 0
    before: list[Range] = []
    for turn in range(rounds):
        changed = {slot for slot, old in enumerate(before) if old != invariant[slot]}
        before = list(invariant)
        for code, read in storing.statements:
            # A statement whose operands are what they were gives what it gave.
            if turn == 0 or read is None or any(before[s] != invariant[s] or s in changed for s in read):
                _run(code, {}, invariant, None, frozenset())
        if turn >= 1:
            for slot, old in enumerate(before):
                if old != invariant[slot]:
                    invariant[slot] = ranges.widen(old, invariant[slot])
        if invariant == before:
            return
    for slot in storing.slots:
        invariant[slot] = ANY


class _Storing(NamedTuple):
    """The assignments of some blocks."""

    statements: list[tuple[list[Instruction], list[int] | None]]
    """The operations of each statement that assigns, with the slots that they read, None where there are arrays."""
    arrays: int
    """How many of the assignments are to arrays."""
    slots: frozenset[int]
    """What some assignment can reach: every slot where there are arrays."""


def _storing(blocks: Sequence[Block], slots: int) -> _Storing:
    storing: list[tuple[list[Instruction], list[int] | None]] = []
    stored: set[int] = set()
    arrays = 0
    for block in blocks:
        # A block can begin with operations of no statement of its own: the step of a `for`.
        for start, end in pairwise([0, *block.starts, len(block.code)]):
            code = block.code[start:end]
            operations = [op for op, _, _ in code]
            written_at = operations.count(_STORE_AT)
            if written_at or _STORE in operations:
                indexed = written_at or _LOAD_AT in operations
                storing.append((code, None if indexed else [slot for op, slot, _ in code if op is _LOAD]))
                stored.update(slot for op, slot, _ in code if op is _STORE)
                arrays += written_at
    return _Storing(storing, arrays, frozenset(range(slots) if arrays else stored))


def _run(
    code: Sequence[Instruction],
    state: State,
    invariant: list[Range],
    known: Known | None,
    lost: frozenset[int],
) -> list[Range]:
    """Carry a state through operations; without `known`, stores widen the invariant instead of the state.

    `lost` are the slots that other code can change. Gives what is left on the stack.
    """
    stack: list[Range] = []
    for op, arg, node in code:
        if op is _LOAD:
            stack.append(state.get(arg) or invariant[arg])
        elif op is _PUSH:
            stack.append(ranges.of_value(arg))
        elif op is _CALL:
            count = len(arg.args)
            held = len(stack)
            given = tuple(stack[held - count :]) if count <= held else (*((ANY,) * (count - held)), *stack)
            del stack[max(held - count, 0) :]
            if known is not None:
                known.arguments[node] = given  # type: ignore[index]
            if arg.delivers:
                for slot in lost.intersection(state):
                    del state[slot]
                stack = [ANY] * len(stack)  # the handlers in between share this stack, and leave things on it
            if arg.returns != "void":
                if arg.pushes != "once":
                    stack = [ANY] * len(stack)  # all below may lie one place higher or lower
                stack.append(ranges.of_result(arg))
        elif op is _BINARY:
            right = stack.pop() if stack else ANY
            left = stack.pop() if stack else ANY
            if known is not None:
                known.operands[node] = (left, right)
            stack.append(ranges.binary(arg, left, right))
        elif op is _STORE:
            value = stack.pop() if stack else ANY
            if known is None:
                old = invariant[arg]
                if old != value:
                    invariant[arg] = ranges.join(old, value)
            else:
                known.stored[node] = value
                state[arg] = value
        elif op is _UNARY:
            operand = stack.pop() if stack else ANY
            if known is not None:
                known.operands[node] = (operand,)
            stack.append(ranges.unary(arg, operand))
        elif op is _LOAD_AT:
            index = stack.pop() if stack else ANY
            if known is not None:
                known.indices[node] = index
            stack.append(_at(arg, index, state, invariant))
        elif op is _STORE_AT:
            value = stack.pop() if stack else ANY
            index = stack.pop() if stack else ANY
            low, high = _span(arg, index, len(invariant))
            if high - low == 1 and known is not None:
                state[low] = value
            elif known is not None:
                for slot in [s for s in state if low <= s < high]:
                    del state[slot]  # the invariant holds the value too
            else:
                for slot in range(low, high):
                    invariant[slot] = ranges.join(invariant[slot], value)
            if known is not None:
                known.indices[node] = index
                known.stored[node] = value
        elif op is _UNKNOWN:
            if arg:
                del stack[max(len(stack) - arg, 0) :]
            stack.append(ANY)
        else:
            del stack[max(len(stack) - arg, 0) :]
    return stack


def _span(base: int, index: Range, slots: int) -> tuple[int, int]:
    """The slots that `name[i]` can mean, those outside the table left out."""
    low, high = ranges.as_int(index)
    return max(0, min(base + low, slots)), max(0, min(base + high + 1, slots))


def _at(base: int, index: Range, state: State, invariant: list[Range]) -> Range:
    """What lies behind the end of the table is the int 0; before its start, and far behind, anything."""
    low, high = ranges.as_int(index)
    if base + low < 0 or base + high >= MOST_SYMBOLS:
        return ANY
    found: Range | None = None
    first, last = _span(base, index, len(invariant))
    for slot in range(first, last):
        value = state.get(slot) or invariant[slot]
        found = value if found is None else ranges.join(found, value)
    if found is None or base + high >= len(invariant):
        return FALSE if found is None else ranges.join(found, FALSE)
    return found


def _is_quiet(block: Block) -> bool:
    """Whether its condition changes nothing while it is computed."""
    for op, arg, _ in block.code[block.starts[-1] :] if block.starts else block.code:
        if op is _STORE or op is _STORE_AT or (op is _CALL and arg.delivers):
            return False
    return True


MOST_SYMBOLS = 256
"""Entries from here on are those that all scripts share."""


class _Sharpening:
    """The second step: a worklist over the blocks, each with what is known where it begins."""

    def __init__(self, program: Program, flow: Flow, known: Known, stored: frozenset[int]) -> None:
        self.program = program
        self.flow = flow
        self.known = known
        self.lost = stored
        """What other code can assign while a handler waits."""
        self.entry: dict[int, State] = {}
        self.visits: dict[int, int] = {}

    def run(self) -> None:
        starts = [self.flow.label_block[h.label] for h in self.program.handlers]
        for start in starts:
            self.entry[start] = {}
        pending = sorted(set(starts))  # a heap: in the order of the text, so that what leads to a block comes first
        waiting = set(pending)
        while pending:
            index = heappop(pending)
            waiting.discard(index)
            for successor, state in self.leave(self.flow.blocks[index]):
                if self.join(successor, state) and successor not in waiting:
                    waiting.add(successor)
                    heappush(pending, successor)

    def leave(self, block: Block) -> list[tuple[int, State]]:
        """Run a block; its ways out, with what is known on each."""
        known = self.known
        known.visited.add(block.index)
        state = dict(self.entry[block.index])
        stack = _run(block.code, state, known.invariant, known, self.lost)
        if block.callee >= 0:
            called = dict(state)
            for slot in self.lost.intersection(state):
                del state[slot]
            return [(block.callee, called), *((s, state) for s in block.successors)]
        if not block.tests:
            return [(s, state) for s in block.successors]
        value = stack[-1] if stack else ANY
        known.conditions[block.index] = value
        holds = ranges.truth(value)
        ways = []
        for successor, outcome in zip(block.successors, (True, False), strict=True):
            if holds is None or holds is outcome:
                refined = self.refine(block.condition, state, outcome) if _is_quiet(block) else state
                if refined is not None:
                    ways.append((successor, refined))
        return ways

    def refine(self, condition: Expression | None, state: State, holds: bool) -> State | None:
        """A state with what a condition tells; None where it cannot have this outcome."""
        if condition is not None and not is_plain(self.program, condition):
            return state
        pending = [(condition, holds)]
        state = dict(state)
        while pending:
            at, outcome = pending.pop()
            if isinstance(at, Unary) and at.op == "!":
                pending.append((at.operand, not outcome))
            elif isinstance(at, Binary) and at.op == ("&&" if outcome else "||"):
                # Both sides were truncated, which changes nothing for what compares.
                pending += [(at.left, outcome), (at.right, outcome)]
            elif isinstance(at, Name):
                if not self.narrow(at, "!=", FALSE, state, outcome):
                    return None
            elif isinstance(at, Binary) and at.op in ranges.MIRROR:
                left, right = self.known.operands[at]
                sides = ((at.left, at.op, right), (at.right, ranges.MIRROR[at.op], left))
                if not all(self.narrow(n, op, other, state, outcome) for n, op, other in sides if isinstance(n, Name)):
                    return None
        return state

    def narrow(self, name: Name, operator: str, other: Range, state: State, holds: bool) -> bool:
        slot = self.program.slot_of.get(name.name)
        if slot is None:
            return True
        old = state.get(slot.index) or self.known.invariant[slot.index]
        new = ranges.refine(operator, old, other, holds=holds)
        if new is None:
            return False
        if new != old:
            state[slot.index] = new
        return True

    def join(self, index: int, state: State) -> bool:
        """Bring a state into the one that a block begins with; whether that changed it."""
        old = self.entry.get(index)
        if old is None:
            self.entry[index] = dict(state)  # the other way out may have the same one
            return True
        changed = False
        visits = self.visits[index] = self.visits.get(index, 0) + 1
        if visits > LAST_VISIT:
            changed = bool(old)
            old.clear()
        for slot in list(old):
            was = old[slot]
            new = state.get(slot)
            if new == was:
                continue
            joined = None if new is None or visits > MOST_VISITS else ranges.join(was, new)
            if joined == was:
                continue
            changed = True
            if joined is None:
                del old[slot]
            else:
                old[slot] = joined
        return changed
