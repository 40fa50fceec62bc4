"""Sizes of the host bridges and of recorders, into docs/benchmarks.md: `python -m scripts.bridges`.

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

BLOCKS: list[tuple[str, str, dict[str, int], tuple[str, ...]]] = [
    ("ppmc_wishbone", "Wishbone B4, with its strobe master", {}, FAMILIES),
    ("ppmc_axil", "AXI4-Lite, with its strobe master", {}, FAMILIES),
    ("ppmc_uart_bridge", "UART, with receiver, transmitter and strobe master", {}, FAMILIES),
    ("ppmc_recorder", "recorder of a PPMC-104, RECORD=9", {"Width": 49, "AddrBits": 9}, FAMILIES),
    ("ppmc_recorder", "the same, RECORD=12", {"Width": 49, "AddrBits": 12}, ("ecp5",)),
    (
        "ppmc_recorder",
        "the same, RECORD=14, in the 4 SPRAM of a UP5K",
        {"Width": 49, "AddrBits": 14},
        ("ice40",),
    ),
    (
        "ppmc_recorder",
        "recorder of a PPMC-2104 or PPMC-312, RECORD=11",
        {"Width": 63, "AddrBits": 11},
        ("ecp5",),
    ),
]
"""Module, what it is, parameters, families."""
FOLDER = project.BUILD / "report" / "bridges"
TEXT = (
    "The host bridges with their default parameters (one address line), and recorders, which they have with"
    " `RECORD=`, as synthesized: written by `make report`. On ECP5, LUT is LUT4 + 2 · CCU2C, the carry cells."
)


def size(top: str, params: dict[str, int], family: str) -> Count:
    """LUT, FF and block RAM of a block by itself."""
    job = {
        "top": top,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in project.files("host")],
        "params": params,
        "family": family,
        "recipe": BEST[family],
        "keep": False,
    }
    return flat_counts(run_yosys(FOLDER / "-".join([top, *map(str, params.values())]), job), top, set())[0]


def markdown() -> str:
    """The block of docs/benchmarks.md."""
    heads = [
        "bridge",
        "what it is",
        *(f"{name} {what}" for name in ("ECP5", "iCE40") for what in ("LUT", "FF", "RAM")),
    ]
    rows = []
    for top, what, params, families in BLOCKS:
        cells = []
        for family in FAMILIES:
            count = size(top, params, family) if family in families else None
            cells += [str(figure) for figure in (count.lut, count.ff, count.ram)] if count else ["–"] * 3
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
