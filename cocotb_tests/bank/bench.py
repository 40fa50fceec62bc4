"""Test bench of the bank: builds, and pins whose widths depend on AXES.

Names and levels of the pins are those of the golden model.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace

from cocotb_tests.harness import BusStyle, Config, Part
from openppmc.model.bank import group

WINDOW = BusStyle(
    write_on={"cs_n": 0, "wr_n": 0},
    write_off={"cs_n": 1, "wr_n": 1},
    read_on={"cs_n": 0, "rd_n": 0},
    read_off={"cs_n": 1, "rd_n": 1},
    address="a",
)


def shape(params: Mapping[str, object]) -> SimpleNamespace:
    """Return the pins and their widths for a build."""
    axes, phase_idle = int(str(params["AXES"])), int(str(params["PHASE_IDLE"]))
    return SimpleNamespace(
        INPUTS=group.inputs(axes), OUTPUTS=group.outputs(axes, phase_idle), WIDTHS=group.widths(axes)
    )


BANK = Part.of_shape(
    "bank",
    shape,
    parameters=("CLK_HZ", "XTAL_HZ", "PHASE_IDLE", "AXES"),
    styles=(WINDOW,),
    clock="",
    defaults={"AXES": 32, "PHASE_IDLE": 1},
    idle={"PHASE_IDLE": "s"},
    stages={
        "u_sync": ("alm_n", "cnp_n", "l4_n", "l3_n", "l2_n", "l1_n"),
        "u_window.u_sync": ("cs_n", "rd_n", "wr_n", "a", "d_i"),
    },
)
PARTS = (BANK,)


def build(name: str, axes: int, mhz: int, phase_idle: int = 1) -> Config:
    """Return a build with this number of axes and a 16 MHz crystal."""
    return Config(name, clk_hz=mhz * 1_000_000, phase_idle=phase_idle, extra=(("AXES", axes),))


B8 = build("b8", 8, 16)
B32 = build("b32", 32, 32)
"""A build with 32 axes at the lowest clock frequency for this number of axes: the shortest interval between
pulses is two rounds long.
"""
F100 = build("f100", 32, 100)
B4 = build("b4", 4, 8, phase_idle=0)
"""A build whose round has more cycles than the bank has axes; a quantum of the internal base clock has 2
cycles.
"""
B16 = build("b16", 16, 16)
"""A build in which the interrupt map and MASK have two bytes each."""
B64 = build("b64", 64, 64)
BUILDS = (B8, B32, F100, B4, B64)


def axes_of(config: Config) -> int:
    """Return the parameter AXES of a build."""
    return int(dict(config.extra)["AXES"])


def round_of(config: Config) -> int:
    """Return the round R of a build in cycles (BANK-GEN-01)."""
    return max(axes_of(config), 8)
