"""Pins of the PMC006B4 with idle and reset levels (docs/pmc006/README.md, 2 Wiring).

The module also contains the latencies, the base clock and the services of the blocks.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..clock import EdgeLog, Scheduler
from .settings import Settings

# Latencies of the PMC006B4 core of this project, in cycles. They are within the bounds of the rules.


@dataclass(frozen=True)
class CoreTiming:
    """Constants of one core in cycles, except key_ticks.

    Attributes:
        reset: from the first edge with rst_n = 1 to the first internal edge.
        answer: from e, the edge that samples the last stop bit of a frame, to the edge from which the bit
            times of the reply are counted (<= 8).
        frame: from e to the first edge at which the executor may accept the frame.
        effect: from the edge at which the executor accepts the frame to the effect of the instruction.
        after: from the effect of an instruction to the first edge that may accept another instruction (frame
            + effect + after <= 64).
        fetch: from the start of a program instruction to its effect.
        slot: from the start of a program instruction to the start of the next one (<= 64).
        key_ticks: µs ticks that the filter of a key takes in addition to its time.
        job: from the last tick to the end of a job of the EEPROM engine.
        fact: from the FSET event to the first edge whose tick may begin a restore.
        program_cleared, program_kept: in the boot, from one cycle after the last tick until the program is
            cleared, and until it is kept.
        fields: duration of the check of the parameter fields. Storing the parameters takes the same time
            again.
        trigm: in the boot, from the start of the storage of the parameters to the edge that stores TRIGM.
        gpo: from a change of the output register to the pins.
        plan: from the rising edge of BUSY to the end of planning.
        step: from a us tick to mon_step.
        move_end: from mon_step of the last step to the falling edge of BUSY (<= 2).
        run_end: from a us tick to the falling edge of BUSY at the end of the speed mode.
        grid: between two possible evaluations of the current references.
        grid_from: from the first internal edge to the first possible evaluation of the references.
        refs: from an evaluation to the four reference outputs (grid + refs <= 64).
        enable: from the end of BOOT, or a change of FREE, to the change of the bridge outputs.
        idle: from a us tick to the end of the idle time.
        force: from a change of a reference to the state OFF.
        cmp: from the sampling of a comparator level to its effect (<= 4).
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
"""Pins with a synchroniser of two flip-flops, with the levels of the flip-flops after a reset.

cmp_a and cmp_b are not included, because the chopper synchronises them.
"""


class Ticks:
    """Base clock: tick n (1, 2, ..) is at edge origin + ceil(n * clk_hz / hz) (P006-PAR-01)."""

    def __init__(self, clk_hz: int, hz: int, origin: int = -1) -> None:
        self.clk_hz, self.hz, self.origin = clk_hz, hz, origin

    def edge_of(self, n: int) -> int:
        """Return the edge of tick n."""
        return self.origin - (-n * self.clk_hz // self.hz)

    def first(self, t: int) -> int:
        """Return the number of the first tick at or after edge t; the result is at least 1."""
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
