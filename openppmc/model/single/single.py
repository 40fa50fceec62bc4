"""Part with one axis at pin level; `ppmc104` and `stmc` share this code.

This module contains the path of command bytes, the pin registers, the synchronised inputs of the axis, and
properties for tests and tools.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import ClassVar

from ..chip import Chip, Context, Phase, PinRegister
from ..clock import Latency, QuantumCounter
from ..motion.codes import IBF, OBF, GuardPins
from ..motion.excitation import ALL_PHASES, Chopper, Excitation
from ..motion.motion import Interval
from .commands import ByteUnit, TimedMotion
from .hostport import HostPort


class SingleAxis(Chip):
    """Part with one axis.

    Subclasses define their switches in GUARD and the pin of the external clock in CLOCK_PIN.

    Args:
        phase_idle: level of `s` from reset to the first initialisation, 0 or 1; another value raises
            ValueError.
    """

    GUARD: ClassVar[GuardPins]
    CLOCK_PIN: ClassVar[str]

    _port: HostPort
    _motion: TimedMotion
    _commands: ByteUnit
    _excitation: Excitation
    _chopper: Chopper

    def __init__(
        self,
        clk_hz: int,
        xtal_hz: int,
        timing: str,
        outputs: Mapping[str, int],
        phase_idle: int,
        latency: Latency | None,
    ) -> None:
        if phase_idle not in (0, 1):
            raise ValueError(f"phase_idle {phase_idle} is neither 0 nor 1")
        super().__init__(clk_hz, xtal_hz, timing, {**outputs, "s": ALL_PHASES if phase_idle else 0}, latency)
        self._phase_idle = phase_idle
        counter = QuantumCounter(self.timebase, self.latency.reset_tick)
        self._context = Context(
            self.timebase, self.latency, self.datasheet, self._queue, self.log, counter, dict(self.INPUTS)
        )
        self._build()

    # ------------------------------------------------------------------ implemented by the part

    @abstractmethod
    def _blocks(self, context: Context) -> None:
        """Create `_port`, `_motion`, `_commands` and `_chopper` in their reset state."""

    @abstractmethod
    def _motor_levels(self) -> dict[str, int]:
        """Return the internal levels of the motor pins, except `s`."""

    # ------------------------------------------------------------------ methods that `chip` calls

    def _build(self) -> None:
        """Create blocks in their reset state."""
        self._excitation = Excitation(self._phase_idle)
        self._blocks(self._context)
        at_rest = {name: self._reset_levels[name] for name in ("s", *self._motor_levels())}
        self._motor_pins = PinRegister(self._queue, self.latency.motor_pins, at_rest, self.log.set)

    def _take(self, t: int, byte: int, command: bool, stored_at: int) -> None:
        """Process a byte that is consumed at edge t (its C-event).

        DATASHEET times count from the write event, or from the end of the wait if the byte had to wait.
        """
        latency = self.latency
        waited = t > stored_at + latency.c_event
        reference = t + latency.ds_waited if waited else stored_at + latency.ds_host
        self._commands.take(t, byte, command, reference)

    def _state(self) -> int:
        return self._commands.state()

    def _latch(self, t: int) -> None:
        phases = self._excitation.pattern if self._chopper.on else self._excitation.chopped
        self._motor_pins.latch(t, {"s": phases, **self._motor_levels()})

    def _sample_bus(self, t: int, pins: Mapping[str, int]) -> None:
        self._port.sample(t, pins, self._stage)

    def _on_levels(self, t: int, levels: Mapping[str, int]) -> None:
        internal = self._context.levels
        was = internal[self.CLOCK_PIN]
        stops_changed = any(internal[pin] != levels[pin] for pin in self.GUARD.all)
        internal.update(levels)
        if stops_changed:
            self._queue.at(t, Phase.GUARD, self._motion.check_stops)
        if levels[self.CLOCK_PIN] != was:
            edge = self._motion.base_fall if was else self._motion.base_rise
            self._queue.at(t, Phase.BASE, edge)

    def _restart(self) -> None:
        self._context.levels = {**self.INPUTS, self.CLOCK_PIN: self._pins[self.CLOCK_PIN]}
        self._build()

    def _released(self, t: int) -> None:
        self._context.counter.restart(t + self.latency.reset_tick)

    def _strobe(self, write: bool, reg: int) -> dict[str, int]:
        return {"cs_n": 0, "wr_n" if write else "rd_n": 0, "a0": reg}

    def clock_rise(self, t: int) -> None:
        """Process a rising edge of the external clock at edge t without a change of its pin.

        Models of boards with a clock generator use this method, because it takes too long to process each
        edge of the pin.
        """
        self._queue.at(t, Phase.BASE, self._motion.base_rise)

    # ------------------------------------------------------------------ observable state

    @property
    def counts_clock(self) -> bool:
        """True while an operation that counts edges of the external clock is running."""
        return self._motion.external

    @property
    def busy(self) -> bool:
        """True while BUSY is set."""
        return self._motion.busy

    @property
    def status(self) -> int:
        """Status register without transfers in progress.

        IBF remains 0 until a written byte is stored, and OBF remains 1 until a byte that was read is removed.
        """
        return self._state() | (IBF if self._port.ibf else 0) | (OBF if self._port.obf else 0)

    @property
    def index(self) -> int | None:
        """Ramp index of the running interval.

        The value is `None` at standstill, before the first pulse, and at constant speed.
        """
        return self._motion.index

    @property
    def intervals(self) -> list[Interval]:
        """Intervals of the current or last operation."""
        return self._motion.intervals

    @property
    def initialised(self) -> bool:
        """True if an initialisation is active, even while its table is being built."""
        return self._commands.setup is not None

    @property
    def finish(self) -> int:
        """Finish status as the next read command 0x80 would return it."""
        return self._motion.finish

    @property
    def remaining(self) -> int:
        """Remaining-pulse value as the read command would return it."""
        return self._motion.remaining
