"""Pins of the PMC006B4 with idle and reset levels (chapter 1.1), and what its blocks share."""

from __future__ import annotations

from dataclasses import dataclass

from ..common.edges import EdgeLog
from ..common.scheduler import Scheduler
from .pace import Pace
from .settings import Settings

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
