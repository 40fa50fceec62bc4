"""Instruction processor of the PPMC-2104 model: effect and error of each byte.

Handshake: P2104-HSK-04..08. Errors and their order: P2104-ERR-01..06, P2104-FSM-01..05. Setting:
P2104-INI-01..07. Reads: P2104-RD-01..08. Auxiliary: P2104-AUX-01..06. `axis.Windows` contains the times.
"""

from __future__ import annotations

from collections.abc import Callable

from ..chip import Context, Phase
from ..motion.codes import CONSTANT, CONTINUOUS, ORIGIN, PA_MAX, PA_MIN, Command, Kind, inspect
from ..motion.motion import Setup
from ..motion.ramp import Ramp
from ..single.hostport import HostPort
from .axis import Axis, Windows, window_us
from .codes import (
    BUSY,
    CMND,
    ERROR,
    GUARD,
    NEEDS_TABLE,
    STOPS,
    SWITCH_MIN,
    Cause,
    Error,
    Interrupt,
    decode,
    is_error_read,
    rate_error,
)


class CommandUnit:
    """Unit that processes each byte at the edge on which it is consumed (its C-event), for both axes."""

    def __init__(
        self, context: Context, port: HostPort, axes: list[Axis], interrupt: Interrupt, windows: Windows
    ) -> None:
        self._context = context
        self._port = port
        self._axes = axes
        self._interrupt = interrupt
        self._windows = windows
        self._pending: Command | None = None
        self._data: list[int] = []
        self._builder_free = -1

    def state(self) -> int:
        """Return the status register with only its bits ERROR, CMND and BUSY (P2104-STA-04..06)."""
        bits = 0
        for axis in self._axes:
            n = axis.number
            collecting = self._pending is not None and self._pending.axis == n
            if collecting or axis.building or self._windows.axis == n:
                bits |= CMND[n]
            bits |= BUSY[n] if axis.motion.busy else 0
            bits |= ERROR if axis.error else 0
        return bits

    def must_wait(self, t: int, byte: int, command: bool) -> bool:
        """Return True if a byte must wait at edge t for the end of a table build (P2104-HSK-04)."""
        if not command or self._pending is not None:
            return False
        code = decode(byte)
        return code.kind in NEEDS_TABLE and t <= self._axes[code.axis].table_ready

    def take(self, t: int, byte: int, command: bool) -> None:
        """Process a byte that is consumed at edge t (its C-event)."""
        if command:
            self._code(t, decode(byte))
        else:
            self._parameter(t, byte)

    def _report_error(self, axis: int, error: Error) -> None:
        """Store an error in the register of an axis (P2104-ERR-01, P2104-INT-01)."""
        self._axes[axis].error = error
        if not self._context.levels["errint_n"]:
            self._interrupt.raise_(Cause.ERROR, axis)

    # ------------------------------------------------------------------ code bytes

    def _code(self, t: int, command: Command) -> None:
        """Process a code byte; apply the checks of P2104-ERR-04 in the order of that rule."""
        abandoned = self._pending is not None
        self._pending, self._data = None, []
        if abandoned and command.kind not in STOPS:
            self._report_error(command.axis, Error.DATA_OUTSTANDING)
            return
        error = self._code_error(command)
        if abandoned:
            reported = error if error is Error.CANNOT_DECELERATE else Error.DATA_OUTSTANDING
            self._report_error(command.axis, reported)
        elif error:
            self._report_error(command.axis, error)
        if error:
            return
        if command.parameters:
            self._pending = command
        elif late := self._data_error(command, []):
            self._report_error(command.axis, late)
        else:
            self._execute(t, command, [])

    def _code_error(self, command: Command) -> Error:
        """Return the error that a code causes in the current state of its axis, NONE if it is accepted."""
        axis, kind = self._axes[command.axis], command.kind
        motion = axis.motion
        if kind is Kind.UNDEFINED:
            return Error.UNDEFINED
        if kind in (Kind.AUX_OUTPUT, Kind.AUX_INPUT) or is_error_read(command):
            return Error.NONE
        if kind in STOPS:
            if not motion.busy:
                return Error.NOT_INITIALISED if axis.setup is None else Error.NOTHING_TO_STOP
            rejected = kind is Kind.SLOW_STOP and not motion.can_decelerate
            return Error.CANNOT_DECELERATE if rejected else Error.NONE
        if motion.busy:
            return Error.NOT_WHILE_BUSY
        if kind is Kind.OPERATION and axis.setup is None:
            return Error.NOT_INITIALISED
        return Error.NONE

    # ------------------------------------------------------------------ data bytes

    def _parameter(self, t: int, byte: int) -> None:
        """Process a data byte. The last data byte of an instruction executes it."""
        command = self._pending
        if command is None:
            self._report_error(0, Error.UNASKED_DATA)
            return
        self._data.append(byte)
        if len(self._data) < command.parameters:
            return
        data = self._data
        self._pending, self._data = None, []
        if error := self._data_error(command, data):
            self._report_error(command.axis, error)
        else:
            self._execute(t, command, data)

    def _data_error(self, command: Command, data: list[int]) -> Error:
        """Check an instruction after its last byte; return its error, or NONE (P2104-ERR-05)."""
        if command.kind is Kind.INITIALISE:
            return self._setting_error(command, data)
        if command.kind is Kind.OPERATION:
            return self._start_error(command, data)
        if command.kind is Kind.SWITCHING and min(data) < SWITCH_MIN:
            return Error.BAD_SWITCHING
        return Error.NONE

    def _setting_error(self, command: Command, data: list[int]) -> Error:
        """Check the values of an initial setting; return their error, or NONE (P2104-INI-03)."""
        setup = self._axes[command.axis].setup
        external = setup.external if setup else bool(command.code & 8)
        rl, rh, pa = data[0], data[1], data[2] | data[3] << 8
        if (rh == 0 and not external) or rl < rh + 2 or pa < PA_MIN:
            return Error.BAD_RATE
        return Error.PA_TOO_LARGE if pa > PA_MAX else Error.NONE

    def _start_error(self, command: Command, data: list[int]) -> Error:
        """Check rate, rate limits and switches before a start; return the error (P2104-ERR-05, -LIM-06)."""
        axis, other = self._axes[command.axis], self._axes[1 - command.axis]
        setup, levels = axis.setup, axis.context.levels
        assert setup is not None
        rate = setup.ramp.rh
        if command.operation in (CONSTANT, CONTINUOUS, ORIGIN):
            rate = data[0]
            if rate == 0 and not setup.external:
                return Error.BAD_RATE
        if self._context.datasheet:
            error = rate_error(command, rate, setup, levels["csel"], other.operating)
            if error:
                return error
        causes = inspect(GUARD, levels, command.operation, command.direction)
        return Error.START_REFUSED if causes.ends else Error.NONE

    # ------------------------------------------------------------------ execution

    def _execute(self, t: int, command: Command, data: list[int]) -> None:
        """Execute an instruction at edge t or, with DATASHEET timing, during its processing window."""
        axis, kind = self._axes[command.axis], command.kind
        end = self._window(t, command, data) if self._context.datasheet else t
        if kind is Kind.INITIALISE:
            self._set_up(t, end, axis, command.code, data)
        elif kind is Kind.OPERATION:
            assert axis.setup is not None
            axis.motion.start(t, command, data, axis.setup, end)
        elif kind is Kind.STOP and self._context.datasheet:
            axis.motion.stop_until(t, end)
        elif kind is Kind.STOP:
            axis.motion.stop(t)
        elif kind is Kind.SLOW_STOP:
            axis.motion.slow_stop(end)
        else:
            self._at(t, end, lambda now: self._simple(now, axis, command, data))

    def _window(self, t: int, command: Command, data: list[int]) -> int:
        triangle = False
        setup = self._axes[command.axis].setup
        if setup is not None and len(data) == 3:
            triangle = int.from_bytes(bytes(data), "little") < 2 * setup.ramp.pa
        no_axis = command.kind in (Kind.AUX_OUTPUT, Kind.AUX_INPUT)
        return self._windows.open(t, window_us(command, triangle), None if no_axis else command.axis)

    def _at(self, t: int, end: int, action: Callable[[int], None]) -> None:
        """Execute an action immediately or, with DATASHEET timing, at the end of the processing window."""
        if end > t:
            self._context.queue.at(end, Phase.BEGIN, action)
        else:
            action(t)

    def _simple(self, t: int, axis: Axis, command: Command, data: list[int]) -> None:
        """Execute an instruction that neither starts nor stops a motion."""
        kind, code = command.kind, command.code
        if kind is Kind.READ:
            self._port.answer(axis.register(t, code & 7))
        elif kind is Kind.AUX_INPUT:
            self._port.answer([self._context.levels["auxi"]])
        elif kind is Kind.AUX_OUTPUT:
            self._context.drive(t, "auxo", ~(code >> 4) & 3)
        elif kind is Kind.SWITCHING:
            axis.chopper_times.on, axis.chopper_times.off = data
        elif kind is Kind.HOLD_DELAY:
            axis.motion.set_hold_delay(data[0])
        else:
            axis.switch_off()

    # ------------------------------------------------------------------ initial setting

    def _set_up(self, t: int, end: int, axis: Axis, code: int, data: list[int]) -> None:
        """Store a valid setting, output the phase pattern and start the table build (P2104-INI-04, -05)."""
        ramp = Ramp(data[0], data[1], data[2] | data[3] << 8)
        fresh = axis.setup is None
        if axis.setup is None:
            axis.setup = Setup(ramp, external=bool(code & 0x08), chopping=bool(code & 0x10))
            axis.excitation.configure((code & 3) + 2, bool(code & 4), positive=False)
        else:
            axis.setup = axis.setup._replace(ramp=ramp)
        ready = end
        if not self._context.datasheet:
            latency = self._context.latency
            begin = max(t, self._builder_free)
            ready = begin + latency.build(ramp.rl, ramp.rh, ramp.pa) + latency.build_queue
            self._builder_free = axis.table_ready = ready
            self._port.retry(ready + latency.window_open)
        axis.building = True
        self._context.queue.at(ready, Phase.BEGIN, lambda now: self._complete(now, axis, fresh))

    def _complete(self, t: int, axis: Axis, fresh: bool) -> None:
        """Change to state NORMAL when the table is ready (P2104-INI-04, -07)."""
        axis.building = False
        assert axis.setup is not None
        if fresh and axis.setup.chopping:
            axis.chopper.start(t)
