"""Speed over time of one predicted move."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .motion import GREY, INK, PALE, SPEED, bare


class Move(Protocol):
    """A move that is drawn: time of each pulse in s, speed in each interval in pulses per second."""

    @property
    def seconds(self) -> Sequence[float]: ...

    @property
    def speeds(self) -> Sequence[float]: ...


FORMATS = (".png", ".svg", ".pdf")


def draw_profile(move: Move, title: str, path: Path) -> None:
    """Draw the move into a file of one of FORMATS. Raises OSError."""
    times, speeds = move.seconds, move.speeds
    figure, axes = plt.subplots(figsize=(9, 4), dpi=110, layout="constrained")
    if speeds:
        xs, ys = [t * 1000 for t in times], [*speeds, speeds[-1]]
        axes.fill_between(xs, 0, ys, step="post", color=SPEED, alpha=0.18, linewidth=0)
        axes.step(xs, ys, where="post", color=SPEED, linewidth=1.6)
    axes.set_ylim(0, None)
    axes.set_xlim(0, None)
    finish(figure, axes, "time after the first pulse / ms", title, path)


def finish(figure: Figure, axes: Axes, xlabel: str, title: str, path: Path) -> None:
    """Add labels and frame to a plot of the speed in pps, then save and close it.

    Raises:
        OSError: the file cannot be written.
    """
    axes.set_xlabel(xlabel, fontsize=9, color=GREY)
    axes.set_ylabel("speed / pps", fontsize=9, color=GREY)
    axes.set_title(title, fontsize=11, color=INK, loc="left")
    bare(axes)
    axes.grid(axis="y", color=PALE, linewidth=0.8)
    axes.set_axisbelow(True)
    try:
        figure.savefig(path)
    finally:
        plt.close(figure)
