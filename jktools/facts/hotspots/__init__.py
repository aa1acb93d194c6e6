"""What tests of sight cost a level, script by script."""

from jktools.facts.hotspots.hotspots import Cost, Hotspot, Scene
from jktools.facts.hotspots.runners import (
    Runner,
    class_scripts,
    game_runners,
    game_scripts,
    mentions_sight,
    runners,
    with_created,
)
from jktools.facts.hotspots.summary import CostSummary, frequency, mean_work, summarise_costs
from jktools.facts.hotspots.verdicts import Verdict, Verdicts
from jktools.facts.hotspots.work import Place, SightWork, Work

__all__ = [
    "Cost", "CostSummary", "Hotspot", "Place", "Runner", "Scene", "SightWork", "Verdict", "Verdicts", "Work",
    "class_scripts", "frequency", "game_runners", "game_scripts", "mean_work", "mentions_sight", "runners",
    "summarise_costs", "with_created",
]  # fmt: skip
