"""Common style of all plots of the manuals, and reproducible SVG output."""

from __future__ import annotations

import io
from contextlib import AbstractContextManager
from math import sqrt

import matplotlib

matplotlib.use("svg")

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from openppmc.model.motion.ramp import Ramp

# These settings fix what would differ between runs: ids, the date, fonts (drawn as outlines).
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
COLOURS = {"blue": BLUE, "red": RED, "green": GREEN, "grey": GREY}


def exact_period(of: Ramp, k: float) -> float:
    """Return x(k) of the ramp formula in periods of the base clock, without rounding."""
    a, b = (of.rl + 1) ** 2, (of.rh + 1) ** 2
    return 1 / sqrt(1 / a + (1 / b - 1 / a) * k / of.pa)


def svg(figure: Figure) -> bytes:
    """Return the figure as an SVG file and close it."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    return buffer.getvalue()


def style() -> AbstractContextManager[None]:
    """Return a context manager that applies the common style."""
    return matplotlib.rc_context(STYLE)
