"""Test bench of the STMC core and the J105 board: functions of their pins.

Names and levels of the pins are those of the golden models.
"""

from __future__ import annotations

from cocotb_tests.harness import Part
from cocotb_tests.harness.isa import STROBES_ISA
from openppmc.model.stmc import pc104_board, pins

STMC = Part.of_model(
    "stmc",
    pins,
    clock="ext_clk",
    lowest={"s": 1},
    idle={"PHASE_IDLE": "s"},
    stages={
        "u_sync": ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "mon"),
        "u_single.u_host.u_bus.u_sync": ("stage.cs_n", "stage.rd_n", "stage.wr_n"),
        "u_single.u_axis.u_ext.u_sync": ("ext_clk",),
    },
)
J105_STMC = Part.of_model("j105_stmc", pc104_board, styles=(STROBES_ISA,), lowest={"s": 1, "drv": 1})
PARTS = (STMC, J105_STMC)
