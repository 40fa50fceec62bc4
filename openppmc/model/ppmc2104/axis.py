"""Axis of the PPMC-2104: blocks, registers, and output of the pins."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..chip import Context, Phase, PinRegister
from ..clock import QuantumCounter
from ..motion import motion
from ..motion.codes import (
    ACC_DEC,
    CONSTANT,
    CONTINUOUS,
    FINISH_NEW,
    FINISH_STOP,
    HIGH_SPEED,
    ORIGIN,
    SINGLE_STEP,
    ActiveCauses,
    Command,
    Kind,
    input_register,
)
from ..motion.excitation import Chopper, Excitation
from ..motion.motion import OnEnd, Setup
from ..single.hostport import HostPort
from .codes import (
    CONTROL_INPUT,
    CONTROL_INPUT_BITS,
    END_STATUS,
    ERROR_CODE,
    GUARD,
    MOTOR_AT_REST,
    OUTPUT_SIGNAL,
    REMAINING,
    Cause,
    Error,
    Interrupt,
    axis_levels,
)

# DATASHEET times of the PPMC-2104: processing windows (P2104-DS-01..14) and the
# polling of limits and alarm (P2104-DS-20, -21).

_KINDS = {
    Kind.INITIALISE: 71_000,
    Kind.STOP: 400,
    Kind.SLOW_STOP: 32,
    Kind.EXCITATION_OFF: 32,
    Kind.AUX_OUTPUT: 40,
    Kind.AUX_INPUT: 40,
    Kind.SWITCHING: 36,
    Kind.HOLD_DELAY: 32,
}
_READS = {END_STATUS: 40, CONTROL_INPUT: 36, OUTPUT_SIGNAL: 32, REMAINING: 37, ERROR_CODE: 43}
_OPERATIONS = {SINGLE_STEP: 103, ACC_DEC: 110, CONSTANT: 29, CONTINUOUS: 32, HIGH_SPEED: 118, ORIGIN: 32}
_TRIANGLE = 340
_POLL = 35


def window_us(command: Command, triangle: bool = False) -> int:
    """Return the length of the processing window of an instruction in us (P2104-DS-01..13)."""
    if command.kind is Kind.READ:
        return _READS[command.code & 7]
    if command.kind is Kind.OPERATION:
        return _TRIANGLE if triangle and command.operation == ACC_DEC else _OPERATIONS[command.operation]
    return _KINDS[command.kind]


class Windows:
    """Processing windows, and the ticks at which inputs are polled.

    At most one window is open. A window delays the ticks.

    This class is used only with DATASHEET timing.

    Attributes:
        axis: 0 or 1 while a window of that axis is open, otherwise `None`.
    """

    def __init__(self, context: Context, port: HostPort, released: int) -> None:
        self._context = context
        self._port = port
        self._period = context.timebase.cyc(16 * _POLL)
        self._origins = (released, released)
        self._since = -1
        self.axis: int | None = None

    def open(self, t: int, us: int, axis: int | None) -> int:
        """Open a window of `us` microseconds (at a 16 MHz crystal) at edge t; return its last edge.

        Args:
            axis: 0 or 1, axis whose bit CMND is 1 during the window; `None` if no such bit is 1.
        """
        context = self._context
        end = t + context.timebase.cyc(16 * us) + context.latency.ds_window
        self._port.close_until(end)
        self._origins = (self._origin(t), end)
        self._since = t
        self.axis = axis
        context.queue.at(end, Phase.BEGIN, self._close)
        return end

    def _close(self, t: int) -> None:
        self.axis = None

    def _origin(self, t: int) -> int:
        """Return the origin from which the poll ticks at edge t are counted.

        A window moves the origin. At the edge that opens the window, the old origin is still valid.
        """
        return self._origins[t > self._since]

    def is_tick(self, t: int) -> bool:
        """Return True if limits and alarm are sampled at edge t (P2104-DS-20)."""
        passed = t - self._origin(t)
        return passed > 0 and passed % self._period == 0

    def next_tick(self, t: int) -> int:
        """Return the first tick after edge t. If a window opens before this tick, the tick occurs later."""
        origin = self._origin(t + 1)
        return origin + (max(0, t - origin) // self._period + 1) * self._period


# Motion of a PPMC-2104 axis, where it differs from related parts. Wait for RUN: P2104-OPR-02, -TIM-02. Stops:
# P2104-STP-01..05, -FDC-02. Inputs: P2104-LIM-03..09; with DATASHEET timing, they are polled (P2104-DS-20,
# -21). `motion` contains the behaviour that the PPMC family shares.

HOLD_UNIT, HOLD_DEFAULT = 2048, 0x18


class Motion(motion.Motion):
    """Motion of an axis of a PPMC-2104.

    Attributes:
        waiting: True in state RUNWAIT.
    """

    ends_at_start_rate = True

    def __init__(
        self,
        context: Context,
        excitation: Excitation,
        chopper: Chopper,
        windows: Windows,
        on_end: OnEnd,
    ) -> None:
        super().__init__(context, excitation, chopper, GUARD, on_end)
        self._windows = windows
        self.waiting = False
        self._run_sampled_from = 0
        self._end_delayed_until: int | None = None
        self._check_scheduled_at = -1
        self.set_hold_delay(HOLD_DEFAULT)

    def set_hold_delay(self, n: int) -> None:
        """Set the hold delay to 128 (n + 1) us; a timer that is running keeps its time (P2104-AUX-05)."""
        self.hold_cycles = HOLD_UNIT * (n + 1)

    # ------------------------------------------------------------------ start

    def start(self, t: int, command: Command, data: list[int], setup: Setup, run_sampled_from: int) -> None:
        """Process an operation whose last byte is consumed at edge t (its C-event).

        Args:
            run_sampled_from: first edge at which RUN is sampled.
        """
        self._latch_settings(command, data, setup, self._context.levels["csel"], plain=True)
        self._begin(t)
        self._end_delayed_until = None
        self.waiting, self._run_sampled_from = True, run_sampled_from
        if run_sampled_from > t:
            self._context.queue.at(run_sampled_from, Phase.RUN, self.check_run)
        else:
            self.check_run(t)

    def check_run(self, t: int) -> None:
        """End the state RUNWAIT at the first edge that samples RUN high."""
        if (
            not self.waiting
            or self.finishing
            or t < self._run_sampled_from
            or not self._context.levels["run"]
        ):
            return
        self.waiting = False
        self._arm(t + self._context.timebase.w + self._context.latency.start_extra)
        self._context.queue.at(t + 1, Phase.GUARD, self.check_stops)

    # ------------------------------------------------------------------ stops

    @property
    def can_decelerate(self) -> bool:
        """True in state START, ACC or HIGH of operation 011 or 110.

        Only in these states is a deceleration stop accepted (P2104-STP-02, -03).
        """
        free = self._flag_edge is None and not self._natural
        return self.busy and self.is_ramp and not self.waiting and not self.finishing and free

    def slow_stop(self, at: int) -> None:
        """Schedule a deceleration stop at edge `at`."""
        self._request(at, "flag", FINISH_STOP)

    def stop_until(self, t: int, end: int) -> None:
        """Process an immediate stop with DATASHEET timing (P2104-DS-02).

        No pulse is output from edge t on; all other effects of the stop occur at edge `end`.
        """
        if not self.finishing:
            self._end_delayed_until = end
        self.stop(t)

    # ------------------------------------------------------------------ inputs

    def _active_causes(self, t: int) -> ActiveCauses:
        causes = super()._active_causes(t)
        if not self._context.datasheet:
            return ActiveCauses(causes.bits, causes.origin and not self.waiting, causes.slow)
        if self._windows.is_tick(t):
            return ActiveCauses(causes.bits, False, causes.slow)
        tick = self._windows.next_tick(t)
        if (causes.bits or causes.slow) and tick != self._check_scheduled_at:
            self._check_scheduled_at = tick
            self._context.queue.at(tick, Phase.GUARD, self.check_stops)
        return ActiveCauses()

    def _next_rate(self, t: int) -> int | None:
        rate = super()._next_rate(t)
        origin = self.operation == ORIGIN and not self._context.levels[GUARD.origin]
        return None if self._context.datasheet and origin else rate

    # ------------------------------------------------------------------ end

    def _end_decided(self, t: int) -> None:
        if self._end_delayed_until is None:
            super()._end_decided(t)
        else:
            self._context.queue.at(self._end_delayed_until, Phase.BEGIN, self._finish)

    def _ends_with_low(self) -> bool:
        return self._end_delayed_until is None

    def _finish(self, t: int) -> None:
        self.waiting = False
        super()._finish(t)


@dataclass
class ChopperTimes:
    """Chopper times in units of 2 quanta (P2104-SW-04, -05, P2104-AUX-04, -06)."""

    on: int = 0x53
    off: int = 0xA6

    def quanta(self, on: bool) -> int:
        """Return the length of a phase that begins now, in quanta."""
        return 2 * (self.on if on else self.off)


class Axis:
    """Axis `number`, 0 or 1.

    Attributes:
        setup: `None` in state INITIAL.
        table_ready: edge at which the table build ends.
        building: True in state INITP, in which the ramp table is built.
    """

    def __init__(self, number: int, shared: Context, windows: Windows, interrupt: Interrupt) -> None:
        self.number = number
        counter = QuantumCounter(shared.timebase, shared.counter.origin)
        self.context = replace(shared, counter=counter, levels=axis_levels(shared.levels, number))
        self.excitation = Excitation()
        self.chopper_times = ChopperTimes()
        self.chopper = Chopper(self.context, self.chopper_times)
        self.motion = Motion(self.context, self.excitation, self.chopper, windows, self._ended)
        self.setup: Setup | None = None
        self.error = Error.NONE
        self.building = False
        self.table_ready = -1
        self._interrupt = interrupt
        latency = shared.latency
        self._pins = PinRegister(shared.queue, latency.motor_pins, MOTOR_AT_REST, self._set_pin)

    def _ended(self, t: int, masked: bool) -> None:
        if not masked:
            self._interrupt.raise_(Cause.END, self.number)

    def _set_pin(self, t: int, signal: str, value: int) -> None:
        """Set a pin of the part.

        The phases of each axis are a separate port; any other pin is a bit of a port of both axes.
        """
        log = self.context.log
        if signal == "s":
            log.set(t, f"s{self.number + 1}_n", value)
        else:
            others = log.levels[signal] & ~(1 << self.number)
            log.set(t, signal, others | value << self.number)

    def latch(self, t: int) -> None:
        """Update the motor pins from the levels after edge t."""
        motion = self.motion
        phases = self.excitation.pattern if self.chopper.on else self.excitation.chopped
        self._pins.latch(
            t, {"s": phases, "pout_n": int(not motion.low), "hold": motion.hold, "dir": motion.direction}
        )

    def on_levels(self, t: int, levels: dict[str, int]) -> None:
        """Process new synchronised levels at edge t."""
        internal, queue, motion = self.context.levels, self.context.queue, self.motion
        changed = {pin for pin, level in levels.items() if internal[pin] != level}
        internal.update(levels)
        if changed - {"run", "extck", "csel"}:
            queue.at(t, Phase.GUARD, motion.check_stops)
        if "run" in changed:
            queue.at(t, Phase.RUN, motion.check_run)
        if "extck" in changed:
            queue.at(t, Phase.BASE, motion.base_rise if levels["extck"] else motion.base_fall)

    @property
    def operating(self) -> bool:
        """True if this axis is operating, as the rate check of the other axis defines it (P2104-DS-31)."""
        return self.motion.busy or (self.setup is not None and self.setup.chopping)

    def switch_off(self) -> None:
        """Execute excitation OFF, which returns to state INITIAL (P2104-AUX-01)."""
        self.chopper.stop()
        self.excitation.off()
        self.setup = None

    def register(self, t: int, number: int) -> list[int]:
        """Return the bytes of a register read, sampled at edge t (P2104-RD-01..07)."""
        motion = self.motion
        if number == END_STATUS:
            value = motion.finish
            motion.finish &= ~FINISH_NEW
            self._interrupt.release(t, Cause.END, self.number)
            return [value]
        if number == CONTROL_INPUT:
            return [input_register(self.context.levels, CONTROL_INPUT_BITS)]
        if number == OUTPUT_SIGNAL:
            pattern = self.excitation.pattern
            phases = sum((pattern >> i & 1) << (7 - i) for i in range(5))
            return [phases | self.pin("hold") << 2 | self.pin("dir") << 1]
        if number == ERROR_CODE:
            error, self.error = self.error, Error.NONE
            self._interrupt.release(t, Cause.ERROR, self.number)
            return [int(error)]
        return list(motion.remaining.to_bytes(3, "little"))

    def pin(self, signal: str) -> int:
        """Return the current level of the bit of this axis in a port of both axes."""
        return self.context.log.levels[signal] >> self.number & 1
