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
    stages={
        "u_sync": ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n", "csel", "vsel", "auxi"),
        "u_single.u_host.u_bus.u_sync": ("stage.cs_n", "stage.rd_n", "stage.wr_n"),
        "u_single.u_axis.u_ext.u_sync": ("clock",),
    },
)
PARTS = (PPMC104,)
