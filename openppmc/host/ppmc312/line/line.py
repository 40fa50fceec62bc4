"""Line with PPMC-312 in serial mode.

`Line` transfers one frame and its reply, and counts faults. It does not repeat frames.
"""

# ruff: noqa: N818

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING

from ....model.ppmc312.codes import Code, Source, State
from ....parts import part
from ...capabilities import COILS_OFF, CURVES
from ...errors import AxisBusy, CommandRefused, OutOfRange, PortError, StartRefused, UnknownCommand
from ...line import PATIENCE, LineEcho, Master
from ...line_port import Counters, MissingReply, open_line
from ...port import Port
from ...script import Identity
from .. import profile
from ..errors import (
    LIMIT,
    STATES,
    EventFailed,
    InvalidBlockLength,
    OverrideFailed,
    ParameterRefused,
    RateRefused,
    RegistrationRefused,
    TableRefused,
)
from .wire import (
    INSTRUCTION,
    POLL,
    SPEEDS,
    STATIONS,
    Receiver,
    Reply,
    SumMode,
    frame,
    station_number,
    sum_mode_of,
)

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings

# Capabilities of the stations of a line: PPMC-312 in serial mode.


class LineCapabilities(profile.TableCapabilities):
    """Capabilities of a line. Each station is an axis; the numbers begin with 0."""

    def check_axis(self, axis: int) -> int:
        return station_number(axis)


CAPABILITIES = LineCapabilities(
    part("ppmc312-serial"),
    axes=STATIONS,
    has=frozenset((COILS_OFF, CURVES)),
    outputs=profile.CAPABILITIES.outputs,
    alarm=profile.CAPABILITIES.alarm,
    origin_between=profile.CAPABILITIES.origin_between,
    usual_ramp=profile.CAPABILITIES.usual_ramp,
)


# Errors of a line of PPMC-312 and its stations, as exceptions.


class Error(IntEnum):
    """Error codes in replies."""

    CHECKSUM = 0x41
    PARAMETER = 0x42
    STATUS = 0x43
    LIMIT = 0x44
    ALARM = 0x46
    COMMAND = 0x47
    SIZE = 0x48
    REGISTRATION = 0x49
    EVENT_FAILED = 0x4A
    OVERRIDE_FAILED = 0x4B


_SERIAL_PARAMETERS: dict[int, tuple[type[ParameterRefused], str]] = {
    Code.INITIAL: (
        TableRefused,
        "the part rejects this table: the speeds are too close, or the ramp is too short",
    ),
    **dict.fromkeys(
        (Code.RAMP, Code.CONSTANT),
        (RateRefused, "the speed is outside those of the table, or there are no pulses"),
    ),
    **dict.fromkeys(
        (Code.FOREVER_RAMP, Code.FOREVER_CONSTANT, Code.ORIGIN_SEARCH, Code.ZERO_RETURN, Code.RAMP_CHANGE),
        (RateRefused, "the speed is outside those of the table"),
    ),
    Code.CHANGE: (RateRefused, "the speed is outside those of the table"),
}
_STOPPING = (Code.STOP, Code.SLOW_STOP, Code.RAMP_CHANGE, Code.CHANGE)


def serial_command_error(prefix: str, code: int, error: int, state: int | None = None) -> CommandRefused:
    """Return the exception for an error code in a reply.

    Args:
        prefix: prefix of the message.
        code: code that the instruction has on the parallel bus.
        state: condition byte of the part, which the driver reads after error 43.

    >>> str(serial_command_error("station 3: ", 0x82, 0x43, 0x10))
    'station 3: the part is in alarm: remove the cause, then clear the alarm (or reset)'
    >>> str(serial_command_error("", 0x82, 0x43, 0x02))
    'the part was busy with a motion: try again'
    """
    kind: type[CommandRefused]
    if error == Error.PARAMETER:
        kind, text = _SERIAL_PARAMETERS.get(
            code, (ParameterRefused, "the part rejects a value of this instruction")
        )
    elif error == Error.STATUS:
        if state == State.NOR and code not in _STOPPING:
            kind, text = AxisBusy, "the part was busy with a motion: try again"
        else:
            kind, text = STATES.get(state or 0, (AxisBusy, ""))
    elif error == Error.LIMIT:
        kind, text = StartRefused, LIMIT
    elif error == Error.COMMAND:
        kind, text = UnknownCommand, ""
    elif error == Error.SIZE:
        kind, text = InvalidBlockLength, "an event buffer takes instructions of up to 10 bytes in serial mode"
    elif error == Error.REGISTRATION:
        kind, text = (
            RegistrationRefused,
            "all places are taken, or the event is in use by an override or buffer",
        )
    else:
        kind, text = CommandRefused, f"the part rejects this instruction (error {error:02X})"
    return kind(error, prefix + (text or kind.text))


def serial_failure(prefix: str, by: Source) -> CommandRefused:
    """Return the exception for an override interruption (4B) or event interruption (4A)."""
    if by is Source.OVERRIDE:
        return OverrideFailed(0, f"{prefix}an override was not executed; the others are discarded")
    return EventFailed(0, f"{prefix}an event's instruction was not executed; its buffer is empty now")


XTAL_HZ = 16_000_000


class Line(Master[Reply]):
    """Master of a line.

    Args:
        spec: any port that pyserial supports (`/dev/ttyUSB0`, `COM3`, `socket://host:port`, `rfc2217://…`),
            `sim:…` or `model:…`.
        speed: 19200, 38400 or 83333 bit/s; the MOD pins of the stations must select the same rate.
        sum_mode: how the stations calculate the checksum.
        echo: True if the master receives its own bytes, as with two-wire adapters that do not switch their
            receiver off.
        rs485: settings of pyserial for adapters whose transmitter is switched by RTS.
        patience: time in s that the master waits for a reply in addition to the transmission time on the
            line.
        xtal_hz: crystal frequency of the stations in Hz; the line rates above are valid for 16 MHz and are
            proportional to it.

    Raises:
        PortError: the port cannot be opened.
    """

    def __init__(
        self,
        spec: str | Port,
        speed: int = SPEEDS[0],
        sum_mode: SumMode = SumMode.BINARY,
        echo: bool = False,
        rs485: RS485Settings | None = None,
        patience: float = PATIENCE,
        xtal_hz: int = XTAL_HZ,
    ) -> None:
        if speed not in SPEEDS:
            raise PortError(
                f"{speed} bit/s is no speed of a line: there are {', '.join(map(str, SPEEDS))} (pins MOD)"
            )
        known = sum_mode_of(sum_mode)
        self.check_patience(patience)
        if not 1_000_000 <= xtal_hz <= XTAL_HZ:
            raise OutOfRange(f"crystal {xtal_hz} Hz is outside 1000000 to {XTAL_HZ} Hz")
        baud = round(speed * xtal_hz / XTAL_HZ)
        port = open_line(spec, baud, "ppmc312-serial", rs485) if isinstance(spec, str) else spec
        super().__init__(port, baud, echo, patience)
        self.sum_mode = known
        # The stations do not report their TIMING, so the master uses the time limits of DATASHEET timing.
        self.identity = Identity(1, 312, True, True, 0, xtal_hz, xtal_hz, STATIONS)
        self.counters = {number: Counters() for number in range(STATIONS)}

    # ------------------------------------------------------------------ frames

    def exchange(
        self, station: int, data: bytes | None, gives: int = 1, extra: float = 0.0
    ) -> Reply | MissingReply:
        """Send a frame and return its reply.

        Args:
            data: code and data of an instruction, `None` for a poll.
            gives: number of data bytes of a data reply.
            extra: additional time in s that the station may need.

        Raises:
            LineEcho, Disconnected: the line or the port failed.
        """
        sent = self._frame(station, data)
        got = self.request(station, sent, Receiver(station, gives, self.sum_mode), extra)
        if isinstance(got, MissingReply) and got.received.startswith(sent) and not self.echo:
            raise LineEcho(f"{self.name}: the master receives its own bytes: set --line echo (echo=True)")
        return got

    def send_instruction(self, station: int, data: bytes | None) -> bytes:
        """Send a frame, discard its echo, if any, and return the frame.

        Bytes received before are discarded.
        """
        sent = self._frame(station, data)
        self.send(station, sent)
        return sent

    def _frame(self, station: int, data: bytes | None) -> bytes:
        control = (POLL if data is None else INSTRUCTION) | station_number(station)
        return frame(control, data or b"", self.sum_mode)
