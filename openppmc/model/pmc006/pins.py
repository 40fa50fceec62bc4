"""Pins of the PMC006B4 with idle and reset levels (chapter 1.1), and what its blocks share."""

from __future__ import annotations

from dataclasses import dataclass

from ..clock import EdgeLog, Scheduler
from .settings import Settings

# How long the PMC006B4 of this project takes inside the windows of its rules, all in clk.


@dataclass(frozen=True)
class Pace:
    """Constants of one core.

    Reset. reset: first edge with rst_n = 1 to the first one that the inside works on.

    Line. answer: e to the origin of the reply's bit times (<= 8).

    Executor. frame: e to the first edge that may take it; effect: from there to the effect, after: from there
    to the first edge that may take anything else (<= 64 together). fetch: begin of a program instruction to
    its effect, slot: to the next one (<= 64).

    Keys. key_ticks: µs ticks of a filter beyond those of the time.

    EEPROM. job: last tick to the end of a job; fact: event to the first edge whose tick may begin a restore.
    Boot, from one clk after the last tick: wiped, kept: the program is cleared, or stays; fields: those of
    the parameters are looked at, and the same again for their storing, of which trigm is TRIGM.

    Pins. gpo: registers to their pins.

    Motion. plan: rise of BUSY to the end of planning. step: us tick to mon_step; move_end: from there to the
    fall of BUSY after the last step (<= 2); run_end: us tick to the fall of BUSY at the end of speed mode.
    Drive. grid: clk between two looks at what the references depend on, grid_from: first of them after the
    first edge inside; refs: look to the four references (grid + refs <= 64). enable: end of BOOT or change
    of FREE to the bridges. idle: us tick to the end of the idle time. force: change of a reference to OFF.
    cmp: sampled level of a comparator to its effect (<= 4).
    """

    reset: int = 2
    answer: int = 0
    frame: int = 2
    effect: int = 2
    after: int = 2
    fetch: int = 5
    slot: int = 48
    key_ticks: int = 1
    job: int = 2
    fact: int = 2
    wiped: int = 800
    kept: int = 1
    fields: int = 152
    trigm: int = 62
    gpo: int = 1
    plan: int = 800
    step: int = 2
    move_end: int = 0
    run_end: int = 0
    grid: int = 32
    grid_from: int = 0
    refs: int = 24
    enable: int = 1
    idle: int = 1
    force: int = 1
    cmp: int = 2


INPUTS: dict[str, int] = {
    "rst_n": 1,
    "rxd": 1,
    "ext1": 1,
    "ext2": 1,
    "fset_n": 1,
    "gpi": 0x1F,
    "adc_data": 0,
    "adc_valid": 0,
    "bemf_level": 0,
    "bemf_valid": 0,
    "cmp_a": 0,
    "cmp_b": 0,
    "scl_i": 1,
    "sda_i": 1,
}
WIDTHS: dict[str, int] = {
    **{"gpi": 5, "adc_data": 10, "bemf_level": 10},
    **{"gpo": 5, "phase_a_ref": 8, "phase_b_ref": 8},
}
OUTPUTS: dict[str, int] = {
    "txd": 1,
    "de": 0,
    "ext1_pu": 1,
    "ext2_pu": 1,
    "gpo": 0,
    "phase_a_ref": 0,
    "phase_a_sign": 0,
    "phase_b_ref": 0,
    "phase_b_sign": 0,
    "pwm_a_ref": 0,
    "pwm_b_ref": 0,
    "bridge_a_en": 0,
    "bridge_b_en": 0,
    "m10": 0,
    "m11": 0,
    "m20": 0,
    "m21": 0,
    "scl_o": 0,
    "scl_oe": 0,
    "sda_o": 0,
    "sda_oe": 0,
    "mon_step": 0,
    "mon_dir": 1,
    "mon_busy": 0,
}
SYNCHRONISED: dict[str, int] = {
    "rxd": 1,
    "ext1": 1,
    "ext2": 1,
    "fset_n": 1,
    "gpi": 0x1F,
    "scl_i": 1,
    "sda_i": 1,
}
"""Pins that pass two flip-flops, and what these show after a reset (cmp_a and cmp_b are the chopper's)."""


class Ticks:
    """A base clock: tick n (1, 2, ..) enables edge origin + ceil(n * clk_hz / hz) (P006-PAR-01)."""

    def __init__(self, clk_hz: int, hz: int, origin: int = -1) -> None:
        self.clk_hz, self.hz, self.origin = clk_hz, hz, origin

    def edge_of(self, n: int) -> int:
        """Edge of tick n."""
        return self.origin - (-n * self.clk_hz // self.hz)

    def first(self, t: int) -> int:
        """Number of the first tick at or after edge t; at least 1."""
        return max(1, (t - self.origin - 1) * self.hz // self.clk_hz + 1)


@dataclass
class Shared:
    """Services that every block gets. us: the microsecond. settings: registers after the last commit."""

    queue: Scheduler
    log: EdgeLog
    clk_hz: int
    us: Ticks
    pace: Pace
    settings: Settings
