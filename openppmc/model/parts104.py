"""What the blocks of the PPMC-104 model share: phases of a clk edge, set-up, input levels, output pins.

P104-PORT-01/02: ports, reset levels, the two-stage synchroniser. Within one clk edge the blocks run in
the order of `Phase`, so that each sees of the others what a register would show just before the edge.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum

from .edges import EdgeLog
from .scheduler import Scheduler
from .timebase import Latency, QuantumCounter, Timebase

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
WIDTHS: dict[str, int] = {"d_i": 8, "auxi": 4}
HOST_PINS = ("a0", "cs_n", "rd_n", "wr_n", "d_i")


class Phase(IntEnum):
    """Order of events within one clk edge."""

    PINS = 0
    BUS = 1
    LEVELS = 2
    QUEUE = 3
    CHOPPER = 4
    BEGIN = 5
    COMMAND = 6
    GUARD = 7
    FLAG = 8
    PULSE = 9
    BASE = 10
    LOW_END = 11
    STORE = 12
    END = 13
    PIN = 14


@dataclass
class Context:
    """Set-up and services that every block gets."""

    timebase: Timebase
    latency: Latency
    datasheet: bool
    queue: Scheduler
    log: EdgeLog
    counter: QuantumCounter
    levels: dict[str, int] = field(default_factory=lambda: dict(INPUTS))

    def drive(self, t: int, signal: str, value: int) -> None:
        """Host-side output: changes `host_pins` clk after the internal edge t."""
        self.queue.at(t + self.latency.host_pins, Phase.PIN, lambda at: self.log.set(at, signal, value))


class MotorPins:
    """The output register of s, pout_n, hold and dir: `motor_pins` clk behind the internal levels."""

    def __init__(self, context: Context, initial: Mapping[str, int]) -> None:
        self._context = context
        self._initial = dict(initial)
        self._last = dict(initial)

    def reset(self) -> None:
        """Reset levels."""
        self._last = dict(self._initial)

    def latch(self, t: int, internal: Mapping[str, int]) -> None:
        """Pass the internal levels after edge t on to the pins."""
        context = self._context
        for signal, value in internal.items():
            if self._last[signal] != value:
                self._last[signal] = value
                at = t + context.latency.motor_pins
                context.queue.at(at, Phase.PIN, lambda now, s=signal, v=value: context.log.set(now, s, v))
