"""Sizes of the host bridges, as synthesized, into docs/benchmarks.md: `python -m scripts.bridges`.

Part of `make report`. No place and route: a bridge runs at the clock rate of the part behind it.
"""

from __future__ import annotations

import sys

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console
from scripts.flow.netlist import Count, flat_counts
from scripts.flow.report import markdown_table
from scripts.flow.synthesis import FAMILIES, run_yosys
from scripts.flow.yosys_job import BEST

BRIDGES = {
    "ppmc_wishbone": "Wishbone B4, with its strobe master",
    "ppmc_axil": "AXI4-Lite, with its strobe master",
    "ppmc_uart_bridge": "UART, with receiver, transmitter and strobe master",
}
FOLDER = project.BUILD / "report" / "bridges"
TEXT = (
    "The host bridges with their default parameters (one address line), as synthesized: written by"
    " `make report`. On ECP5, LUT is LUT4 + 2 · CCU2C, the carry cells."
)


def size(top: str, family: str) -> Count:
    """LUT, FF and block RAM of a bridge by itself."""
    job = {
        "top": top,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in project.files("host")],
        "params": {},
        "family": family,
        "recipe": BEST[family],
        "keep": False,
    }
    return flat_counts(run_yosys(FOLDER / top, job), top, set())[0]


def markdown() -> str:
    """The block of docs/benchmarks.md."""
    heads = [
        "bridge",
        "what it is",
        *(f"{name} {what}" for name in ("ECP5", "iCE40") for what in ("LUT", "FF", "RAM")),
    ]
    rows = []
    for top, what in BRIDGES.items():
        counts = [size(top, family) for family in FAMILIES]
        cells = [f"{figure}" for count in counts for figure in (count.lut, count.ff, count.ram)]
        rows.append([f"`{top}`", what, *cells])
    return f"{TEXT}\n\n{markdown_table(heads, rows, left=2)}"


def write() -> None:
    """Renew the block."""
    project.update_benchmarks("bridges", markdown())
    console.print("written: docs/benchmarks.md, sizes of the bridges")


def main() -> int:
    """Entry point."""
    write()
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
