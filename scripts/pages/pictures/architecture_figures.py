"""Pictures of docs/architecture.md: the folders of the tree, the path of a command. PLOTS: all of docs/."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import matplotlib.pyplot as plt
from matplotlib.patches import Rectangle

from cocotb_tests.harness.project import ROOT
from openppmc import parts
from scripts.pages.pictures.blocks import EDGE, FAINT, TEXT, Arrow, Box, draw
from scripts.pages.pictures.board_figure import board
from scripts.pages.pictures.plots import svg

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
"""Folders that are not shown: build results, and the pictures of a page."""


def modules(folder: str) -> list[str]:
    """Return the modules next to the folders of the package: of parts, and shared ones."""
    if not folder.startswith("openppmc/"):
        return []
    return [path.stem for path in sorted((ROOT / folder).glob("*.py")) if not path.stem.startswith("__")]


def rooms(folder: str) -> list[str]:
    """Return the names of the folders in a folder, without empty ones."""
    found = (path for path in sorted((ROOT / folder).glob("*")) if path.is_dir() and path.name not in IGNORED)
    return [
        path.name
        for path in found
        if any(file.is_file() and file.suffix != ".pyc" for file in path.rglob("*"))
    ]


def _lines(names: Sequence[str], width: int) -> str:
    """Return the names on lines of at most `width` characters."""
    return textwrap.fill(", ".join(names), width)


def house() -> bytes:
    """Draw layers downwards and parts to the right; cells have folders, for the package also modules."""
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
            axes.add_patch(
                Rectangle(
                    (left + 0.04, y + 0.04),
                    width - 0.08,
                    height - 0.08,
                    facecolor=colour,
                    edgecolor=EDGE,
                    lw=0.6,
                )
            )
            axes.text(left + width / 2, y + height / 2, text, ha="center", va="center", size=7.5, color=TEXT)
        y += height
    axes.set_xlim(0, sum(widths))
    axes.set_ylim(total, 0)
    axes.axis("off")
    return svg(figure)


def command() -> bytes:
    """Draw the path from host pins to motor pins in a part with one axis (`ppmc_single`)."""
    boxes = {
        "bus": Box(0.55, 0, "bus pins", "pin", 0.9, 0.4),
        "port": Box(2.0, 0, "ppmc_host_port\nstrobes, mailbox", "host", 1.5),
        "command": Box(4.1, 0, "ppmc_command\nchecks, collects", "host", 1.5),
        "pace": Box(6.2, 0, "ppmc_pace\nprocessing times", "host", 1.6),
        "setup": Box(8.3, 0, "ppmc_setup\ninitialised values", "motion", 1.5),
        "meaning": Box(4.1, 1.05, "the part\nmeaning of a byte", "part", 1.5),
        "table": Box(8.3, 1.05, "ppmc_ramp_table\nbuilder + RAM", "motion", 1.5),
        "clocks": Box(0.55, 2.1, "clk", "pin", 0.5, 0.4),
        "ticks": Box(2.0, 2.1, "ppmc_tick_gen\ncycles of the old crystal", "motion", 1.7),
        "switches": Box(0.55, 3.1, "switches,\nclock", "pin", 0.9, 0.4),
        "sync": Box(2.0, 3.1, "ppmc_sync\ntwo flip-flops", "plain", 1.7),
        "axis": Box(
            6.2,
            2.6,
            "ppmc_axis\nbase clock, rate counter,\nramp sequencer, pulse,\nstop guard",
            "motion",
            1.8,
            1.1,
        ),
        "motor": Box(8.7, 2.35, "ppmc_motor_port\nphases, chopper, hold", "motion", 1.75),
        "finish": Box(8.7, 3.15, "ppmc_finish\ninterrupt, responses", "host", 1.75),
        "pins": Box(10.45, 2.35, "s, pout_n,\ndir, hold", "pin", 0.9, 0.5),
        "int": Box(10.45, 3.15, "int_n;\nto the mailbox", "pin", 0.95, 0.5),
    }
    arrows = (
        Arrow("bus", "port", both=True),
        Arrow("port", "command", "byte"),
        Arrow("meaning", "command", both=True),
        Arrow("command", "pace", "action"),
        Arrow("pace", "setup", "init"),
        Arrow("setup", "table", "rates"),
        Arrow("pace", "axis", "start, stops"),
        Arrow("table", "axis", "threshold of a rate", via=((8.3, 1.7), (6.8, 1.7))),
        Arrow("clocks", "ticks"),
        Arrow("ticks", "axis", via=((4.6, 2.1), (4.6, 2.4))),
        Arrow("switches", "sync"),
        Arrow("sync", "axis", via=((4.6, 3.1), (4.6, 2.8))),
        Arrow("axis", "motor", "pulse"),
        Arrow("axis", "finish", "end, cause"),
        Arrow("motor", "pins"),
        Arrow("finish", "int"),
    )
    return svg(draw(boxes, arrows, (10.4, 3.6)))


PLOTS = {"house": house, "command": command, "board": board}
