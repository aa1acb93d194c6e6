"""What accuracy costs: time, memory, bytes and error of each pass of a level at each tier.

Time is processor time on one thread, the median of a few measurements, the tiers in turn within one run, so that
ratios hold on a machine that does other things too. Memory is that of a process of its own. Error is against `exact`;
it is the same at every run.
"""

from jktools.tradeoff.measure import Cell, Plan, Row, measure
from jktools.tradeoff.passes import PASSES, TIERS, Asked

__all__ = ["PASSES", "TIERS", "Asked", "Cell", "Plan", "Row", "measure"]
