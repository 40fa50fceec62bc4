"""Pins of the PMC006B4 with idle and reset levels (docs/pmc006/README.md, 2 Wiring), and services."""

from __future__ import annotations

from dataclasses import dataclass

from ..clock import EdgeLog, Scheduler
from .settings import Settings

# Latencies of the PMC006B4 of this project within the bounds of its rules, all in cycles.


@dataclass(frozen=True)
class CoreTiming:
    """Constants of one core in cycles, except key_ticks.

    Attributes:
        reset: first edge with rst_n = 1 to the first internal edge.
        answer: line: e to the origin of the reply's bit times (<= 8).
        frame: executor: e to the first edge that may accept the frame.
        effect: from there to the effect.
        after: from there to the first edge that may accept anything else (frame + effect + after <= 64).
        fetch: begin of a program instruction to its effect.
        slot: begin of a program instruction to the next one (<= 64).
        key_ticks: keys: µs ticks of a filter in addition to its time.
        job: EEPROM: last tick to the end of a job.
        fact: event to the first edge whose tick may begin a restore.
        program_cleared, program_kept: boot, from one cycle after the last tick: the program is cleared, or
            stays.
        fields: check of the parameters' fields. Storing them takes the same time again.
        trigm: part of the storing time until TRIGM is stored.
        gpo: registers to their pins.
        plan: motion: rise of BUSY to the end of planning.
        step: us tick to mon_step.
        move_end: mon_step of the last step to the fall of BUSY (<= 2).
        run_end: us tick to the fall of BUSY at the end of speed mode.
        grid: drive: cycles between two evaluations of the references.
        grid_from: first internal edge to the first evaluation.
        refs: evaluation to the four references (grid + refs <= 64).
        enable: end of BOOT or change of FREE to the bridges.
        idle: us tick to the end of the idle time.
        force: change of a reference to OFF.
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
    program_cleared: int = 800
    program_kept: int = 1
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
"""Pins that pass two flip-flops, with their levels after a reset.

cmp_a and cmp_b belong to the chopper.
"""


class Ticks:
    """Base clock: tick n (1, 2, ..) enables edge origin + ceil(n * clk_hz / hz) (P006-PAR-01)."""

    def __init__(self, clk_hz: int, hz: int, origin: int = -1) -> None:
        self.clk_hz, self.hz, self.origin = clk_hz, hz, origin

    def edge_of(self, n: int) -> int:
        """Return the edge of tick n."""
        return self.origin - (-n * self.clk_hz // self.hz)

    def first(self, t: int) -> int:
        """Return the number of the first tick at or after edge t; at least 1."""
        return max(1, (t - self.origin - 1) * self.hz // self.clk_hz + 1)


@dataclass
class Services:
    """Services of every block.

    Attributes:
        us: time base of the microsecond ticks.
        settings: registers after the last change that became effective.
    """

    queue: Scheduler
    log: EdgeLog
    clk_hz: int
    us: Ticks
    core_timing: CoreTiming
    settings: Settings
