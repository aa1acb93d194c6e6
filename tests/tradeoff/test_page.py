"""docs/tradeoffs.md says nothing that its figures do not carry."""

from __future__ import annotations

import copy
import math

import pytest

from tools.tradeoff_page import QUERIES, SEED, read
from tools.tradeoff_text import Corpus, page


@pytest.mark.parametrize(
    ("name", "tier", "measure", "value", "claim"),
    [
        ("sight", "balanced", "unlike", 1, "balanced is exact for sight"),
        ("location", "balanced", "wrong_at_edges", 1, "balanced is exact for location"),
        ("visibility", "fast", "refuted", 1, "no segment refutes fast"),
        ("visibility", "balanced", "missed", 1, "balanced misses no pair"),
        ("motion", "exact", "off_most", 0.5, "exact by nothing"),
        ("geometry", "balanced", "moved_most", 1e-9, "vertices are those of the level at balanced"),
    ],
)
def test_a_claim_that_the_figures_do_not_carry_is_refused(
    name: str, tier: str, measure: str, value: float, claim: str
) -> None:
    figures = copy.deepcopy(read())
    page(figures, QUERIES, SEED)
    level = next(each for each in figures.values() if "measures" in each.get(name, {}).get(tier, {}))
    level[name][tier]["measures"][measure] = value
    with pytest.raises(ValueError, match=claim):
        page(figures, QUERIES, SEED)


def test_figures_of_levels_are_put_together() -> None:
    def cell(seconds: float, **measures: float) -> dict[str, object]:
        return {"seconds": seconds, "measures": measures}

    corpus = Corpus({
        "a": {"sight": {"fast": cell(1.0, wrong=1, asked=4), "balanced": cell(2.0, wrong=0, asked=4)}},
        "b": {"sight": {"fast": cell(1.0, wrong=2, asked=4), "balanced": cell(8.0, wrong=0, asked=4)}},
        "c": {"sight": {"fast": cell(5.0, wrong=3, asked=8), "balanced": {"not_measured": "takes long"}}},
        "d": {"sight": {"nothing": "no sector"}},
    })  # fmt: skip
    assert corpus.ratio("sight", "balanced", "fast") == pytest.approx(4.0)
    assert math.isnan(corpus.ratio("sight", "exact", "fast"))
    assert corpus.share("sight", "fast", "wrong", "asked") == 6 / 16
    assert (corpus.total("sight", "fast", "wrong"), corpus.most("sight", "fast", "wrong")) == (6, 3)
    assert (corpus.count("sight", "balanced"), corpus.left_out("sight", "balanced")) == (2, 1)
