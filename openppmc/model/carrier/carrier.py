"""Carrier model: golden part, pulse counters and plants, in virtual time.

The carrier is the `Bus` of the bridge.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from ..chip import Chip
from ..clock import Edge

# Surroundings of the motor: limit, slow-down, origin and alarm switches along one axis.

FARTHEST = 1 << 31
SWITCHES = ("limit_cw", "limit_ccw", "slow_cw", "slow_ccw", "origin", "alarm")
"""Switches in the order of the bridge's PINS byte."""
INDEX_AT = -20
"""Position of one index of the encoder, in pulses.

At this position the cam activates the origin switch, and the position is not at an edge of the cam.
"""


@dataclass(frozen=True)
class Plant:
    """Positions of the switches of an axis, in pulses, CW positive, -2^31 .. 2^31-1.

    Attributes:
        start: position of the motor at the beginning.
        cw, ccw: hard limits, active at positions >= cw and <= ccw.
        slow_cw, slow_ccw: slow-down limits, active at positions >= slow_cw and <= slow_ccw.
        origin: the origin switch is active at positions <= origin; with a cam, only at positions from
            origin_from to origin.
        alarm: first and last position at which the alarm is active.
        index: distance of the encoder's indexes in pulses, with an index at position -20; 0: no index.
        block: position that the shaft cannot pass in direction CW, `None` if there is none. At this position,
            the shaft and its encoder stop, but the pulses continue.
    """

    start: int = 4000
    cw: int = 40000
    ccw: int = -400
    slow_cw: int = 38000
    slow_ccw: int = 600
    origin: int = 0
    alarm: tuple[int, int] | None = None
    origin_from: int = -FARTHEST
    index: int = 0
    block: int | None = None

    def steps(self, position: int, ccw: int) -> bool:
        """Return True if the shaft follows a pulse that is output at this position."""
        return bool(ccw) or self.block is None or position < self.block

    def index_level(self, position: int) -> int:
        """Return the level of the encoder's index, 0 = active."""
        return int(not self.index or (position - INDEX_AT) % self.index != 0)

    def levels(self, position: int) -> dict[str, int]:
        """Return the levels of the switches at a position, 0 = active."""
        alarm = self.alarm is not None and self.alarm[0] <= position <= self.alarm[1]
        return {
            "limit_cw": int(position < self.cw),
            "limit_ccw": int(position > self.ccw),
            "slow_cw": int(position < self.slow_cw),
            "slow_ccw": int(position > self.slow_ccw),
            "origin": int(not self.origin_from <= position <= self.origin),
            "alarm": int(not alarm),
        }


WRITE_STROBE, READ_STROBE, PAUSE = 4, 6, 4
RESET_CLK = 16


P_co = TypeVar("P_co", bound=Chip, covariant=True)


class SwitchPositions(Protocol):
    """Positions of the switches of an axis."""

    @property
    def start(self) -> int:
        """Position of the motor at the beginning."""

    def levels(self, position: int) -> dict[str, int]:
        """Return the levels of the switches at a position."""


class Carrier(ABC, Generic[P_co]):
    """Carrier of a part.

    Each axis has a plant model, whose motor follows `pout_n` and `dir`.

    Attributes:
        t: first edge of `clk` that was not simulated yet.
        positions: positions of the motors.
        counts: values of the pulse counters.
        on_interrupt: called at a falling edge of the pin whose name is INTERRUPT.
        ADDRESS_BITS: number of connected address lines of the bridge.
    """

    ADDRESS_BITS = 1
    INTERRUPT = "int_n"

    def __init__(
        self, part: P_co, plants: Sequence[SwitchPositions], on_interrupt: Callable[[], None]
    ) -> None:
        self.part = part
        self.clk_hz = part.timebase.clk_hz
        self.plants = tuple(plants)
        self.positions = [plant.start for plant in plants]
        self.counts = [0 for _ in plants]
        self.on_interrupt = on_interrupt
        self.t = 8
        self._polled_value: object = None
        self._directions = [0 for _ in plants]
        self._pulse_pins = [1 for _ in plants]
        self._switches = self._levels()
        part.pins(self.t - 4, **self.switch_pins(self._switches))

    @abstractmethod
    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        """Return the input pins of the part for the switch levels of each axis."""

    @abstractmethod
    def straps(self, levels: int) -> None:
        """Set the levels of `straps_o`."""

    @abstractmethod
    def pins(self) -> int:
        """Return the levels of `pins_i`."""

    @property
    def position(self) -> int:
        """Position of the motor of axis 1."""
        return self.positions[0]

    @property
    def seconds(self) -> float:
        """Virtual time in s."""
        return self.t / self.clk_hz

    @abstractmethod
    def watched_register(self) -> object:
        """Return the current content of the register that a host polls during a wait."""

    def _levels(self) -> list[dict[str, int]]:
        return [plant.levels(at) for plant, at in zip(self.plants, self.positions, strict=True)]

    # ------------------------------------------------------------------ time

    def run_until(self, t: int, stop: Callable[[], bool] = lambda: False) -> None:
        """Simulate up to edge t, or up to the first event after which `stop()` is true."""
        part = self.part
        while (edge := self._next_event()) is not None and edge < t:
            part.run_until(edge)
            self._follow_outputs()
            self.t = max(self.t, edge + 1)
            if stop():
                return
        self.t = max(self.t, t)

    def _next_event(self) -> int | None:
        """Return the edge of the next event of part or carrier."""
        return self.part.next_event

    def _follow_outputs(self) -> None:
        """Process new output edges: update motors, counters, switches and interrupt."""
        log = self.part.log
        if not log.edges:
            return
        edges = log.edges[:]
        # Restart the log with the current levels before the switches are set; otherwise a change of two axes
        # at the same edge would be lost.
        log.edges.clear()
        log.initial.update(log.levels)
        before = self.positions[:]
        for edge in edges:
            self._follow(edge)
        if self.positions != before:
            levels = self._levels()
            if levels != self._switches:
                self._switches = levels
                self.part.pins(self.part.now + 1, **self.switch_pins(levels))

    def _follow(self, edge: Edge) -> None:
        """Process one output edge; bit n of `dir` and `pout_n` belongs to axis n + 1."""
        if edge.signal == self.INTERRUPT and not edge.value:
            self.on_interrupt()
        elif edge.signal == "dir":
            self._directions = [edge.value >> n & 1 for n in range(len(self.plants))]
        elif edge.signal == "pout_n":
            for n, was in enumerate(self._pulse_pins):
                self._pulse_pins[n] = now = edge.value >> n & 1
                if was and not now:
                    self._step(n, -1 if self._directions[n] else 1)

    def _step(self, n: int, step: int) -> None:
        """Move motor n by one step, 1 (CW) or -1 (CCW)."""
        self.positions[n] += step
        self.counts[n] += step

    def _run_pending(self) -> None:
        """Run all events that precede the next access."""
        self.run_until(self.t)
        self.t = max(self.t, self.part.now + 1)

    # ------------------------------------------------------------------ accesses of the bridge

    def read(self, a: int) -> int:
        """Execute one read access."""
        self._run_pending()
        self._polled_value = self.watched_register()
        value = self.part.read(self.t, a % (1 << self.ADDRESS_BITS), READ_STROBE)
        self._follow_outputs()
        self.t += READ_STROBE + PAUSE
        return value

    def write(self, a: int, byte: int) -> None:
        """Execute one write access."""
        self._run_pending()
        self.part.write(self.t, a % (1 << self.ADDRESS_BITS), byte, WRITE_STROBE)
        self._follow_outputs()
        self.t += WRITE_STROBE + PAUSE

    def reset(self) -> None:
        """Reset the part; the positions of the motors and the pulse counters are unchanged."""
        self._run_pending()
        self.part.pins(self.t, rst_n=0)
        self._follow_outputs()
        self.t += RESET_CLK
        self.part.pins(self.t, rst_n=1)
        self.t += RESET_CLK
        self._directions = [0 for _ in self.plants]

    def set_pins(self, **levels: int) -> None:
        """Set input pins of the part from the next edge on."""
        self._run_pending()
        self.part.pins(self.t, **levels)
        self.t += 1

    def pin_byte(self, hold: int, axis: int) -> int:
        """Return int_n, hold and the six switches of an axis (0 = axis 1), from bit 0 up."""
        switches = sum(self._switches[axis][name] << place for place, name in enumerate(SWITCHES))
        return self.part.outputs[self.INTERRUPT] | hold << 1 | switches << 2

    def count(self, axis: int = 1) -> int:
        """Return the pulse counter, which may exceed the 32 bits of the answer."""
        self._run_pending()
        return self.counts[axis - 1]

    def zero(self, axis: int = 1) -> None:
        """Set the pulse counter to 0."""
        self._run_pending()
        self.counts[axis - 1] = 0

    def now_ms(self) -> float:
        """Return the virtual time in ms."""
        return self.t * 1000 / self.clk_hz

    def skip(self, limit_ms: float) -> None:
        """Simulate up to the next event that changes the polled register, but at most for `limit_ms`."""
        before = self._polled_value  # before the last read, during which the register may have changed
        limit = self.t + max(1, round(limit_ms * self.clk_hz / 1000))
        if self.watched_register() == before:
            self.run_until(limit, stop=lambda: self.watched_register() != before)
