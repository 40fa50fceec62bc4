"""Picture of docs/architecture.md: the folders of the tree."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from cocotb_tests.harness.project import ROOT
from openppmc import parts
from scripts.pages.pictures.blocks import EDGE, FAINT, TEXT

LAYERS = (
    ("rtl", "SystemVerilog"),
    ("tb", "benches in C++, SV, C"),
    ("openppmc/model", "golden models"),
    ("openppmc/host", "drivers on the PC"),
    ("openppmc/cli", "command line"),
    ("openppmc/sim", "virtual boards"),
    ("cocotb_tests", "tests on the RTL"),
    ("tests", "tests in Python"),
    ("scripts", "make targets"),
    ("docs", "pages"),
)
SHARED = "#eef2f6"
OWN = "#fdeecb"
IGNORED = {"__pycache__", "img", "wavedrom", "include"}
"""Folders that are not shown: build results, and pictures of pages."""


def modules(folder: str) -> list[str]:
    """Return the modules next to the folders of the package: modules of parts, and shared modules."""
    if not folder.startswith("openppmc/"):
        return []
    return [path.stem for path in sorted((ROOT / folder).glob("*.py")) if not path.stem.startswith("__")]


def rooms(folder: str) -> list[str]:
    """Return the names of the folders in a folder, except empty ones."""
    found = (path for path in sorted((ROOT / folder).glob("*")) if path.is_dir() and path.name not in IGNORED)
    files = {path.name: path.rglob("*") for path in found}
    return [name for name, every in files.items() if any(f.is_file() and f.suffix != ".pyc" for f in every)]


def _lines(names: Sequence[str], width: int) -> str:
    """Return the names as text in lines of at most `width` characters."""
    return textwrap.fill(", ".join(names), width)


def folders() -> Figure:
    """Draw layers as rows and parts as columns; a cell lists folders and, for the package, modules."""
    columns = [row.name for row in parts.folders()]
    widths = [1.95, 2.7, *(1.15 if name in ("ppmc104", "ppmc2104", "stmc") else 1.75 for name in columns)]
    lefts = [sum(widths[:n]) for n in range(len(widths))]
    rows = []
    for folder, what in LAYERS:
        inside = [*rooms(folder), *modules(folder)]
        shared = _lines([name for name in inside if name not in columns], 34)
        own = [_lines(rooms(f"{folder}/{name}"), 21) if name in inside else None for name in columns]
        rows.append((folder, what, shared, own))
    heights = [
        max(0.46, 0.19 * max(text.count("\n") + 1 for text in (s, *own) if text is not None) + 0.16)
        for _, _, s, own in rows
    ]
    total = sum(heights) + 0.4
    figure = plt.figure(figsize=(sum(widths) * 0.93, total * 0.93))
    axes = figure.add_axes((0.004, 0.005, 0.992, 0.99))
    for left, width, head in zip(lefts[1:], widths[1:], ("shared folders", *columns), strict=True):
        axes.text(left + width / 2, 0.2, head, ha="center", va="center", size=9, weight="bold", color=TEXT)
    y = 0.4
    for (folder, what, shared, own), height in zip(rows, heights, strict=True):
        axes.text(0.04, y + height / 2 - 0.09, f"{folder}/", va="center", size=9, weight="bold", color=TEXT)
        axes.text(0.04, y + height / 2 + 0.1, what, va="center", size=7.5, color=FAINT)
        for left, width, text, colour in zip(
            lefts[1:], widths[1:], (shared, *own), (SHARED, *[OWN] * 9), strict=False
        ):
            if text is None:
                continue
            corner, style = (left + 0.04, y + 0.04), {"facecolor": colour, "edgecolor": EDGE, "lw": 0.6}
            axes.add_patch(Rectangle(corner, width - 0.08, height - 0.08, **style))
            axes.text(left + width / 2, y + height / 2, text, ha="center", va="center", size=7.5, color=TEXT)
        y += height
    axes.set(xlim=(0, sum(widths)), ylim=(total, 0))
    axes.axis("off")
    return figure
