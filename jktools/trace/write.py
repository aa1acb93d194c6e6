"""Traces on paper: CSV, FreeMat and PNG."""

from __future__ import annotations

import io

import numpy as np

from jktools.engine.arrays import Float64
from jktools.engine.simulation import History
from jktools.trace.recording import Recording

COLUMNS = ("time", *(f"{name}_{axis}" for name in ("thrust", "velocity", "position") for axis in "xyz"))


def rendered(history: History, suffix: str) -> bytes:
    """Give a history in the format of a file's suffix: .csv, .m or .png.

    Raises ValueError for another suffix, ModuleNotFoundError for a .png without matplotlib (extra `plot`).
    """
    writers = {".csv": lambda: to_csv(history).encode(), ".m": lambda: to_freemat(history).encode()}
    writers[".png"] = lambda: to_png(history)
    if suffix.lower() not in writers:
        raise ValueError(f"{suffix or 'no suffix'} names no format: .csv, .m or .png")
    return writers[suffix.lower()]()


def recorded(history: History) -> Recording:
    """Give a simulated history as if it had been logged."""
    return Recording(history.time, history.thrust, history.velocity, history.position)


def to_csv(history: History) -> str:
    """Write every row as CSV, in digits that read back to the same float64."""
    table = np.column_stack([history.time, history.thrust, history.velocity, history.position])
    lines = (",".join(map(repr, row)) for row in table.tolist())
    return "\n".join((",".join((*COLUMNS, "attached")), *map(_with_flag, lines, history.attached.tolist()), ""))


def _with_flag(line: str, attached: bool) -> str:
    return f"{line},{attached:d}"


def to_freemat(history: History) -> str:
    """Write magnitudes over time as a FreeMat script that plots them as the document's drawings do."""
    vectors = {
        "time": history.time,
        "thrust": np.linalg.norm(history.thrust, axis=1),
        "velocity": np.linalg.norm(history.velocity, axis=1),
    }
    text = [f"{name} = [{_numbers(values)}];" for name, values in vectors.items()]
    text += [
        "plot(time, thrust, 'r-', time, velocity, 'b-');",
        "xlabel('seconds');",
        "legend('thrust', 'velocity');",
    ]
    return "\n".join(("% thrust (JKU/s^2) and velocity (JKU/s) over time", *text, ""))


def _numbers(values: Float64) -> str:
    return " ".join(map(repr, values.tolist()))


def to_png(history: History) -> bytes:
    """Draw thrust (red) and velocity (blue) over time. Needs matplotlib; the bytes depend on its version only."""
    # matplotlib takes half a second to import and is an extra: only who draws pays for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: PLC0415
    from matplotlib.figure import Figure  # noqa: PLC0415

    figure = Figure(figsize=(9, 5), dpi=100, layout="constrained")
    axes = figure.add_subplot()
    axes.plot(history.time, np.linalg.norm(history.thrust, axis=1), "r-", label="thrust (JKU/s²)")
    axes.plot(history.time, np.linalg.norm(history.velocity, axis=1), "b-", label="velocity (JKU/s)")
    axes.set_xlabel("seconds")
    axes.grid(visible=True, alpha=0.3)
    axes.legend()
    data = io.BytesIO()
    FigureCanvasAgg(figure).print_figure(data, format="png", metadata={"Software": None})
    return data.getvalue()
