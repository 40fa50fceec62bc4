"""Tests of the PPMC-104 that `make test-gates` runs, and the tests that it omits, with the reason."""

from __future__ import annotations

from cocotb_tests.harness.gate_tests import GENERATOR, PARAMETERS, PartTests

from . import test_part, test_random

PART = PartTests(
    test_part,
    frozenset({"test_ppmc104", "test_random", "test_noise"}),
    test_random,
    {
        test_random.random_item: (1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 18, 37, 62),
        test_random.noise_item: (1, 2, 3, 5),
    },
    not_applicable={
        "test_p104_par_01_ranges": PARAMETERS,
        "test_scenarios_are_reproducible_and_varied": GENERATOR,
        "test_a_failing_run_ends_with_a_short_list": GENERATOR,
    },
    quick=frozenset({"tb_acceptance_moves", "tb_bus"}),
    four_state=frozenset({"p104_ac_01_reset_levels", "p104_ac_09_trapezoid", "p104_bus_01_register_map"}),
)
