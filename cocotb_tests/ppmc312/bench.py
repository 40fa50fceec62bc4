"""Test bench of the PPMC-312: bus and build defaults. Names and levels of the pins are those of the golden
model.
"""

from __future__ import annotations

from cocotb_tests.harness import BusStyle, Part
from openppmc.model.ppmc312 import codes

# The bus has eight registers, selected by rs.
STROBES_WE_OE = BusStyle(
    write_on={"cs_n": 0, "we_n": 0},
    write_off={"cs_n": 1, "we_n": 1},
    read_on={"cs_n": 0, "oe_n": 0},
    read_off={"cs_n": 1, "oe_n": 1},
    address="rs",
)
DEFAULTS = {
    "CLK_HZ": 16_000_000,
    "XTAL_HZ": 16_000_000,
    "TIMING": "FAST",
    "VERSION": 0x12,
    "SUM_MODE": "BINARY",
    "SND_LEAD": 1,
    "SND_WAIT": 0,
}

PPMC312 = Part.of_model(
    "ppmc312",
    codes,
    styles=(STROBES_WE_OE,),
    clock="extck",
    defaults=DEFAULTS,
    stages={
        "u_reset.u_pins": ("mode", "mod", "adr"),
        "u_mailbox.u_bus.u_sync": ("cs_n", "we_n", "oe_n", "rs", "d_i"),
        "u_serial.u_rx.u_sync": ("rxd",),
        "u_pins.u_sync": (
            *("auxi", "run", "epin", "epdir", "evt1_n", "evt0_n"),
            *("alm_n", "end_n", "index_n", "org_n", "fhl_n", "bhl_n", "fl_n", "bl_n"),
        ),
        "u_core.u_axis.u_motion.u_interval.u_sync": ("extck",),
    },
)
PARTS = (PPMC312,)
