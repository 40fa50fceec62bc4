"""Motion of a part with one axis: start, interrupt, and the DATASHEET times of P104-DS-03..08.

The STMC has the same times under STMC-DS-01 and -04..10. What is special to a part: its own
`motion`.
"""

from __future__ import annotations

from abc import abstractmethod

from ..common.blocks import Context, Phase
from ..motion.chopper import Chopper
from ..motion.codes import SINGLE_STEP, Command
from ..motion.excitation import Excitation
from ..motion.guard import GuardPins
from ..motion.motion import Motion, Setup
from .hostport import BytePort

DS_BUSY_RAMP, DS_BUSY_CONSTANT = 1792, 432
DS_PULSE_CONSTANT, DS_PULSE_RAMP, DS_PULSE_STEP = 3104, 3200, 1376
DS_END, DS_CLOSED, DS_END_RAMP_STOP = 416, 2496, 3200


class TimedMotion(Motion):
    """The axis of a part whose mailbox is closed while an operation starts and ends."""

    def __init__(
        self, context: Context, port: BytePort, excitation: Excitation, chopper: Chopper, guard: GuardPins
    ) -> None:
        super().__init__(context, excitation, chopper, guard, self._interrupt)
        self._port = port

    def _interrupt(self, t: int, masked: bool) -> None:
        if not masked:
            self._context.drive(t, "int_n", 0)

    # ------------------------------------------------------------------ start

    @abstractmethod
    def _latch_operation(self, command: Command, data: list[int], setup: Setup) -> None:
        """`_load` with what the part's pins say."""

    @abstractmethod
    def slow_stop(self, t: int, reference: int) -> None:
        """Decelerating stop taken at edge t in START, ACC or HIGH of 011/110."""

    def start(self, t: int, command: Command, data: list[int], setup: Setup, reference: int) -> None:
        """C-event of an operation's last byte (P104-OPR-01, P104-BCK-02, P104-DS-03..06)."""
        timebase = self._context.timebase
        self._latch_operation(command, data, setup)
        if not self._context.datasheet:
            self._start(t, t + timebase.w + self._context.latency.start_extra)
            return
        begin = reference + timebase.cyc(DS_BUSY_RAMP if self.is_ramp else DS_BUSY_CONSTANT)
        first = reference + timebase.cyc(self._first_pulse_cycles())
        self._port.close_until(begin)
        self._context.queue.at(begin, Phase.BEGIN, lambda at: self._start(at, first))

    def _start(self, t: int, first: int) -> None:
        self._begin(t)
        self._arm(first)

    def _first_pulse_cycles(self) -> int:
        if self.operation == SINGLE_STEP:
            return DS_PULSE_STEP
        return DS_PULSE_RAMP if self.is_ramp else DS_PULSE_CONSTANT

    # ------------------------------------------------------------------ end

    def _decided(self, t: int) -> None:
        if not self._context.datasheet:
            super()._decided(t)
            return
        closed = DS_END_RAMP_STOP if self.is_ramp else DS_CLOSED
        self._datasheet_end(t, t, DS_END_RAMP_STOP if self.is_ramp else DS_END, closed)

    def _train_over(self, t: int) -> None:
        if not self._context.datasheet:
            return
        pin = t + self._context.latency.motor_pins
        if self.done < self._total:
            self._datasheet_end(t, pin, DS_END_RAMP_STOP, DS_END_RAMP_STOP)
        elif self.operation == SINGLE_STEP:
            self._datasheet_end(t, pin, DS_END, DS_END)
        else:
            self._datasheet_end(t, pin, DS_END, DS_CLOSED)

    def _ends_with_low(self) -> bool:
        return not self._context.datasheet

    def _datasheet_end(self, t: int, since: int, end_cycles: int, open_cycles: int) -> None:
        """End and closed mailbox, both counted from `since` (P104-DS-06..08)."""
        context = self._context
        since += context.latency.ds_motor
        self._port.close_until(since + context.timebase.cyc(open_cycles))
        self._ending(t)
        # Before COMMAND: a byte that waited for this very edge is judged with BUSY = 0.
        context.queue.at(since + context.timebase.cyc(end_cycles), Phase.BEGIN, self._finish)

    def _ending(self, t: int) -> None:
        """The end of the operation has been decided at edge t."""
