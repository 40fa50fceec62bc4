"""Tests of the J105 STMC and its board that `make test-gates` runs, and the tests that it omits, with the
reason.
"""

from __future__ import annotations

from cocotb_tests.harness.gate_tests import GENERATOR, PARAMETERS, PartTests

from . import test_board, test_part, test_random

# Clocks and DATASHEET times are tested with the PPMC-104BFP, which has the same blocks.
PART = PartTests(
    test_part,
    frozenset({"test_stmc", "test_random", "test_noise"}),
    test_random,
    {test_random.random_item: (1, 3, 4, 5, 7, 8, 10, 13, 65), test_random.noise_item: (1, 4)},
    frozenset({"f16", "sheet", "d25x8"}),
    not_applicable={
        "test_stmc_parameter_ranges": PARAMETERS,
        "test_scenarios_are_reproducible_and_varied": GENERATOR,
    },
    quick=frozenset({"tb_init"}),
    four_state=frozenset({"stmc_ini_07_build"}),
)
BOARD = PartTests(
    test_board,
    frozenset({"test_board"}),
    builds=frozenset({"f16"}),
    four_state=frozenset({"j105_01_addresses"}),
    not_applicable={"test_j105_parameter_ranges": PARAMETERS},
)
