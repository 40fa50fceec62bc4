"""Drawings of boxes and arrows on a grid, with matplotlib: block diagrams and maps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch

EDGE, TEXT, FAINT = "#44505c", "#1c2733", "#5b6875"
FILLS = {"plain": "#eef2f6", "host": "#dbe8f7", "motion": "#dff0e1", "part": "#fdeecb", "pin": "#ffffff"}


@dataclass(frozen=True)
class Box:
    """A box with its centre at column x, row y (rows count downwards).

    Attributes:
        text: lines of text; the first line is bold.
    """

    x: float
    y: float
    text: str
    kind: str = "plain"
    width: float = 1.0
    height: float = 0.6


@dataclass(frozen=True)
class Arrow:
    """An arrow between two boxes, which it refers to by name.

    Attributes:
        via: corners of the arrow between the boxes.
        both: True if the arrow has a head at each end.
    """

    start: str
    end: str
    text: str = ""
    via: Sequence[tuple[float, float]] = ()
    both: bool = False


def _border(box: Box, towards: tuple[float, float]) -> tuple[float, float]:
    """Return the point on the border of a box at which a line towards a place leaves it at a right angle."""
    dx, dy = towards[0] - box.x, towards[1] - box.y
    if abs(dx) <= box.width / 2:
        return towards[0], box.y + (box.height / 2 if dy > 0 else -box.height / 2)
    return box.x + (box.width / 2 if dx > 0 else -box.width / 2), (
        towards[1] if abs(dy) <= box.height / 2 else box.y
    )


def _box(axes: Axes, box: Box) -> None:
    corner = (box.x - box.width / 2, box.y - box.height / 2)
    line = {"linewidth": 0} if box.kind == "pin" else {"linewidth": 0.9, "edgecolor": EDGE}
    style = "round,pad=0,rounding_size=0.06"
    fill = FILLS[box.kind]
    axes.add_patch(FancyBboxPatch(corner, box.width, box.height, boxstyle=style, facecolor=fill, **line))
    head, _, rest = box.text.partition("\n")
    pin = box.kind == "pin"
    rest_style = {"size": 8, "color": TEXT} if pin else {"size": 7, "color": FAINT}
    lines = 1 + rest.count("\n") + 1 if rest else 1
    step = 0.17
    top = box.y - step * (lines - 1) / 2
    weight = "normal" if pin else "bold"
    axes.text(box.x, top, head, ha="center", va="center", size=8, weight=weight, color=TEXT)
    for number, line_text in enumerate(rest.split("\n") if rest else (), 1):
        axes.text(box.x, top + step * number, line_text, ha="center", va="center", **rest_style)


def _arrow(axes: Axes, arrow: Arrow, boxes: Mapping[str, Box]) -> None:
    first, last = boxes[arrow.start], boxes[arrow.end]
    corners = list(arrow.via)
    begin = _border(first, corners[0] if corners else (last.x, last.y))
    end = _border(last, corners[-1] if corners else begin)
    if not corners:
        begin = _border(first, end)
    points = [begin, *corners, end]
    axes.plot(*zip(*points[:-1], strict=True), color=EDGE, linewidth=1, solid_joinstyle="round")
    heads = "<|-|>" if arrow.both else "-|>"
    style = {"arrowstyle": heads, "color": EDGE, "linewidth": 1, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", xy=points[-1], xytext=points[-2], arrowprops=style)
    if arrow.text:
        (x0, y0), (x1, y1) = max(
            zip(points, points[1:], strict=False),
            key=lambda ends: abs(ends[0][0] - ends[1][0]) + abs(ends[0][1] - ends[1][1]),
        )
        flat = abs(y1 - y0) < abs(x1 - x0)
        axes.text(
            (x0 + x1) / 2 + (0 if flat else 0.05),
            (y0 + y1) / 2 - (0.06 if flat else 0),
            arrow.text,
            ha="center" if flat else "left",
            va="bottom" if flat else "center",
            size=7,
            color=FAINT,
        )


def drawing(
    size: tuple[float, float],
    boxes: Mapping[str, Sequence[Any]],
    arrows: Mapping[str, Mapping[str, Any] | None],
) -> plt.Figure:
    """Return the drawing of an entry of figures.yml; raise KeyError for an unknown box.

    Args:
        size: width and height of the drawing; the grid fills the drawing.
        boxes: for each name of a box, the values of Box in order.
        arrows: for each "start -> end", or "start <-> end" (two heads), further values of Arrow.
    """
    named = {name: Box(*values) for name, values in boxes.items()}
    figure = plt.figure(figsize=size)
    axes = figure.add_axes((0.005, 0.01, 0.99, 0.98))
    for words, values in arrows.items():
        start, head, end = words.split()
        _arrow(axes, Arrow(start, end, both=head == "<->", **values or {}), named)
    for box in named.values():
        _box(axes, box)
    every = list(named.values())
    left, right = min(b.x - b.width / 2 for b in every), max(b.x + b.width / 2 for b in every)
    top, bottom = min(b.y - b.height / 2 for b in every), max(b.y + b.height / 2 for b in every)
    axes.set(xlim=(left - 0.05, right + 0.05), ylim=(bottom + 0.08, top - 0.08))
    axes.axis("off")
    return figure
