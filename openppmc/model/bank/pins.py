"""Pins of the bank with idle and reset levels. A port of all axes is one number; bit i is axis i, of `s` the
bits 5 i .. 5 i + 4 are its S1 .. S5."""

from __future__ import annotations

from ..motion.excitation import ALL_PHASES
from ..ppmc104.pins import GUARD

HOST_PINS = ("a", "cs_n", "rd_n", "wr_n", "d_i")
SWITCHES = GUARD.all
PHASES = 5
AT_REST = {"pout_n": 1, "dir": 0, "hold": 1}
"""Reset levels of the motor pins of one axis but for `s`."""


def inputs(axes: int) -> dict[str, int]:
    """Idle levels of the inputs."""
    host = {"rst_n": 1, "a": 0, "cs_n": 1, "rd_n": 1, "wr_n": 1, "d_i": 0}
    return host | dict.fromkeys(SWITCHES, (1 << axes) - 1)


def outputs(axes: int, phase_idle: int) -> dict[str, int]:
    """Reset levels of the outputs."""
    motors = {name: ((1 << axes) - 1) * level for name, level in AT_REST.items()}
    phases = sum(ALL_PHASES * phase_idle << PHASES * axis for axis in range(axes))
    return {"d_o": 0, "d_oe": 0, "int_n": 1, **motors, "s": phases}


def widths(axes: int) -> dict[str, int]:
    """Bits of all ports that have more than one."""
    ports = dict.fromkeys((*SWITCHES, *AT_REST), axes)
    return {"a": 10, "d_i": 8, "d_o": 8, "s": PHASES * axes, **ports}
