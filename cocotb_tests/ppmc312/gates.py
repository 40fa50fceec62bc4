"""Selection of the PPMC-312 tests that `make test-gates` runs, with a reason for each omission."""

from __future__ import annotations

from cocotb_tests.harness.gate_tests import COSTLY_BUILDS, GENERATOR, PARAMETERS, PartTests

from . import test_part, test_random

SAME_BLOCKS = (
    "4 to 15 million cycles; p312_serial_sequence and the random hosts of the line have the same blocks"
)
OF_THE_LINE = ("checks", "transactions", "line", "frames", "codes", "motions", "polls", "resets")

PART = PartTests(
    test_part,
    frozenset({"test_ppmc312", "test_random", "test_noise", "test_changes", "test_serial"}),
    test_random,
    {
        test_random.random_item: (2, 3, 4, 5, 6, 8),
        test_random.noise_item: (1, 4, 7),
        test_random.changes_item: (2,),
        test_random.serial_item: (31,),
    },
    frozenset({"f16"}),
    COSTLY_BUILDS,
    not_applicable={
        "test_ppmc312_driver_times_in_range": PARAMETERS,
        "test_scenarios_are_reproducible_and_varied": GENERATOR,
        "test_hosts_are_rich": GENERATOR,
        "test_hosts_on_the_line_are_rich": GENERATOR,
    },
    too_long={
        "tb_transactions": "8 million cycles; the other modules have the same instructions",
        "tb_terminals": "3 million cycles, mostly waits for clear pulses and the current reduction",
        "tb_positions": "1 million cycles; the other modules have positions and their reports, too",
        **{f"tb_serial_{name}": SAME_BLOCKS for name in OF_THE_LINE},
        "tb_checks_motion": "15 million cycles; tb_motion_walks and tb_time_limits have all kinds of moves",
    },
    quick=frozenset(
        {
            "p312_reads_drive_the_bus",
            "p312_write_window_in_any_order",
            "p312_forms_of_the_starts",
            "p312_serial_sequence",
        }
    ),
    four_state=frozenset({"p312_reads_drive_the_bus"}),
)
