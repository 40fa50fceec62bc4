"""Command processor of the parts with one axis.

The processor converts bytes to commands and determines the error of a byte.

Errors and their order: P104-ERR-00..03, P104-STA-05/06, P104-FSM-01..03 (STMC-ST-01..03, STMC-CMD-01..03).
Parameters: P104-HSK-07. The module of each part defines the effect of the commands.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from ..chip import Context, Phase
from ..motion.codes import SINGLE_STEP, Command, GuardPins
from ..motion.excitation import Chopper, Excitation
from ..motion.motion import Motion, Setup
from ..motion.ramp import Ramp
from .codes import BUSY, ERR, Error, Kind
from .hostport import BytePort

# Motion of a part with one axis: start, interrupt, and the DATASHEET times of P104-DS-03..08. The same times
# are STMC-DS-01 and -04..10 for the STMC. The class `Motion` of each part defines the behaviour of this part.

DS_BUSY_RAMP, DS_BUSY_CONSTANT = 1792, 432
DS_PULSE_CONSTANT, DS_PULSE_RAMP, DS_PULSE_STEP = 3104, 3200, 1376
DS_END, DS_CLOSED, DS_END_RAMP_STOP = 416, 2496, 3200


class TimedMotion(Motion):
    """Axis of a part whose mailbox is closed while an operation starts and ends."""

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
        """Latch the settings of an operation, with the levels of the pins that the part has."""

    @abstractmethod
    def slow_stop(self, t: int, reference: int) -> None:
        """Process a deceleration stop.

        The stop was accepted at edge t, in state START, ACC or HIGH of operation 011 or 110.
        """

    def start(self, t: int, command: Command, data: list[int], setup: Setup, reference: int) -> None:
        """Process an operation whose last byte is consumed at edge t (its C-event).

        Rules: P104-OPR-01, P104-BCK-02, P104-DS-03..06.
        """
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

    def _end_decided(self, t: int) -> None:
        if not self._context.datasheet:
            super()._end_decided(t)
            return
        closed = DS_END_RAMP_STOP if self.is_ramp else DS_CLOSED
        self._datasheet_end(t, t, DS_END_RAMP_STOP if self.is_ramp else DS_END, closed)

    def _last_pulse_output(self, t: int) -> None:
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
        """Schedule the end of the command, and close the mailbox.

        Both times start at `since` (P104-DS-06..08).
        """
        context = self._context
        since += context.latency.ds_motor
        self._port.close_until(since + context.timebase.cyc(open_cycles))
        self._ending(t)
        # Phase.BEGIN precedes Phase.COMMAND, so that a byte that waited for this edge is checked with BUSY =
        # 0.
        context.queue.at(since + context.timebase.cyc(end_cycles), Phase.BEGIN, self._finish)

    def _ending(self, t: int) -> None:
        """Process the decision at edge t to end the operation."""


_DS_PATTERN = 704  # crystal cycles to the first phase pattern (P104-DS-01)


class ByteUnit(ABC):
    """Unit that processes bytes, each at the edge on which it is consumed (its C-event).

    Attributes:
        error: error number of the last byte, or `None`.
        setup: settings of the initialisation, `None` in state UNINIT.
    """

    allowed_while_busy: ClassVar[tuple[Kind, ...]] = (
        Kind.STOP,
        Kind.SLOW_STOP,
        Kind.AUX_ON,
        Kind.AUX_OFF,
        Kind.AUX_OUTPUT,
        Kind.EXCITATION_OFF,
    )

    def __init__(
        self,
        context: Context,
        port: BytePort,
        motion: TimedMotion,
        excitation: Excitation,
        chopper: Chopper,
    ) -> None:
        self._context = context
        self._port = port
        self._motion = motion
        self._excitation = excitation
        self._chopper = chopper
        self.error: Error | None = None
        self.setup: Setup | None = None
        self._pending: Command | None = None
        self._data: list[int] = []

    @abstractmethod
    def _decode(self, byte: int) -> Command:
        """Return the command of a code."""

    @abstractmethod
    def _execute(self, t: int, command: Command, reference: int, data: list[int]) -> Error | None:
        """Execute a command with all its data bytes, or return its error."""

    @property
    def expected(self) -> int:
        """Number of parameter bytes that the current command still requires."""
        return self._pending.parameters - len(self._data) if self._pending else 0

    def state(self) -> int:
        """Return ERR, NUM and BUSY as bits of the status register (P104-STA-04..06)."""
        field = self.expected << 4 if self.error is None else ERR | self.error << 4
        return field | (BUSY if self._motion.busy else 0)

    def take(self, t: int, byte: int, command: bool, reference: int) -> None:
        """Process a byte that is consumed at edge t (its C-event).

        Args:
            reference: edge from which the DATASHEET times count.
        """
        self.error = self._command(t, byte, reference) if command else self._parameter(t, byte, reference)

    def _command(self, t: int, byte: int, reference: int) -> Error | None:
        """Process a command byte; return its error. An unfinished command is discarded (P104-HSK-07)."""
        self._pending, self._data = None, []
        command = self._decode(byte)
        error = self._code_error(command)
        if error is not None:
            return error
        if command.parameters:
            self._pending = command
            return None
        return self._execute(t, command, reference, [])

    def _code_error(self, command: Command) -> Error | None:
        """Return the error of a command byte; P104-ERR-01 defines the order of the checks."""
        motion, kind = self._motion, command.kind
        if kind is Kind.UNDEFINED:
            return Error.UNDEFINED
        if kind in (Kind.STOP, Kind.SLOW_STOP) and not motion.busy:
            return Error.UNDEFINED
        if motion.busy and kind not in self.allowed_while_busy:
            return Error.NOT_WHILE_BUSY
        if kind is Kind.OPERATION and self.setup is None:
            return Error.NOT_INITIALISED
        if kind is Kind.SLOW_STOP and motion.is_ramp and (motion.decelerating or motion.finishing):
            return Error.ALREADY_DECELERATING
        return None

    def _parameter(self, t: int, byte: int, reference: int) -> Error | None:
        """Process a data byte; return its error. The last data byte executes the command (P104-FSM-03)."""
        if self._pending is None:
            return Error.UNASKED_DATA_BUSY if self._motion.busy else Error.UNASKED_DATA
        self._data.append(byte)
        if self.expected:
            return None
        command, data = self._pending, self._data
        self._pending, self._data = None, []
        return self._execute(t, command, reference, data)

    def _stop(self, t: int, kind: Kind, reference: int) -> None:
        """Execute an accepted stop command (P104-STP-01..03)."""
        if kind is Kind.STOP or not self._motion.is_ramp:
            self._motion.stop(t)
        else:
            self._motion.slow_stop(t, reference)

    def _set_up(self, t: int, code: int, ramp: Ramp, reference: int, ds_build: int) -> None:
        """Store a checked initialisation and begin the table build (P104-INI-05, STMC-INI-04..07).

        Args:
            ds_build: crystal cycles of the build with DATASHEET timing, from `reference` on.
        """
        context = self._context
        if self.setup is None:
            phases, half, positive = (code & 3) + 2, bool(code & 4), bool(code & 8)

            def output_pattern(at: int) -> None:
                self._excitation.configure(phases, half, positive)

            if context.datasheet:
                context.queue.at(reference + context.timebase.cyc(_DS_PATTERN), Phase.BEGIN, output_pattern)
            else:
                output_pattern(t)
        self.setup = Setup(ramp, external=bool(code & 0x10), chopping=bool(code & 0x20))
        if context.datasheet:
            done = reference + context.timebase.cyc(ds_build)
        else:
            done = t + context.latency.build(ramp.rl, ramp.rh, ramp.pa)
        self._complete_after(done)

    def _complete_after(self, done: int) -> None:
        """Schedule the end of the initialisation at edge `done`, at which the table is ready.

        Until edge `done`, no byte is accepted.
        """
        self._port.close_until(done)
        self._context.queue.at(done, Phase.BEGIN, self._complete)

    def _complete(self, t: int) -> None:
        """Process the end of the table build: chop the motor current if bit 5 of the code is set.

        Rules: P104-INI-07/08, STMC-CHP-01/02.
        """
        assert self.setup is not None
        if self.setup.chopping:
            self._chopper.start(t)
        else:
            self._chopper.stop()
