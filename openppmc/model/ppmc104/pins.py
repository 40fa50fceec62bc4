"""Pins of the PPMC-104 with idle and reset levels (P104-PORT-01)."""

from __future__ import annotations

from ..motion.guard import GuardPins

INPUTS: dict[str, int] = {
    "rst_n": 1,
    "a0": 0,
    "cs_n": 1,
    "rd_n": 1,
    "wr_n": 1,
    "d_i": 0,
    "csel": 1,
    "vsel": 1,
    "clock": 0,
    "l1_n": 1,
    "l2_n": 1,
    "l3_n": 1,
    "l4_n": 1,
    "cnp_n": 1,
    "alm_n": 1,
    "auxi": 0,
}
OUTPUTS: dict[str, int] = {
    "d_o": 0,
    "d_oe": 0,
    "int_n": 1,
    "auxo": 0b1111,
    "aux_n": 1,
    "s": 0b11111,
    "hold": 1,
    "pout_n": 1,
    "dir": 0,
}
WIDTHS: dict[str, int] = {"d_i": 8, "auxi": 4, "d_o": 8, "auxo": 4, "s": 5}
HOST_PINS = ("a0", "cs_n", "rd_n", "wr_n", "d_i")
GUARD = GuardPins(limits=("l1_n", "l2_n"), slow_limits=("l3_n", "l4_n"), alarm="alm_n", origin="cnp_n")
# Levels of the input register (P104-RD-05), bit by bit.
INPUT_REGISTER = {7: "cnp_n", 6: "alm_n", 3: "l1_n", 2: "l2_n", 1: "l3_n", 0: "l4_n"}
