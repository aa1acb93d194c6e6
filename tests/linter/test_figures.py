"""Figures that a message sets against each other."""

from __future__ import annotations

import math
import re

import pytest

from jktools.linter.figures import told_apart
from tests.support.lint import messages as told
from tests.support.scripts import script_findings


@pytest.mark.parametrize(("one", "other", "written"), [
    (0.3, 0.5, ("0.3", "0.5")),
    (1.0, 1.0000004, ("1", "1.0000004")),
    (2.0, 2.0, ("2", "2")),
    (math.nextafter(0.1, 1), 0.1, ("0.10000000000000002", "0.10000000000000001")),
    (math.inf, 20000.0, ("inf", "20000")),
])  # fmt: skip
def test_two_figures_read_differently_where_they_differ(one: float, other: float, written: tuple[str, str]) -> None:
    assert told_apart(one, other) == written


PULSE = ["symbols", "message startup", "message pulse", "end", "code", "startup: SetPulse(0.01999999); return;",
         'pulse: Print("x"); return;', "end"]  # fmt: skip
SMOKE = "smoke none type=particle timer=1 material=m.mat count=9 elementsize=.01 range=.1 minsize=.10000001"


@pytest.mark.parametrize(("messages", "figures"), [
    ([each.message for each in script_findings("JK601", *PULSE)], r"every (\S+) s is set, but a frame takes (\S+) s"),
    (told("JK741", "World templates 4", SMOKE), r"has minsize (\S+), but range (\S+)"),
    (told("JK311", "Sector 0", "CollideBox .1 .5000001 .1 .9 .5 .9"), r"along y from (\S+) down to (\S+), but"),
])  # fmt: skip
def test_messages_tell_near_figures_apart(messages: list[str], figures: str) -> None:
    (message,) = messages
    found = re.search(figures, message)
    assert found is not None
    assert found[1] != found[2]
