"""Test bench of the PPMC-2104: its two bus styles. Names and levels of the pins are those of the golden
model.
"""

from __future__ import annotations

from cocotb_tests.harness import BusStyle, Part
from openppmc.model.ppmc2104 import codes

# The two styles use the same two pins of the PPMC-2104AFP: as WRS* and RDS*, or as DS* and R/W*.
STROBES_WRS_RDS = BusStyle(
    write_on={"cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": 1},
    write_off={"cs_n": 1, "ds_wrs_n": 1},
    read_on={"cs_n": 0, "ds_wrs_n": 1, "rw_rds_n": 0},
    read_off={"cs_n": 1, "rw_rds_n": 1},
)
# R/W* keeps its level after the strobe, as in a processor that changes it only for the next access.
STROBES_DS_RW = BusStyle(
    write_on={"cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": 0},
    write_off={"cs_n": 1, "ds_wrs_n": 1},
    read_on={"cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": 1},
    read_off={"cs_n": 1, "ds_wrs_n": 1},
)
_LEVELS = ("run", "csel", "org_n", "alm_n", "fl_n", "fhl_n", "bl_n", "bhl_n")
PPMC2104 = Part.of_model(
    "ppmc2104",
    codes,
    # clk_o is free-running and does not depend on any input, so the model omits it
    more={"clk_o": (1, 0)},
    styles=(STROBES_WRS_RDS, STROBES_DS_RW),
    style_pin="busc",
    clock="extck",
    # In ports with one bit per axis, bit 1 belongs to axis 1 and bit 2 to axis 2.
    lowest=dict.fromkeys((*codes.AXIS_INPUTS, *codes.AXIS_OUTPUTS, "s1_n", "s2_n"), 1),
    unwatched=frozenset({"clk_o"}),
    stages={
        "u_sync": (*(f"{pin}[{n}]" for n in (2, 1) for pin in _LEVELS), "busc", "errint_n", "auxi"),
        "u_host.u_bus.u_sync": ("stage.cs_n", "stage.rw_rds_n", "stage.ds_wrs_n"),
        "g_axis[1].u_axis.u_axis.u_ext.u_sync": ("extck[1]",),
        "g_axis[2].u_axis.u_axis.u_ext.u_sync": ("extck[2]",),
    },
)
PARTS = (PPMC2104,)
