"""Test bench of the PPMC-104: functions of its pins. Names and levels of the pins are those of the golden
model.
"""

from __future__ import annotations

from cocotb_tests.harness import Part
from openppmc.model import ppmc104

PPMC104 = Part.of_model(
    "ppmc104",
    ppmc104,
    parameters=("CLK_HZ", "XTAL_HZ", "TIMING", "PHASE_IDLE"),
    lowest={"s": 1},
    idle={"PHASE_IDLE": "s"},
)
PARTS = (PPMC104,)
