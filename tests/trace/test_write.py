"""What a trace looks like on paper, and that it reads back."""

from __future__ import annotations

import io

import numpy as np
import pytest

from jktools.engine.simulation import Phase
from jktools.engine.thrust import Keys
from jktools.trace import recording
from jktools.trace.write import rendered, to_csv, to_freemat, to_png
from tests.engine.motion_checks import run

WALK = run([Phase(0, Keys(forward=1)), Phase(0.04, Keys())], 0.06)


def test_csv_reads_back_to_the_bit() -> None:
    log = recording.parse_csv(to_csv(WALK))
    for name in ("time", "thrust", "velocity", "position"):
        assert getattr(log, name).tobytes() == getattr(WALK, name).tobytes()


def test_freemat() -> None:
    # Two ticks of 2 JKU/s^2 with drag 3, then the static threshold 0.3 stops what is left: worked by hand.
    assert to_freemat(WALK).splitlines() == [
        "% thrust (JKU/s^2) and velocity (JKU/s) over time",
        "time = [0.0 0.02 0.04 0.06];",
        "thrust = [0.0 2.0 2.0 0.0];",
        "velocity = [0.0 0.04 0.0776 0.0];",
        "plot(time, thrust, 'r-', time, velocity, 'b-');",
        "xlabel('seconds');",
        "legend('thrust', 'velocity');",
    ]


def test_png_is_a_picture_and_the_same_each_time() -> None:
    pytest.importorskip("matplotlib")
    image = pytest.importorskip("matplotlib.image")
    first, again = to_png(WALK), to_png(WALK)
    assert first == again
    pixels = image.imread(io.BytesIO(first))
    assert pixels.shape[:2] == (500, 900)
    red = (pixels[..., 0] > 0.9) & (pixels[..., 1] < 0.1) & (pixels[..., 2] < 0.1)
    blue = (pixels[..., 2] > 0.9) & (pixels[..., 0] < 0.1) & (pixels[..., 1] < 0.1)
    assert np.count_nonzero(red) > 100 and np.count_nonzero(blue) > 100


def test_formats_by_suffix() -> None:
    assert rendered(WALK, ".CSV").decode() == to_csv(WALK)
    assert rendered(WALK, ".m").decode() == to_freemat(WALK)
    with pytest.raises(ValueError, match="names no format"):
        rendered(WALK, ".gif")
