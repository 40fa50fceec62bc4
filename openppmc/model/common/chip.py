"""A part at pin level: time, input pins, output edges, reset. What is behind the pins is the part's business.

Time is the index of rising clk edges. A pin change at t is first sampled by edge t; an output edge at t is
the register changing at edge t. Edge 0 is the first one with rst_n = 1. The cost of a run grows with its
events, not with its clk.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import ClassVar

from .blocks import Phase
from .edges import Edge, EdgeLog
from .scheduler import Scheduler
from .timebase import Latency, Timebase

DATA, STATUS, COMMAND = 0, 1, 1


class Chip(ABC):
    """One part.

    clk_hz 8e6..200e6, xtal_hz 1e6..XTAL_MAX, timing "FAST" or "DATASHEET"; ValueError for anything else. The
    model starts just released from reset, before edge 0. Subclasses name their pins in INPUTS (idle
    levels), WIDTHS (bits, where not 1) and HOST_PINS (the bus); where a parameter decides about them, before
    they call `__init__`.
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

    # ------------------------------------------------------------------ for the part

    @abstractmethod
    def _latch(self, t: int) -> None:
        """Pass internal levels after edge t on to the output registers."""

    @abstractmethod
    def _restart(self) -> None:
        """Fresh blocks in their reset state."""

    @abstractmethod
    def _released(self, t: int) -> None:
        """Edge t is the first one after a reset."""

    @abstractmethod
    def _sample_bus(self, t: int, pins: Mapping[str, int]) -> None:
        """Edge t samples new levels of the bus pins."""

    @abstractmethod
    def _see(self, t: int, levels: Mapping[str, int]) -> None:
        """Synchronised levels of the other pins as decisions at edge t use them."""

    @abstractmethod
    def _strobe(self, write: bool, reg: int) -> dict[str, int]:
        """Bus pin levels of an access, without d_i."""

    # ------------------------------------------------------------------ time

    @property
    def now(self) -> int:
        """The last edge that was run, -1 before edge 0."""
        return self._queue.now

    @property
    def next_event(self) -> int | None:
        """The next edge on which anything happens by itself, None if nothing ever will."""
        return self._queue.next_edge()

    def run_until(self, t: int) -> None:
        """Run all edges up to and including t. Raises ValueError if t lies before `now`."""
        queue = self._queue
        if t < queue.now:
            raise ValueError(f"run_until({t}): edge {queue.now} is done")
        queue.run_until(t, self._latch)

    # ------------------------------------------------------------------ pins

    def pins(self, t: int, **levels: int) -> None:
        """Input levels that rising edge t samples first; later calls for the same t overrule.

        Raises ValueError for an edge already run, an unknown pin or a level out of range. rst_n = 0 acts
        at once; its output edges are stamped t.
        """
        inputs, widths = self.INPUTS, self.WIDTHS
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
        if released:
            self._released(t)
            self._sample(t, pins)
        elif pins["rst_n"]:
            self._sample(t, changed)

    def _sample(self, t: int, changed: Iterable[str]) -> None:
        """Edge t samples pins; the levels reach the inside `input_sync` clk later."""
        names = set(changed)
        if not names.isdisjoint(self.HOST_PINS):
            self._queue.at(t, Phase.PINS, lambda now: self._sample_bus(now, self._pins))
        if names.difference(self.HOST_PINS):
            self._queue.at(t, Phase.PINS, self._sample_levels)

    def _sample_levels(self, t: int) -> None:
        levels = dict(self._pins)
        self._queue.at(t + self.latency.input_sync, Phase.LEVELS, lambda now: self._see(now, levels))

    def _reset(self, t: int) -> None:
        """Asynchronous reset (P104-PORT-03, P2104-PORT-03)."""
        self._queue.clear()
        for signal, level in self._reset_levels.items():
            self.log.set(t, signal, level)
        self._restart()

    # ------------------------------------------------------------------ host

    def write(self, t: int, reg: int, byte: int, strobe: int = 2) -> int:
        """Write cycle: strobe from edge t, data byte (reg 0) or command byte (reg 1).

        Returns edge 0 of P104-BUS-06 = t + strobe, up to which the pins are set; edge 0 is not run yet.
        """
        levels = self._strobe(True, reg)
        self.pins(t, **levels, d_i=byte)
        self.pins(t + strobe, **self._bus_idle(levels))
        return t + strobe

    def read(self, t: int, reg: int, strobe: int = 4) -> int:
        """Read cycle: strobe from edge t; returns d_o at its end. The next access may begin at
        t + strobe + 2."""
        levels = self._strobe(False, reg)
        self.pins(t, **levels)
        self.run_until(t + strobe - 1)
        value = self.log.levels["d_o"]
        self.pins(t + strobe, **self._bus_idle(levels))
        return value

    def _bus_idle(self, levels: Mapping[str, int]) -> dict[str, int]:
        return {pin: 1 for pin in levels if pin.endswith("_n")}

    # ------------------------------------------------------------------ what there is to see

    @property
    def edges(self) -> list[Edge]:
        """All output edges so far, in time order."""
        return self.log.edges

    @property
    def outputs(self) -> Mapping[str, int]:
        """Output levels after edge `now`."""
        return MappingProxyType(self.log.levels)

    @property
    def inputs(self) -> Mapping[str, int]:
        """Input levels as set last."""
        return MappingProxyType(self._pins)
