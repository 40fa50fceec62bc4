"""How all plots of the manuals look, and how they become the same SVG on each run."""

from __future__ import annotations

import io
from collections.abc import Callable
from math import sqrt

import matplotlib

matplotlib.use("svg")

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from openppmc.model.motion.ramp import Ramp

# Everything that would make two runs differ is fixed: ids, date, fonts as outlines.
STYLE = {
    "svg.hashsalt": "openppmc",
    "svg.fonttype": "path",
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "savefig.facecolor": "white",
}
BLUE, RED, GREEN, GREY = "#1f5fa8", "#c23b22", "#2b8a3e", "#888888"


def exact_period(of: Ramp, k: float) -> float:
    """x(k) of the ramp formula, in base clocks, not rounded."""
    a, b = (of.rl + 1) ** 2, (of.rh + 1) ** 2
    return 1 / sqrt(1 / a + (1 / b - 1 / a) * k / of.pa)


def svg(figure: Figure) -> bytes:
    """The figure as a file; it is closed."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    return buffer.getvalue()


def render(plot: Callable[[], bytes]) -> bytes:
    """The SVG of one plot, in the style of all."""
    with matplotlib.rc_context(STYLE):
        return plot()
