"""Tests of the PPMC-2104 that `make test-gates` runs, and the tests that it omits, with the reason."""

from __future__ import annotations

from cocotb_tests.harness.gate_tests import GENERATOR, PARAMETERS, PartTests

from . import test_part, test_random

PART = PartTests(
    test_part,
    frozenset({"test_ppmc2104", "test_random", "test_noise", "test_independent_axes"}),
    test_random,
    {
        test_random.random_item: (1, 2, 4, 7, 9, 10, 11, 25, 27, 38),
        test_random.pair_item: (1, 2),
        test_random.noise_item: (1, 2, 3, 5),
    },
    not_applicable={
        "test_p2104_par_01_ranges": PARAMETERS,
        "test_p2104_port_05_ports": "reads the ports from the source; no simulation",
        "test_scenarios_are_reproducible_and_varied": GENERATOR,
    },
    too_long={
        "p2104_ac_12_largest_ramp": "15 million cycles; p2104_rmp_02_long_ramp_up has the same ramp",
        "p2104_ac_68_ramps_and_two_axes": (
            "12 million cycles in settings; p2104_ac_67_rate_bytes has the comparison"
        ),
    },
    quick=frozenset({"tb_acceptance_errors"}),
    four_state=frozenset({"p2104_ac_22_error_bit", "p2104_ac_28_stops_at_rest"}),
)
