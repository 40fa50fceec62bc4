"""PPMC-312 without its motions: registers, positions, terminals, reports."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from ...lazy import Renamed
from ...model.ppmc312.codes import Code, Source, State
from .. import speeds
from ..capabilities import SetupRequest
from ..check import Checked
from ..errors import OutOfRange, ProtocolError
from ..motion_result import MotionResult, position_lost
from . import blocks
from .answers import Alarm, BadResponse, Executed, Failed, Inputs, Report, Response, Status, Stopped, signed
from .errors import MISSED
from .motion import Motion, Transport
from .profile import CAPABILITIES, Setup, TableCapabilities, plan_stages, read_stages
from .window import ANSWER_MS, SHORTEST

MOST_KEPT = 1000
MotionT = TypeVar("MotionT", bound=Motion)


class Instructions(Protocol):
    """The transport of instructions to a part.

    `window.Window` transports them through the bridge, `line.station_link.StationLink` through a line.
    """

    @property
    def answers(self) -> int:
        """Number of responses so far.

        If a report arrives after a response, the part has executed the instruction of this response before it
        sent the report.
        """

    def open(self) -> None:
        """Prepare the transport after a reset of the part."""

    def execute(self, block: bytes, gives: int = SHORTEST, milliseconds: int = ANSWER_MS) -> Response:
        """Execute an instruction block and return its response.

        Raises the error that the part reports, or a LinkError.
        """

    def next_block(self) -> Response:
        """Return the next block of a response of several blocks."""

    def collect(self) -> None:
        """Read the pending responses."""


class Core(Checked, Generic[MotionT]):
    """Registers, positions, terminals and reports; see `ppmc312.Ppmc312`.

    Attributes:
        setup: table that this object has loaded last, `None` if it has loaded none.
        reports: unsolicited reports that the caller has not fetched yet, oldest first. A report of the end of
            a motion that this object started is not stored here; it sets the `result` of the motion. If there
            are more than 1000 reports, the oldest are dropped.
    """

    kind: TableCapabilities
    number = 1
    _busy_mask = 0x2C
    _message_prefix = ""
    link: Transport
    window: Instructions
    setup: Setup | None
    reports: deque[Report]
    attend = Renamed("process_reports")

    def __init__(self, link: Transport) -> None:
        self.link = link
        self.setup = None
        self.reports = deque(maxlen=MOST_KEPT)
        self._motion: MotionT | None = None
        self._mark = 0
        self._waiting: int | None = None  # overrides and event buffers that wait, `None` if unknown
        self._alarm_status = 0
        self._known_position = 0
        self.window = self._make_window()
        self.window.open()

    def _make_window(self) -> Instructions:
        """Create the transport for instructions to the part and for its responses."""
        raise NotImplementedError

    def _make_motion(self, requested: int | None, direction: int, begin: int | None) -> MotionT:
        """Create the handle of a motion; see `motion.Motion`."""
        raise NotImplementedError

    @property
    def motion(self) -> MotionT | None:
        """Motion that was started last, `None` before the first."""
        return self._motion

    def _annotate(self, end: MotionResult) -> MotionResult:
        """Return the result `end` with the message prefix and the name of the last alarm of this part."""
        alarm = MISSED.get(self._alarm_status, self.kind.alarm)
        return replace(end, message_prefix=self._message_prefix, alarm=alarm)

    def _may_poll(self) -> bool:
        """Return True if reading the part during a motion cannot cause an alarm."""
        return True

    # ------------------------------------------------------------------ instructions

    def instruct(self, block: bytes, gives: int = 3, milliseconds: int = ANSWER_MS) -> bytes:
        """Execute any instruction block in logical order (`blocks`); return the parameters of the response.

        Raises the error that the part reports.
        """
        response = self.window.execute(block, gives, milliseconds)
        if response.code != block[2]:
            raise self._wrong_answer(response, block[2])
        return response.data

    def _wrong_answer(self, response: Response, code: int) -> ProtocolError:
        """Return the exception for a response that does not belong to the instruction `code`."""
        return ProtocolError(
            f"{self.link.name}: the part answers {response.code:02X} to {code:02X}: does another "
            "program use it?"
        )

    def _plain(self, code: int, gives: int = 0) -> bytes:
        """Execute an instruction without parameters, and return the parameters of its response.

        Args:
            gives: number of parameters of its response.
        """
        return self.instruct(blocks.block(code), 3 + gives)

    # ------------------------------------------------------------------ reports

    def _on_response(self, response: Response) -> None:
        """Process a response or report that does not belong to an instruction of this object."""
        try:
            report = response.report()
        except BadResponse as error:
            raise ProtocolError(f"{self.link.name}: {error}") from error
        self._store_report(report)

    def _store_report(self, report: Report) -> None:
        """Pass a report to the motion that it ends, or store it."""
        motion = self._motion
        younger = self.window.answers > self._mark
        if isinstance(report, Stopped) and motion is not None and not motion.over and younger:
            motion._on_stop_report(report)
        else:
            if isinstance(report, Executed) and report.code == Code.SLOW_STOP and motion is not None:
                motion.stop_ordered = True
            if isinstance(report, (Executed, Failed)) and report.by is Source.OVERRIDE and self._waiting:
                self._waiting -= 1
            if isinstance(report, Alarm):
                self._alarm_status = report.status
            self.reports.append(report)

    def next_report(self, timeout: float = 0) -> Report | None:
        """Return the oldest report that was not fetched yet.

        If no report arrives within `timeout` seconds, the call returns `None`.
        """
        end = self.link.clock() + timeout
        if not self.reports:
            self.window.collect()
        while not self.reports and (left := end - self.link.clock()) > 0:
            self.link.wait_event(min(left, 0.5))
            self.window.collect()
        return self.reports.popleft() if self.reports else None

    def process_reports(self, seconds: float) -> None:
        """Process unsolicited reports of the part for `seconds`, measured with the clock of the port."""
        end = self.link.clock() + seconds
        while (left := end - self.link.clock()) > 0:
            if self.link.wait_event(left) is not None:
                self.window.collect()

    # ------------------------------------------------------------------ registers

    def status(self) -> Status:
        """Return state, monitors and registered instructions. The call is allowed at any time."""
        return Status.parse(self._plain(Code.STATUS, 3))

    def inputs(self) -> Inputs:
        """Return switches and other inputs. The call is allowed at any time."""
        return Inputs.parse(self._plain(Code.TERMINALS, 2))

    def version(self) -> int:
        """Return the version byte of the part."""
        return self._plain(Code.VERSION, 1)[0]

    @property
    def position(self) -> int:
        """Pulse position of the part, CW positive. The call is allowed at any time.

        Raises:
            ProtocolError: the position is 0 because the part was reset. The next call after this error
                returns 0.
        """
        return self._check_position(self._position(False))

    def _check_position(self, position: int) -> int:
        """Check a position, and return it.

        Raises:
            ProtocolError: a reset of the part has set the position to 0. The driver detects this because the
                part has the state INI.
        """
        known, self._known_position = self._known_position, position
        if known and not position and self.status().state is State.INI:
            raise position_lost(f"{self.link.name}: {self._message_prefix}", known)
        return position

    @property
    def encoder(self) -> int:
        """Encoder position of the part. The call is allowed at any time."""
        return self._position(True)

    def _position(self, encoder: bool) -> int:
        data = self.instruct(blocks.read_position(encoder), 8)
        return signed(int.from_bytes(data[1:5], "big"))

    def _position_of(self, count: int) -> int | None:
        """Return the position that a pulse count means: here, the count itself.

        In the drivers of other parts, the result may be `None`.
        """
        return count

    def set_position(self, position: int, encoder: bool = False) -> None:
        """Set the position of the pulses, or of the encoder.

        Raises:
            AxisBusy: the motor is moving.
        """
        self.instruct(blocks.set_position(position, encoder))
        if not encoder:
            self._known_position = position

    def zero(self) -> None:
        """Set the current position of pulses and encoder to 0."""
        self.set_position(0)
        self.set_position(0, encoder=True)

    # ------------------------------------------------------------------ terminals

    def excitation_on(self) -> None:
        """Activate the output EXON. The motor must be stopped."""
        self._plain(Code.EXCITATION_ON)

    def excitation_off(self) -> None:
        """Deactivate the output EXON. The motor must be stopped. The table is kept."""
        self._plain(Code.EXCITATION_OFF)

    def counter_clear(self) -> None:
        """Output a pulse of 24.6 ms (at 16 MHz) on CCLR. The motor must be stopped."""
        self._plain(Code.COUNTER_CLEAR)

    def zero_clamp(self) -> None:
        """Activate the output ZCLMP until the next start. The motor must be stopped."""
        self._plain(Code.ZERO_CLAMP)

    def clear_alarm(self) -> None:
        """Output a pulse of 24.6 ms on ACLR.

        The part then leaves the alarm state if the alarm input is not active.
        """
        self._plain(Code.ALARM_CLEAR)

    def aux_inputs(self) -> int:
        """Return the levels of the eight general inputs."""
        return self._plain(Code.INPUT, 1)[0]

    def auxo(self, value: int) -> None:
        """Set the six general outputs, 0 to 63; a 1 sets its pin low."""
        self.instruct(blocks.outputs(value))

    # ------------------------------------------------------------------ reset

    def software_reset(self) -> None:
        """Execute the reset instruction, which has the same effect as the reset pin."""
        self._plain(Code.RESET)
        self._on_reset()

    def _on_reset(self) -> None:
        """Discard set-up, motion and reports, because the part was reset."""
        self.setup = self._motion = None
        self._known_position = self._waiting = 0
        self.reports.clear()
        self.window.open()


# Settings of a PPMC-312: tables, monitors, interlock, limits.

LONGEST_BUILD_MS = 300
ITEM_RATES, ITEM_UP, ITEM_DOWN = 1, 2, 3


@dataclass(frozen=True)
class TableRead:
    """Table as stored in the part, fastest stage first.

    Attributes:
        rates: pulse interval of each stage, in base clock cycles.
        up: pulses of each stage of the acceleration.
        down: pulses of each stage of the deceleration; empty if the deceleration is the reversed
            acceleration.
    """

    rates: tuple[int, ...]
    up: tuple[int, ...]
    down: tuple[int, ...]


class Settings(Core[MotionT]):
    """Tables, monitors, interlock and limits; see `ppmc312.Ppmc312`."""

    # ------------------------------------------------------------------ tables

    def initialise(
        self,
        start_pps: speeds.Number = 1000,
        high_pps: speeds.Number = 5000,
        ramp_pulses: int = CAPABILITIES.usual_ramp,
        stop_pps: speeds.Number | None = None,
        down_pulses: int | None = None,
        sigmoid: bool = False,
        base_clock: speeds.Number | None = None,
        external_clock: speeds.Number | None = None,
    ) -> Setup:
        """Set speeds and ramps; return the set-up with the values that are reached.

        The call clears overrides and event buffers.

        Args:
            start_pps: start speed, 0.24 pps to 4 Mpps; the range depends on the base clock (original part: up
                to 2 Mpps).
            high_pps: high speed in the same range.
            ramp_pulses: pulses from start to high speed, 24 bits.
            stop_pps: final speed of a separate deceleration ramp.
            down_pulses: pulses of a separate deceleration ramp.
            sigmoid: True for S-shaped ramps.
            base_clock: 8e6, 1e6, 500e3, 250e3, 62.5e3 or 15.625e3 Hz at a 16 MHz crystal; `None`: the fastest
                clock that reaches the start speed and the stop speed.
            external_clock: frequency at the pin EXTCK in Hz.

        Raises:
            OutOfRange: an argument is out of range.
            AxisBusy: a motion is running.
        """
        request = SetupRequest(
            start_pps,
            high_pps,
            ramp_pulses,
            base_clock=base_clock,
            external_clock=external_clock,
            stop_pps=stop_pps,
            down_pulses=down_pulses,
            sigmoid=sigmoid,
        )
        return self.apply(self.kind.plan(self.link.identity.xtal_hz, request))

    def load_curve(
        self,
        stages: Iterable[Sequence[float | int | None]] | str | Path,
        base_clock: speeds.Number | None = None,
        external_clock: speeds.Number | None = None,
    ) -> Setup:
        """Load a free curve and return its set-up.

        Args:
            stages: 2 to 127 stages (pps, pulses up[, pulses down]), slowest first, or the path of a CSV file
                with such lines.
            base_clock, external_clock: as for `initialise`.

        Raises:
            OutOfRange: the curve is invalid.
        """
        rows = read_stages(Path(stages)) if isinstance(stages, (str, Path)) else stages
        return self.apply(plan_stages(self.link.identity.xtal_hz, rows, base_clock, external_clock))

    def apply(self, setup: Setup) -> Setup:
        """Initialise the part with a set-up planned earlier, and switch the excitation on."""
        if self._known_position:
            self._check_position(self._position(False))
        self.setup = None
        milliseconds = ANSWER_MS
        if self.link.identity.datasheet:
            milliseconds += LONGEST_BUILD_MS * 16_000_000 // self.link.identity.xtal_hz
        for block in setup.blocks:
            self.window.execute(block, 5, milliseconds)
        self.excitation_on()
        self.setup = setup
        return setup

    def read_table(self) -> TableRead:
        """Return the table of the part. The motor must be stopped.

        Raises NotInitialised without a table.
        """
        response = self.window.execute(blocks.block(Code.TABLE_READ), 12)
        if response.code != Code.TABLE_READ:
            raise ProtocolError(f"{self.link.name}: expected the table, received {response.raw.hex(' ')}")
        items: dict[int, bytearray] = {ITEM_RATES: bytearray(), ITEM_UP: bytearray(), ITEM_DOWN: bytearray()}
        while not response.last:
            response = self.window.next_block()
            items.setdefault(response.data[0], bytearray()).extend(response.data[1:])
        return TableRead(
            *(_numbers(items[item], width) for item, width in ((ITEM_RATES, 2), (ITEM_UP, 3), (ITEM_DOWN, 3)))
        )

    def rate_of(self, pps: speeds.Number, what: str = "speed") -> int:
        """Return the rate of a speed within the table.

        Raises OutOfRange if the table does not contain the speed, or if this object has loaded no table.
        """
        return self.known_setup().rate_of(pps, what)

    def known_setup(self) -> Setup:
        """Return the table that this object has loaded. Raises OutOfRange if there is no such table."""
        if self.setup is None:
            raise OutOfRange("a speed needs a base clock, which an initialisation chooses: initialise first")
        return self.setup

    # ------------------------------------------------------------------ monitors, limits

    def watch_position(self, distance: int | None, auto: bool = True, clamp: bool = False) -> None:
        """Set the in-position monitor, which reports at standstill (`InPositionChange`).

        Args:
            distance: largest permitted difference of pulse position and encoder position, 1 to 65 535. The
                part reports when the difference exceeds it, and when the difference is permitted again.
                `None` switches the monitor off.
            auto: True for a report of each change, False for one report.
            clamp: True if ZCLMP is active while the difference does not exceed `distance`.
        """
        self.instruct(blocks.in_position(distance is not None, distance or 0, auto, clamp))

    def watch_encoder(self, distance: int | None, auto: bool = True) -> None:
        """Set the encoder monitor, which also reports during motions (`EncoderChange`).

        The monitor detects lost steps and a motor that does not move. The arguments are those of
        `watch_position`.
        """
        self.instruct(blocks.encoder_watch(distance is not None, distance or 0, auto))

    def limit_speed(self, pps: speeds.Number) -> None:
        """Set the speed limit that applies while a slow-down limit is active.

        While a slow-down limit is active, the motor runs below this speed. Each new table sets the limit to
        its high speed.
        """
        rate = self.known_setup().clock.choose(pps).rate
        self.instruct(blocks.speed_limit(rate))

    def monitor_end(self, on: bool) -> None:
        """Set whether a motion ends only when the input END is active."""
        self.instruct(blocks.end_terminal(on), 4)

    def monitor_run(self, on: bool) -> None:
        """Set whether starts wait for the input RUN; False starts a motion that is waiting."""
        if self.status().run_monitored != on:
            self._plain(Code.RUN_MONITOR, 1)

    def interlock(self, position: int | None) -> None:
        """Activate the output INTLK until the pulse position reaches this value.

        Then the part reports `InterlockEnded`. `None` deactivates the output immediately.
        """
        running = self.status().interlock
        if running:
            self._plain(Code.INTERLOCK, 1)
        if position is not None:
            self.instruct(blocks.interlock_position(position))
            self._plain(Code.INTERLOCK, 1)

    def watch_inputs(self, mask: int, auto: bool = True) -> None:
        """Select the general inputs whose changes are reported (`InputChange`).

        Args:
            mask: bits of the inputs, 0 for no reports.
            auto: True for a report of each change, False for one report.
        """
        self.instruct(blocks.input_mask(mask, auto))


def _numbers(data: bytes | bytearray, width: int) -> tuple[int, ...]:
    return tuple(int.from_bytes(data[k : k + width], "big") for k in range(0, len(data), width))
