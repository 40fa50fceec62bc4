"""The board top for gate-level tests: its sources, parameters and tests."""

from __future__ import annotations

from pathlib import Path

from cocotb_tests.harness import PARTS, Config, cocotb_items, project
from cocotb_tests.harness.collect import Item

TOP = "ppmc104_carrier"
MODULE = "cocotb_tests.gates.tb_board"
PART_TESTS, PMC006 = "cocotb_tests.gates.tb_parts", "cocotb_tests.pmc006.tb_bits"
# Build with the clock frequency of the bitstream for the iCEBreaker.
B24 = Config("b24m", clk_hz=24_000_000)


def sources() -> list[Path]:
    """Return the sources of the part, then the board module and its blocks.

    Tops of boards are not included, because they contain vendor cells.
    """
    return [*project.sources(project.part("ppmc104")), *project.board_files("ppmc104")]


EXACT = "a netlist has no simulation model of ppmc_sync"
"""Reason why these tests do not run with JITTER=1."""


def params(config: Config) -> dict[str, object]:
    """Return the parameters of the board top: those of the part, and the UART as host."""
    return {**config.params, "HOST": "UART"}


def items() -> list[Item]:
    """Return the tests of the board."""
    params = cocotb_items("cocotb_tests.gates", "tb_board", part=PARTS["ppmc104"], exact=EXACT)
    return [param.values[0] for param in params]


def part_test(part: str, config: Config) -> Item:
    """Return the test of a bitstream that contains a part."""
    if part == "pmc006":
        return Item(PMC006, "board_pmc006", config, part, ())
    return Item(PART_TESTS, "board_bank" if part == "bank" else "board_selftest", config, part, ())
