"""All blocks of the PPMC-312, and the state that the instructions change.

Rules: P312-STA, P312-GEN-12, P312-INP-30..33. `make_host` creates the host side for the parallel bus;
`connect` can replace it by the serial host side.
"""

from __future__ import annotations

from collections.abc import Callable

from ..chip import Context, Phase
from .codes import Alarm, Answer, Cause, Source, State, Trigger
from .front import responses
from .front.responses import ENCODE, POSITION, Report, Responses
from .front.station import HostSide
from .instructions.overrides import EventBuffer, Fifo
from .instructions.unit import Unit
from .motion.inputs import EVENT_PINS, Filters, InputChange, Outputs
from .motion.operation import Operation
from .motion.position import Counters, Interlock, Monitor, WindowMonitors
from .stages import FreeCurve, Table
from .timing import CoreTiming


class Core:
    """All blocks of the part.

    Args:
        reset: reset(t, source) executes the software reset that was requested by `source`, and sends its
            response.
    """

    unit: Unit
    host: HostSide

    def __init__(
        self,
        context: Context,
        core_timing: CoreTiming,
        version: int,
        make_host: Callable[[Core], HostSide],
        reset: Callable[[int, Source], None],
    ) -> None:
        self.context, self.core_timing, self.version, self.reset = context, core_timing, version, reset
        self.table: Table | None = None
        self.transfer: FreeCurve | None = None
        self._abnormal = self._clearing = False
        self.counters, self.interlock = Counters(), Interlock()
        self.fifo, self.events = Fifo(core_timing.armed), (EventBuffer(), EventBuffer())
        self.responses = Responses(self._response_stored, self._was_read, lambda: self.unit.response_pending)
        self.outputs = Outputs(context)
        self.filters = Filters(context, self._pin_changed)
        pins = self.filters.levels
        self.operation = Operation(
            context,
            core_timing,
            pins,
            self.outputs,
            self.counters,
            self.responses,
            self._on_pulse,
            self.overrun,
            self._evaluate_monitors,
            lambda: self.unit.overrides_done or self._abnormal,
            lambda: self._abnormal,
        )
        self.monitors = WindowMonitors(
            context,
            core_timing,
            self.counters,
            Monitor(POSITION, Answer.POSITION_CHANGE, self.responses),
            Monitor(ENCODE, Answer.ENCODE_CHANGE, self.responses),
            lambda: self.operation.at_standstill,
            self.outputs.clamp,
            lambda: not pins["end_n"],
        )
        self.input_change = InputChange(context, self.responses)
        self.unit = Unit(self)
        self.host = make_host(self)

    def connect(self, host: HostSide, serial: bool) -> None:
        """Use this host side, for the parallel bus or for the line. The pins select it just after a reset."""
        self.host, self.responses.serial = host, serial

    # ------------------------------------------------------------------ state

    @property
    def state(self) -> State:
        """Operation state (docs/ppmc312/README.md, 7 States)."""
        if self._abnormal:
            return State.ABN
        return self.operation.state or (State.NOR if self.table else State.INI)

    def discard_table(self) -> None:
        """Change to state INI, without a table and without registered instructions."""
        self.table = self.transfer = None
        self._clear_buffers()

    def set_table(self, table: Table) -> None:
        """Change to state NOR with a new table."""
        self.table = table
        self.operation.speed_limit = table.high
        self._clear_buffers()

    def _clear_buffers(self) -> None:
        self.fifo.clear()
        for buffer in self.events:
            buffer.clear()

    def drop_overrides(self, t: int) -> None:
        """Clear the FIFO of overrides after an override has failed.

        If a stop at a position has already ended the pulses, the motion does not resume.
        """
        self.fifo.clear()

    # ------------------------------------------------------------------ alarms

    def alarm(self, t: int, status: Alarm) -> None:
        """Process an alarm: alm_n = 0, or a multiple occurrence (P312-INP-30..32)."""
        self.responses.report(t, responses.ALARM, Answer.ALARM, status)
        if self._abnormal:
            return
        self._abnormal, self._clearing = True, False
        if self.transfer is not None:
            self.discard_table()
        self.operation.stop(t, Cause.ALARM)

    def overrun(self, t: int, status: Alarm) -> None:
        """Process the loss of a report at edge t. The alarm occurs one cycle later."""
        self.context.queue.at(t + 1, Phase.LEVELS, lambda now: self.alarm(now, status))

    def clear_alarm(self, t: int) -> None:
        """Execute instruction 24, which asserts aclr_n (P312-INP-33).

        While aclr_n is low, the part can leave state ABN.
        """
        self.outputs.alarm_clear(t)
        self._clearing = self._abnormal
        self.context.queue.at(t + 1, Phase.LEVELS, self._leave_abnormal)

    def _leave_abnormal(self, t: int) -> None:
        if self._clearing and not self.outputs.aclr_n and self.filters.levels["alm_n"]:
            self._abnormal = self._clearing = False

    # ------------------------------------------------------------------ events of the blocks

    def _response_stored(self, t: int) -> None:
        self.host.notify_response(t)

    def _was_read(self, t: int, report: Report, block: bytes) -> None:
        self.unit.was_read(t, report)
        if report.kind in (POSITION, ENCODE):
            self.monitors.was_read(t, report.kind)

    def _on_pulse(self, t: int, direction: int) -> bool:
        """Compare the position after a pulse; return True if an override stops the pulses at the position."""
        position = self.counters.pulse
        released = self.fifo.count(t, position)
        if released:
            self.unit.schedule(t)
        if self.interlock.arrives(position):
            self.context.queue.at(
                t + self.core_timing.unlock - self.core_timing.compare, Phase.STORE, self._interlock_ended
            )
        return released is not None and released.stops_at_position

    def _interlock_ended(self, t: int) -> None:
        if not self.responses.report(t, responses.INTERLOCK, Answer.INTERLOCK_END):
            self.overrun(t, Alarm.INTERLOCK_OR_HOLD)

    def count_encoder(self, t: int, direction: int) -> None:
        """Process a rising edge of epin."""
        self.counters.count_encoder(direction)
        self.monitors.evaluate(t)

    def _evaluate_monitors(self, t: int) -> None:
        self.monitors.evaluate(t)

    def _pin_changed(self, t: int, pin: str) -> None:
        low = not self.filters.levels[pin]
        if pin in EVENT_PINS:
            if low:
                self.unit.event(t, Trigger.EVT0 if pin == "evt0_n" else Trigger.EVT1)
        elif pin == "alm_n":
            if low:
                self.outputs.reduce(t)
                if not self._abnormal:
                    self.alarm(t, Alarm.PIN)
            else:
                self._leave_abnormal(t)
        elif pin == "end_n":
            self.operation.check_end(t)
            self.monitors.evaluate(t)
        else:
            self.operation.motion.schedule_check(t)
