"""Integrators: what a simulated second costs, and how far each is from the closed form.

Error: worst position error of a frame, JKU, for walk, stop and fall of walkplayer. Cost: evaluations of acceleration
a simulated second, and the measured time of one body stepped alone and of one of 10,000 bodies stepped together.
"""

from __future__ import annotations

import time

import numpy as np

from jktools.engine.integration import TRAITS, Scheme, step
from tools.integration_tradeoff import CASES, FRAME_RATES, front, measure

TOGETHER = 10_000


def seconds_a_step(scheme: Scheme, bodies: int, steps: int) -> float:
    x, v = np.zeros(bodies), np.zeros(bodies)
    started = time.perf_counter()
    for _ in range(steps):
        x, v = step(scheme, x, v, 2.0, 3.0, 0.02)
    return (time.perf_counter() - started) / steps / bodies


def test_integrators() -> None:
    points = {case.name: [measure(s, case, rate) for s in Scheme for rate in FRAME_RATES] for case in CASES}
    print(f"\n{'integrator':<22}{'1/dt':>6}{'evaluations/s':>15}{'us/s alone':>12}{'us/s of 10,000':>16}", end="")
    print("".join(f"{'error ' + case.name:>13}" for case in CASES))
    for i, scheme in enumerate(Scheme):
        alone, together = seconds_a_step(scheme, 1, 2000), seconds_a_step(scheme, TOGETHER, 50)
        for j, rate in enumerate(FRAME_RATES):
            evaluations = TRAITS[scheme].evaluations * rate
            print(
                f"{scheme:<22}{rate:>6}{evaluations:>15}{alone * rate * 1e6:>12.1f}{together * rate * 1e6:>16.3f}",
                end="",
            )
            print("".join(f"{points[case.name][i * len(FRAME_RATES) + j].error:>13.2e}" for case in CASES))
    for case in CASES:
        print(f"\nPareto front, {case.name}: ", end="")
        print(", ".join(f"{p.scheme} at {p.rate} ({p.error:.1e})" for p in front(points[case.name])))
