"""Part at pin level: time, input pins, output edges, reset. A subclass for each part defines its function.

A time is the index of a rising edge of `clk`. Edge 0 is the first edge with rst_n = 1. If an input pin
changes at time t, edge t is the first edge that samples the change. If an output changes at time t, its
register changes at edge t. The cost of a run is proportional to the number of events, not to the number of
cycles.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from types import MappingProxyType
from typing import ClassVar

from .clock import Callback, Edge, EdgeLog, Latency, QuantumCounter, Scheduler, Timebase

# Shared elements of the blocks of a model: phases of an edge of `clk`, set-up, input levels, output
# registers. At an edge, the callbacks of the blocks run in the order of `Phase`. Thus each block reads the
# registers of the other blocks with their values from just before the edge.

SetPin = Callable[[int, str, int], None]


class Phase(IntEnum):
    """Order in which the events at one edge of `clk` are processed."""

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
    """Set-up and services of every block.

    Attributes:
        levels: synchronised input levels that decisions use; on a part with several axes, the levels of one
            axis.
    """

    timebase: Timebase
    latency: Latency
    datasheet: bool
    queue: Scheduler
    log: EdgeLog
    counter: QuantumCounter
    levels: dict[str, int]

    def drive(self, t: int, signal: str, value: int) -> None:
        """Drive a host-side output, which changes `host_pins` cycles after the internal edge t."""
        self.queue.at(t + self.latency.host_pins, Phase.PIN, lambda at: self.log.set(at, signal, value))


class PinRegister:
    """The output registers. They get the internal levels `lag` cycles after a change.

    Args:
        set_pin: set_pin(t, signal, value) sets a pin of the part.
    """

    def __init__(self, queue: Scheduler, lag: int, initial: Mapping[str, int], set_pin: SetPin) -> None:
        self._queue = queue
        self._lag = lag
        self._set_pin = set_pin
        self._last = dict(initial)

    def latch(self, t: int, internal: Mapping[str, int]) -> None:
        """Set the pins, `lag` cycles later, to the internal levels after edge t."""
        for signal, value in internal.items():
            if self._last[signal] != value:
                self._last[signal] = value
                self._queue.at(t + self._lag, Phase.PIN, self._setter(signal, value))

    def _setter(self, signal: str, value: int) -> Callback:
        return lambda now: self._set_pin(now, signal, value)


# Square wave of a phase accumulator. The accumulator adds twice the frequency every cycle; the wave toggles
# at each overflow.


class Square:
    """Square wave, low before the first toggle.

    Toggle n = 1, 2, .. occurs ceil(n * clk_hz / (2 * hz)) cycles after edge `origin`.

    Args:
        clk_hz: frequency of `clk` in Hz.
        hz: frequency of the wave in Hz, 1..clk_hz/4.

    Raises:
        ValueError: hz is out of range.
    """

    def __init__(self, clk_hz: int, hz: int, origin: int = 0) -> None:
        if not 1 <= hz <= clk_hz // 4:
            raise ValueError(f"square wave of {hz} Hz is outside 1 Hz to a quarter of clk_hz ({clk_hz} Hz)")
        self._clk_hz, self._hz, self.origin = clk_hz, hz, origin
        self._n = 1

    @property
    def next_edge(self) -> int:
        """Edge of the next toggle."""
        return self.origin - (-self._n * self._clk_hz // (2 * self._hz))

    @property
    def next_level(self) -> int:
        """Level of the wave from the next toggle on."""
        return self._n & 1

    def advance(self) -> None:
        """Advance to the toggle after the next one."""
        self._n += 1

    def restart(self, origin: int) -> None:
        """Restart the wave at edge `origin` with a low level."""
        self.origin, self._n = origin, 1


class Chip(ABC):
    """One part. The model starts just after the release of reset, before edge 0.

    A subclass defines its pins: INPUTS contains the inputs with their idle levels, WIDTHS the widths of all
    pins with several bits, and HOST_PINS the pins of the bus. If these constants depend on a parameter, the
    subclass sets them before it calls `__init__`.

    Args:
        clk_hz: 8e6..200e6.
        xtal_hz: 1e6..XTAL_MAX.
        timing: "FAST" or "DATASHEET".

    Raises:
        ValueError: a value is out of range.
    """

    XTAL_MAX: ClassVar[int] = 16_000_000

    INPUTS: Mapping[str, int]
    WIDTHS: Mapping[str, int]
    HOST_PINS: ClassVar[tuple[str, ...]]

    def __init__(
        self, clk_hz: int, xtal_hz: int, timing: str, outputs: Mapping[str, int], latency: Latency | None
    ) -> None:
        if timing not in ("FAST", "DATASHEET"):
            raise ValueError(f"timing {timing!r} is neither FAST nor DATASHEET")
        self.datasheet = timing == "DATASHEET"
        self.timebase = Timebase(clk_hz, xtal_hz, self.XTAL_MAX)
        self.latency = latency or Latency()
        self._reset_levels = dict(outputs)
        self._queue = Scheduler()
        self.log = EdgeLog(self._reset_levels)
        self._pins = dict(self.INPUTS)
        self._stage: dict[str, int] = {}

    # ------------------------------------------------------------------ implemented by the part

    @abstractmethod
    def _latch(self, t: int) -> None:
        """Pass the internal levels after edge t to the output registers."""

    @abstractmethod
    def _restart(self) -> None:
        """Create blocks in their reset state."""

    @abstractmethod
    def _released(self, t: int) -> None:
        """Process edge t, the first edge after a reset."""

    @abstractmethod
    def _sample_bus(self, t: int, pins: Mapping[str, int]) -> None:
        """Sample new levels of the bus pins at edge t."""

    @abstractmethod
    def _on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        """Process synchronised levels of all other pins; decisions at edge t use these levels."""

    @abstractmethod
    def _strobe(self, write: bool, reg: int) -> dict[str, int]:
        """Return the levels of the bus pins, except d_i, for an access."""

    # ------------------------------------------------------------------ time

    @property
    def now(self) -> int:
        """Last edge that was simulated; -1 before edge 0 is simulated."""
        return self._queue.now

    @property
    def next_event(self) -> int | None:
        """Edge of the next event that does not depend on an input change, `None` if there is none."""
        return self._queue.next_edge()

    def run_until(self, t: int) -> None:
        """Run all edges up to and including t. Raises ValueError if t is before `now`."""
        queue = self._queue
        if t < queue.now:
            raise ValueError(f"run_until({t}): edge {queue.now} is done")
        queue.run_until(t, self._latch)

    # ------------------------------------------------------------------ pins

    def pins(self, t: int, **levels: int) -> None:
        """Set input levels.

        Edge t is the first edge that samples these levels; later calls for the same t override them. Two
        registers may sample the same pin, for example rd_n, and one of them may miss a change. "stage.rd_n"
        is then the level that the second register samples (for a strobe, the synchroniser). Without
        "stage.rd_n", both registers sample the same level.

        rst_n = 0 is effective immediately; the output edges that it causes have the time t.

        Raises:
            ValueError: edge t was already simulated, a pin is unknown, or a level is out of range.
        """
        inputs, widths = self.INPUTS, self.WIDTHS
        stage = {pin[6:]: levels.pop(pin) for pin in list(levels) if pin.startswith("stage.")}
        for pin, level in levels.items():
            if pin not in inputs:
                raise ValueError(f"no input pin {pin!r}")
            if not 0 <= level < 1 << widths.get(pin, 1):
                raise ValueError(f"level {level} of {pin} is out of range")
        if t <= self._queue.now:
            raise ValueError(f"pins({t}): edge {self.now} is done")
        self.run_until(t - 1)
        if levels.get("rst_n") == 0:
            self._reset(t)
        pins = self._pins
        released = levels.get("rst_n") == 1 and not pins["rst_n"]
        changed = {pin for pin, level in levels.items() if level != pins[pin]}
        pins.update(levels)
        if stage:
            self._stage.update(stage)
            changed.update(stage)
        if released:
            self._released(t)
            self._sample(t, pins)
        elif pins["rst_n"]:
            self._sample(t, changed)

    def _sample(self, t: int, changed: Iterable[str]) -> None:
        """Sample pins at edge t; the blocks receive these levels `input_sync` cycles later."""
        names = set(changed)
        if not names.isdisjoint(self.HOST_PINS):
            self._queue.at(t, Phase.PINS, lambda now: self._sample_bus(now, self._pins))
        if names.difference(self.HOST_PINS):
            self._queue.at(t, Phase.PINS, self._sample_levels)

    def _sample_levels(self, t: int) -> None:
        levels = dict(self._pins)
        self._queue.at(t + self.latency.input_sync, Phase.LEVELS, lambda now: self._on_levels(now, levels))

    def _reset(self, t: int) -> None:
        """Reset the part asynchronously (P104-PORT-03, P2104-PORT-03)."""
        self._queue.clear()
        for signal, level in self._reset_levels.items():
            self.log.set(t, signal, level)
        self._restart()

    # ------------------------------------------------------------------ host

    def write(self, t: int, reg: int, byte: int, strobe: int = 2) -> int:
        """Write a data byte (reg 0) or command byte (reg 1) with a strobe from edge t.

        Returns:
            Edge 0 of P104-BUS-06, which is t + strobe. All pin changes up to and including this edge are set,
            but the edge is not simulated yet.
        """
        levels = self._strobe(True, reg)
        self.pins(t, **levels, d_i=byte)
        self.pins(t + strobe, **self._bus_idle(levels))
        return t + strobe

    def read(self, t: int, reg: int, strobe: int = 4) -> int:
        """Read a register with a strobe from edge t; return d_o at the end of the strobe.

        The next access may begin at t + strobe + 2.
        """
        levels = self._strobe(False, reg)
        self.pins(t, **levels)
        self.run_until(t + strobe - 1)
        value = self.log.levels["d_o"]
        self.pins(t + strobe, **self._bus_idle(levels))
        return value

    def _bus_idle(self, levels: Mapping[str, int]) -> dict[str, int]:
        return {pin: 1 for pin in levels if pin.endswith("_n")}

    # ------------------------------------------------------------------ observable state

    @property
    def edges(self) -> list[Edge]:
        """All output edges up to `now`, in order of time."""
        return self.log.edges

    @property
    def outputs(self) -> Mapping[str, int]:
        """Output levels after edge `now`."""
        return MappingProxyType(self.log.levels)

    @property
    def inputs(self) -> Mapping[str, int]:
        """Input levels that were set last."""
        return MappingProxyType(self._pins)
