"""Tests that `make test-verilog` runs for the bank, and the tests that it omits, with the reason."""

from __future__ import annotations

from cocotb_tests.harness.gate_tests import PARAMETERS, PartTests

from . import test_part

PART = PartTests(
    test_part,
    frozenset({"test_bank"}),
    builds=frozenset({"b8", "f100"}),
    why="other numbers of axes and other clocks, in the same blocks",
    not_applicable={"test_bank_gen_02_ranges": PARAMETERS},
    quick=frozenset({"tb_window"}),
    quick_build="b8",
    four_state=frozenset({"bank_win_01_addresses", "bank_win_03_info"}),
    netlists=False,
)
