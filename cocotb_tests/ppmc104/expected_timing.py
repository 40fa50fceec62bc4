"""Expected values of the PPMC-104 tests: initialisations, and the formulas of the motion core."""

from __future__ import annotations

from cocotb_tests.harness.axis_driver import (
    NO_PULSES_DONE,
    STEPS,
    Ramp,
    bytes_of,
    differences,
    forced,
    indices,
    low_times,
    offsets,
    quanta,
    rate,
    rates,
    steps,
)

__all__ = [
    "INIT_A",
    "INIT_B",
    "INIT_EXT",
    "NO_PULSES_DONE",
    "STEPS",
    "STEP_CODES",
    "Ramp",
    "bytes_of",
    "differences",
    "forced",
    "indices",
    "low_times",
    "offsets",
    "quanta",
    "rate",
    "rates",
    "steps",
]

INIT_A = (0x0A, 9, 4, 4)
INIT_B = (0x0A, 19, 9, 10)
# Like INIT_A, but with the external clock and a short ramp of small rates, for tests that control each clock
# edge.
INIT_EXT = (0x1A, 1, 0, 4)

# Initialisation code of each step list, for positive logic; with bit 3 = 0 the logic is negative.
STEP_CODES = {"3 full": 0x09, "3 half": 0x0D, "4 full": 0x0A, "4 half": 0x0E, "5 full": 0x0B, "5 half": 0x0F}
