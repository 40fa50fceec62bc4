"""Speed over time of all axes in a capture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

from .motion import INK, SPEED
from .profile import FORMATS, finish

__all__ = ["FORMATS", "draw_capture"]
OTHERS = ("#c26a1b", "#7a4fa3", "#2f9e6e")


def draw_capture(moves: Sequence[tuple[int, Sequence[Sequence[int]]]], title: str, path: Path) -> None:
    """Draw the moves in a capture.

    Args:
        moves: number of each axis, and the times of the pulses of its moves in ps.
        path: file of one of FORMATS.

    Raises:
        OSError: the file cannot be written.
    """
    figure, axes = plt.subplots(figsize=(10, 4.2), dpi=110, layout="constrained")
    for number, (axis, of_axis) in enumerate(moves):
        colour = (SPEED, *OTHERS)[number % 4]
        label = f"axis {axis}" if len(moves) > 1 else None
        for run in of_axis:
            xs = [t / 1e9 for t in run]
            ys = [1e12 / (b - a) for a, b in zip(run, run[1:], strict=False)]
            if not ys:
                axes.plot([xs[0]], [0], marker="|", color=colour, markersize=9, label=label)
                label = None
                continue
            ys.append(ys[-1])
            axes.fill_between(xs, 0, ys, step="post", color=colour, alpha=0.18, linewidth=0)
            axes.step(
                [xs[0], *xs, xs[-1]], [0, *ys, 0], where="post", color=colour, linewidth=1.4, label=label
            )
            label = None
    axes.set_ylim(0, None)
    if len(moves) > 1:
        axes.legend(frameon=False, fontsize=9, labelcolor=INK)
    finish(figure, axes, "time in the capture / ms", title, path)
