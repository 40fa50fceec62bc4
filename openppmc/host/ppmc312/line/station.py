"""One PPMC-312 in serial mode: an axis of a `Ppmc312Bus`."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ....model.ppmc312.codes import Cause, Code, Source, State
from ...line import POLL_EVERY, StationNotResponding, wait_all
from ...line_port import Counters
from ...motion import Progress
from ...motion_result import MotionResult
from ..answers import Executed, Report, Status, Stopped, signed
from ..motion import Motion
from ..part import Axis
from .line import CAPABILITIES, Line
from .station_link import ATTEMPTS, StationLink
from .wire import ERROR_CODE, ERROR_COUNTS, station_number

_MOST_PPS = 4_000_000
"""Speed in pulses/s that no table exceeds: rate 2 at 8 MHz."""
_ENCODER_SLACK = 64
"""Largest difference of two agreeing reads of the encoder: half the value of bit 7 of its lowest byte."""


class ErrorCounts(NamedTuple):
    """Numbers of errors that a station has counted since the last read, each at most 255."""

    framing: int
    overrun: int
    checksum: int


class SerialMotion(Motion):
    """Motion whose end is detected by polling its station."""

    _part: Station312

    @property
    def line(self) -> Line:
        """Line of the station."""
        return self._part.link

    @property
    def station(self) -> int:
        """Number of the station."""
        return self._part.number

    def _current_progress(self) -> Progress:
        """Return the current progress; after the end of the motion, the progress at its end."""
        position = self._part._position(False) if self.result is None else self.result.position or 0
        done = 0 if self.begin is None else abs(signed((position - self.begin) % (1 << 32)))
        return Progress(position, done, self.requested, self._link.clock() - self._started)

    def _on_stop_report(self, report: Stopped) -> None:
        """Process the report that the motion has ended, and compare it with the requested motion.

        Noise may change the number of pulses in the request, or the position in the report, without an error
        being detected. Therefore, the position is read again if the report does not match the request.
        """
        super()._on_stop_report(report)
        if self.result_error is not None:
            self.result_error = None
            super()._on_stop_report(Stopped(report.cause, self._part.position))

    def _update(self) -> None:
        """Poll the station; set `result` or `result_error` if the motion is over."""
        window = self._part.window
        window.collect()
        if not self.over and not window.busy:
            # The motor is stopped, but the report of the end was lost on the line.
            cause = window.end_status()
            if cause is None:
                self._not_confirmed("the station is at standstill and knows of no motion")
            else:
                self._on_stop_report(window.stop_report(cause))

    def wait(
        self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None
    ) -> MotionResult:
        return wait_all([self], timeout, progress)[0]


class Station312(Axis[SerialMotion]):
    """One station, with the methods of `ppmc312.Ppmc312`.

    In serial mode, there is no access to free curves, tables and event buffers: such calls raise OutOfRange.
    The station sends a report only as the reply to a poll. After a lost reply, an instruction is repeated
    only if the repetition has no side effect (`LostReplyResolver`). The driver raises LostReply if it cannot
    determine whether the instruction was executed.

    Args:
        number: 0 to 15.
    """

    kind = CAPABILITIES
    link: Line
    window: StationLink

    def __init__(self, line: Line, number: int) -> None:
        self.number = station_number(number)
        self._message_prefix = f"station {number}: "
        self._slow_override = False
        super().__init__(line)

    def _make_motion(self, requested: int | None, direction: int, begin: int | None) -> SerialMotion:
        return SerialMotion(self, requested, direction, begin)

    def _make_window(self) -> StationLink:
        return StationLink(self.link, self)

    @property
    def counters(self) -> Counters:
        """Counters of the faults between the master and this station."""
        return self.link.counters[self.number]

    # ------------------------------------------------------------------ reports

    def _on_report(self, report: Report) -> None:
        """Process a report that a poll returned."""
        if isinstance(report, Executed) and report.by is Source.OVERRIDE and self._slow_override:
            if self._motion is not None:
                self._motion.stop_ordered = True
        self._store_report(report)

    def poll(self) -> list[Report]:
        """Poll the station until no report is pending; return the new reports, oldest first.

        Reports of the ends of motions that this object started are not returned; they set the `result` of the
        motion.
        """
        self.window.collect()
        taken = list(self.reports)
        self.reports.clear()
        return taken

    def next_report(self, timeout: float = 0) -> Report | None:
        end = self.link.clock() + timeout
        while True:
            if not self.reports:
                self.window.collect()
            if self.reports:
                return self.reports.popleft()
            if self.link.clock() >= end:
                return None
            self.link.pause(POLL_EVERY)

    def process_reports(self, seconds: float) -> None:
        end = self.link.clock() + seconds
        while (left := end - self.link.clock()) > 0:
            self.window.collect()
            self.link.pause(min(left, POLL_EVERY))

    def busy_now(self) -> bool:
        """Poll the station; return True if a motion is running or held."""
        self.window.collect()
        return self.window.busy

    def status(self) -> Status:
        """Read the status until two successive reads are equal, and return it."""
        return self.window.read_consistently(super().status)

    # ------------------------------------------------------------------ instructions of the line only

    def error_code(self) -> int:
        """Return the last error code, 42 to 49, that the station sent in a reply; 0 if there was none.

        The read clears the code. Raises AxisBusy while the motor is moving.
        """
        return self.window.read(ERROR_CODE)[0]

    def error_counts(self) -> ErrorCounts:
        """Return the counters of framing errors, overruns and checksum errors of the station.

        The read clears the counters. Raises AxisBusy while the motor is moving.
        """
        return ErrorCounts(*self.window.read(ERROR_COUNTS))

    def end_status(self) -> Cause | None:
        """Return why the last motion ended. The call is allowed at any time.

        The result is `None` if no motion has ended since the reset.
        """
        return self.window.end_status()

    def reset(self) -> None:
        """Reset the station by instruction, in any state.

        The pulses end immediately. After the reset there is no table, and the position is 0.
        """
        for _ in range(ATTEMPTS):
            sent = self.link.send_instruction(self.number, bytes([Code.RESET]))
            self.link.pause(self.link.seconds(len(sent)) + self.link.patience / 4)
            if self.window.status().state is State.INI:
                self._on_reset()
                return
        raise StationNotResponding(f"{self._message_prefix}no reset in {ATTEMPTS} attempts: check the cable")

    def software_reset(self) -> None:
        """Reset the station with `reset`, because a line has no other reset."""
        self.reset()

    def _on_reset(self) -> None:
        super()._on_reset()
        self._slow_override = False

    # ------------------------------------------------------------------ internal

    def _position(self, encoder: bool) -> int:
        """Read the position until two successive reads agree, and return it.

        Two reads agree if the motor can have moved by their difference in the time between them.
        """
        times: list[float] = []

        def read() -> int:
            times.append(self.link.clock())
            return super(Station312, self)._position(encoder)

        def agree(last: int, now: int) -> bool:
            way = abs(signed((now - last) % (1 << 32)))
            if not way or (encoder and way <= _ENCODER_SLACK):
                return True
            setup = self.setup
            fastest = float(setup.clock.speed(setup.table.high)) if setup else _MOST_PPS
            return way <= 1 + fastest * (self.link.clock() - times[-2]) and self.window.status().busy

        return self.window.read_consistently(read, agree)

    def _register(self, block: bytes) -> None:
        """Register an override.

        The reply only confirms that the station has accepted the registration.
        """
        self.instruct(block)
        self._slow_override |= block[2] == Code.SLOW_STOP

    def _start(self, block: bytes, direction: int, requested: int | None = None) -> SerialMotion:
        # Read the reports that are pending now, because they are older than this motion.
        self.window.collect()
        return super()._start(block, direction, requested)
