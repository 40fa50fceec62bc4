"""Pins of the STMC core with idle and reset levels (docs/stmc/README.md, 2 Pins).

"mon" replaces the alarm of other parts: a low level stops the motor (STMC-IN-05).
"""

from __future__ import annotations

from ..motion.codes import GuardPins

INPUTS: dict[str, int] = {
    "rst_n": 1,
    "ext_clk": 0,
    "cs_n": 1,
    "a0": 0,
    "rd_n": 1,
    "wr_n": 1,
    "d_i": 0,
    "l1_n": 1,
    "l2_n": 1,
    "l3_n": 1,
    "l4_n": 1,
    "cnp_n": 1,
    "mon": 1,
}
OUTPUTS: dict[str, int] = {"d_o": 0, "d_oe": 0, "int_n": 1, "s": 0b00000, "hold": 1}
WIDTHS: dict[str, int] = {"d_i": 8, "d_o": 8, "s": 5}
HOST_PINS = ("cs_n", "a0", "rd_n", "wr_n", "d_i")
GUARD = GuardPins(limits=("l1_n", "l2_n"), slow_limits=("l3_n", "l4_n"), alarm="mon", origin="cnp_n")
# Bits of the inputs register and their pins (STMC-INP-01).
INPUT_REGISTER = {7: "cnp_n", 6: "mon", 3: "l1_n", 2: "l2_n", 1: "l3_n", 0: "l4_n"}
