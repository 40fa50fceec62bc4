"""Pins of the PPMC-2104 with idle and reset levels (P2104-PORT-01), and how they belong to the axes.

A port of both axes is one number, bit 0 = axis 1. `clk_o` is left out: it never stops and depends on nothing.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..motion.guard import GuardPins

AXES = (0, 1)
INPUTS: dict[str, int] = {
    "rst_n": 1,
    "cs_n": 1,
    "a0": 0,
    "busc": 0,
    "ds_wrs_n": 1,
    "rw_rds_n": 1,
    "d_i": 0,
    "errint_n": 1,
    "run": 0b11,
    "extck": 0,
    "csel": 0b11,
    "fl_n": 0b11,
    "bl_n": 0b11,
    "fhl_n": 0b11,
    "bhl_n": 0b11,
    "org_n": 0b11,
    "alm_n": 0b11,
    "auxi": 0,
}
OUTPUTS: dict[str, int] = {
    "d_o": 0,
    "d_oe": 0,
    "int_n": 1,
    "pout_n": 0b11,
    "dir": 0,
    "hold": 0b11,
    "s1_n": 0b11111,
    "s2_n": 0b11111,
    "auxo": 0b11,
}
HOST_PINS = ("a0", "cs_n", "busc", "ds_wrs_n", "rw_rds_n", "d_i")
GUARD = GuardPins(limits=("fl_n", "bl_n"), slow_limits=("fhl_n", "bhl_n"), alarm="alm_n", origin="org_n")
AXIS_INPUTS = ("run", "extck", "csel", *GUARD.all)
AXIS_OUTPUTS = ("pout_n", "dir", "hold")
WIDTHS: dict[str, int] = {
    **{"d_i": 8, "auxi": 2, "d_o": 8, "s1_n": 5, "s2_n": 5, "auxo": 2},
    **dict.fromkeys((*AXIS_INPUTS, *AXIS_OUTPUTS), 2),
}
# Bits of the control input read (P2104-RD-04).
CONTROL_INPUT_BITS = {7: "org_n", 6: "alm_n", 3: "fl_n", 2: "fhl_n", 1: "bl_n", 0: "bhl_n"}
MOTOR_AT_REST = {"s": 0b11111, "pout_n": 1, "hold": 1, "dir": 0}


def axis_levels(levels: Mapping[str, int], axis: int) -> dict[str, int]:
    """The inputs of one axis (0 or 1) as single bits."""
    return {pin: levels[pin] >> axis & 1 for pin in AXIS_INPUTS}


def strobes(pins: Mapping[str, int]) -> tuple[bool, bool]:
    """Write strobe and read strobe in the bus style that busc selects (P2104-BUS-01, -02)."""
    if pins["cs_n"]:
        return False, False
    first, second = not pins["ds_wrs_n"], bool(pins["rw_rds_n"])
    if pins["busc"]:
        return first and not second, first and second
    return first and second, not first and not second
