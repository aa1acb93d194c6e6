"""What a call of HasLOS finds whenever it is asked: always, never, or now this and now that; by profile.

The whole scene is asked, walls and things (`jktools.facts.scene`). What may change the answer makes it vary: ends that
may be elsewhere or gone, surfaces and things on the way that a script may change, and, for what is seen, anything solid
that may come between.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import StrEnum
from itertools import product
from typing import Protocol

from jktools.engine.profile import Engine
from jktools.facts.hotspots.ends import End
from jktools.facts.hotspots.runners import Runner
from jktools.model import Thing

MOST_ASKED = 256
"""Pairs of things that are tried for one call; of more, nothing is said."""


class Verdict(StrEnum):
    """What the tests of a call find."""

    ALWAYS = "always"
    NEVER = "never"
    VARIES = "varies"


class Answer(Protocol):
    """What the scene says of one query as the level is placed."""

    @property
    def is_visible(self) -> bool:
        """Whether it is seen at all times, as far as what stands there goes."""

    @property
    def is_hidden(self) -> bool:
        """Whether it is hidden at all times, as far as what stands there goes."""

    @property
    def blockers(self) -> Sequence[Thing]:
        """The things that hide it; none where a wall does."""


Ask = Callable[[int, int, Engine], "Answer | None"]
"""The scene's answer on two things, by their numbers; None where it has none."""


class Keeps(Protocol):
    """What stays as it is placed."""

    def stays(self, thing: Thing) -> bool:
        """Whether a thing does."""

    def is_clear(self, engine: Engine) -> bool:
        """Whether nothing solid can come into a line of sight."""


class Verdicts:
    """Judges calls of HasLOS in one level."""

    def __init__(self, things: Iterable[Thing], keeps: Keeps, ask: Ask) -> None:
        """`things` are those that are placed."""
        self.by_number = {thing.number: thing for thing in things}
        self.keeps, self.ask = keeps, ask
        self._known: dict[tuple[int, int, Engine], Verdict] = {}

    def of(self, runner: Runner, sides: Sequence[Iterable[End]]) -> Mapping[Engine, Verdict]:
        """What a call finds whose two ends can be these."""
        found = [self._things(runner, side) for side in sides]
        if len(found) != 2 or any(things is None for things in found):
            return dict.fromkeys(Engine, Verdict.VARIES)
        pairs = list(product(*(things for things in found if things is not None)))
        if not 0 < len(pairs) <= MOST_ASKED:
            return dict.fromkeys(Engine, Verdict.VARIES)
        return {engine: _agreed(self._pair(a, b, engine) for a, b in pairs) for engine in Engine}

    def _things(self, runner: Runner, ends: Iterable[End]) -> list[Thing] | None:
        """The things that an end can be; None where one may be elsewhere, or gone, or is not known."""
        found: list[Thing] = []
        for end in ends:
            if end.kind == "thing" and end.number in self.by_number:
                found.append(self.by_number[end.number])
            elif end.kind == "carrier" and runner.cog is None and not runner.more:
                found += runner.things
            else:
                return None
        return found if all(self.keeps.stays(thing) for thing in found) else None

    def _pair(self, a: Thing, b: Thing, engine: Engine) -> Verdict:
        key = (a.number, b.number, engine)
        if key not in self._known:
            self._known[key] = Verdict.ALWAYS if a == b else self._judge(a, b, engine)
        return self._known[key]

    def _judge(self, a: Thing, b: Thing, engine: Engine) -> Verdict:
        answer = self.ask(a.number, b.number, engine)
        if answer is None:
            return Verdict.VARIES
        if answer.is_hidden:
            stays = not answer.blockers or any(self.keeps.stays(thing) for thing in answer.blockers)
            return Verdict.NEVER if stays else Verdict.VARIES
        return Verdict.ALWAYS if answer.is_visible and self.keeps.is_clear(engine) else Verdict.VARIES


def _agreed(verdicts: Iterable[Verdict]) -> Verdict:
    outcomes = set(verdicts)
    return outcomes.pop() if len(outcomes) == 1 else Verdict.VARIES
