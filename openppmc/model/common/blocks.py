"""What the blocks of the models share: phases of a clk edge, set-up, input levels, output registers.

Within one clk edge the blocks run in the order of `Phase`, so that each sees of the others what a register
would show just before the edge.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import IntEnum

from .edges import EdgeLog
from .scheduler import Callback, Scheduler
from .timebase import Latency, QuantumCounter, Timebase

Put = Callable[[int, str, int], None]


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
    RUN = 9
    PULSE = 10
    BASE = 11
    LOW_END = 12
    STORE = 13
    END = 14
    PIN = 15


@dataclass
class Context:
    """Set-up and services that every block gets.

    levels: synchronised input levels as decisions see them; on a part with several axes those of one axis.
    """

    timebase: Timebase
    latency: Latency
    datasheet: bool
    queue: Scheduler
    log: EdgeLog
    counter: QuantumCounter
    levels: dict[str, int]

    def drive(self, t: int, signal: str, value: int) -> None:
        """Host-side output: changes `host_pins` clk after the internal edge t."""
        self.queue.at(t + self.latency.host_pins, Phase.PIN, lambda at: self.log.set(at, signal, value))


class PinRegister:
    """Output registers that follow internal levels `lag` clk later.

    put(t, signal, value): sets a pin of the part.
    """

    def __init__(self, queue: Scheduler, lag: int, initial: Mapping[str, int], put: Put) -> None:
        self._queue = queue
        self._lag = lag
        self._put = put
        self._last = dict(initial)

    def latch(self, t: int, internal: Mapping[str, int]) -> None:
        """Pass the internal levels after edge t on to the pins."""
        for signal, value in internal.items():
            if self._last[signal] != value:
                self._last[signal] = value
                self._queue.at(t + self._lag, Phase.PIN, self._setter(signal, value))

    def _setter(self, signal: str, value: int) -> Callback:
        return lambda now: self._put(now, signal, value)
