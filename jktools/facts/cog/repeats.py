"""Bounds on how often something runs, and how they add up."""

from __future__ import annotations

import math
from typing import NamedTuple

FRAMES_PER_SECOND = 50.0
"""Of the game as it was played."""


class Repeats(NamedTuple):
    """Bounds on how often something runs."""

    per_run: float
    per_second: float
    per_interruption: float = 0.0
    """More for each message that finds it asleep, to a handler from which it can be reached."""
    pause: float = math.inf
    """Seconds that a turn of the loop around it asks to sleep, at most; infinite where no loop that sleeps is."""

    def most(self, runs: float, seconds: float, interruptions: float = 0.0) -> float:
        """The greatest count in so many seconds with so many runs and messages."""
        fixed = runs * self.per_run if runs else 0.0
        return fixed + seconds * self.per_second + (interruptions * self.per_interruption if interruptions else 0.0)

    def times(self, count: float) -> Repeats:
        """For what runs `count` times as often."""
        return self._replace(
            per_run=self.per_run * count,
            per_second=self.per_second * count,
            per_interruption=self.per_interruption * count,
        )

    def plus(self, other: Repeats) -> Repeats:
        """Both together."""
        return Repeats(
            self.per_run + other.per_run,
            self.per_second + other.per_second,
            self.per_interruption + other.per_interruption,
            min(self.pause, other.pause),
        )

    def around(self, inner: Repeats) -> Repeats:
        """For what runs `inner` each time that this runs.

        What goes on by time goes on once at a time: one run of a script goes on, those below it wait.
        """
        if self == NEVER:
            return NEVER
        if math.isinf(self.per_run) or math.isinf(inner.per_run):
            return UNBOUNDED
        if self == ONCE:
            return inner
        again = self.times(inner.per_run)
        return Repeats(
            again.per_run,
            again.per_second + inner.per_second,
            again.per_interruption + inner.per_interruption,
            min(self.pause, inner.pause),
        )


NEVER = Repeats(0.0, 0.0)
ONCE = Repeats(1.0, 0.0)
UNBOUNDED = Repeats(math.inf, 0.0)
