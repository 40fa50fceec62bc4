"""Instructions to one station of a line, with their responses and errors.

An instruction whose reply is lost is repeated only if the repetition has no side effect.

`ppmc312.window.Window` does the same for the parallel bus.
"""

from __future__ import annotations

from collections.abc import Callable
from operator import eq
from typing import Protocol, TypeVar

from ....model.ppmc312.codes import MOTION_STARTS, OV, Cause, Code, Source, State
from ...errors import CommandRefused, NoAnswer, OutOfRange, ProtocolError
from ...line import CorruptReply, LostReply, unanswered
from ...line_port import Fault, MissingReply
from ..answers import (
    Alarm,
    EncoderChange,
    Executed,
    Failed,
    HoldExecuted,
    InPositionChange,
    InputChange,
    InterlockEnded,
    Report,
    Response,
    Status,
    Stopped,
)
from ..motion import Motion
from ..window import ANSWER_MS, SHORTEST
from .line import Error, Line, serial_command_error, serial_failure
from .wire import (
    BUSY,
    DATA,
    DATA_BYTES,
    END_STATUS,
    INPUTS_CHANGED,
    READY,
    SPECIFIC,
    Reply,
    line_data,
    response,
)

# After a lost reply, the driver determines whether the instruction was executed, so that no motion is
# executed twice. A repetition has no side effect if the instruction reads, sets a value or stops the motor. A
# start is checked by means of the state and the position. An instruction that toggles a state, or a
# registration, is checked by a comparison of the status before it with the status after it. In all other
# cases, LostReply is raised.

_TOGGLES = {Code.INTERLOCK: "interlock", Code.RUN_MONITOR: "run_monitored"}
_REGISTERED = (Code.STOP, Code.SLOW_STOP, Code.RAMP_CHANGE, Code.CHANGE)
_DELETE = 2


class StationState(Protocol):
    """Members of a `StationLink` that `LostReplyResolver` needs.

    Attributes:
        answers: number of responses of the station so far.
        busy: True if the last poll reported a motion.
    """

    answers: int
    busy: bool

    def status(self) -> Status: ...
    def collect(self) -> None: ...


class StationAccess(Protocol):
    """Members of a station (`station.Station312`) that `LostReplyResolver` needs."""

    @property
    def _message_prefix(self) -> str: ...
    @property
    def window(self) -> StationState: ...
    @property
    def motion(self) -> Motion | None: ...
    @property
    def position(self) -> int: ...


class LostReplyResolver:
    """Decides whether one instruction block was executed although its reply was lost.

    The object must be created before the block is sent, because it compares the states of the station before
    and after.

    Attributes:
        repeated: True if at least one reply was lost, so that the block may have been sent more than once.
    """

    def __init__(self, station: StationAccess, block: bytes) -> None:
        self._station = station
        self._block = block
        self.repeated = False
        motion = station.motion
        self._motion = motion if motion is not None and not motion.over else None
        self._was_busy = station.window.busy
        self._before: Status | None = None
        if block[2] in _TOGGLES or block[2] == Code.EVENT_SET or self._is_override:
            self._before = station.window.status()

    @property
    def _is_override(self) -> bool:
        return self._block[2] in _REGISTERED and bool(self._block[3] & OV)

    def resolve(self) -> bool:
        """Return True if the instruction was executed. Raises LostReply if that is unknown."""
        self.repeated = True
        code = self._block[2]
        try:
            if code in MOTION_STARTS:
                return self._started()
            if self._before is None:
                return False
            now = self._station.window.status()
            if code in _TOGGLES:
                toggled = _TOGGLES[Code(code)]
                return bool(getattr(now, toggled) != getattr(self._before, toggled))
            if code == Code.EVENT_SET:
                return self._buffered(now)
            return self._registered(now)
        except NoAnswer as error:
            raise self._lost_reply("the station has been silent since") from error

    def error_for(self, refusal: CommandRefused) -> Exception:
        """Return the exception to raise for a rejection.

        If a repeated change of speed is rejected, it is unknown whether the first transmission was executed.
        """
        if self.repeated and self._block[2] == Code.RAMP_CHANGE:
            return self._lost_reply(f"its repetition was rejected ({refusal})")
        return refusal

    def _started(self) -> bool:
        """Return True if the motion was started.

        The function checks the state, then the report of the end, then the position.
        """
        station, motion = self._station, self._motion
        if motion is None or self._was_busy:
            raise self._lost_reply("it is unknown what the motor did before")
        if station.window.status().busy:
            return True
        station.window.answers += 1  # later reports may contain the end of this motion
        station.window.collect()
        return motion.over or station.position != motion.begin

    def _registered(self, now: Status) -> bool:
        assert self._before is not None
        added = now.overrides - self._before.overrides
        if added == 1:
            return True
        if added == 0 and not now.busy and not now.override_events:
            return False  # the motor is stopped and no override waits for an event: none was executed
        raise self._lost_reply("overrides may have been executed since")

    def _buffered(self, now: Status) -> bool:
        assert self._before is not None
        number = (self._block[3] & 1) + 1
        filled, was = number in now.events, number in self._before.events
        if self._block[3] & _DELETE:
            if was and filled:
                raise self._lost_reply(f"event buffer {number} is still not empty")
            return was
        if was:
            raise self._lost_reply(f"event buffer {number} was not empty before")
        return filled

    def _lost_reply(self, reason: str) -> LostReply:
        return LostReply(
            f"{self._station._message_prefix}the reply to an instruction was lost, so it may have "
            f"been executed; {reason}: "
            "check the status of the station before you repeat the instruction"
        )


T = TypeVar("T")
ATTEMPTS = 5
MOST_REPORTS = 32
END_CODES = {
    0x31: Cause.ALARM,
    0x32: Cause.ORIGIN,
    0x33: Cause.LIMIT,
    0x34: Cause.LIMIT_SLOW,
    0x36: Cause.SLOW,
    0x37: Cause.STOP,
    0x38: Cause.NORMAL,
    0x39: Cause.LOW,
}
DAMAGED = (Error.CHECKSUM, Error.COMMAND)
"""Error codes that mean that the frame was damaged on the line, because the driver sends no unknown codes."""
_STOPPING = (Code.STOP, Code.SLOW_STOP)
_CHECK = "is it there and powered, are speed (MOD), address and the two wires right?"
_OTHERS = "noise, another speed or checksum rule, or two stations with this address"


class Station(StationAccess, Protocol):
    """Members of a station (`station.Station312`) that `StationLink` needs."""

    @property
    def number(self) -> int: ...
    def status(self) -> Status: ...
    def _on_report(self, report: Report) -> None: ...


class StationLink:
    """The transport of instructions to a station; see `ppmc312.core.Instructions`.

    Attributes:
        answers: number of responses of the station so far.
        busy: True if the last poll reported a motion.
    """

    def __init__(self, line: Line, station: Station) -> None:
        self._line = line
        self._station = station
        self._alarmed = False
        self.answers = 0
        self.busy = False

    @property
    def _number(self) -> int:
        return self._station.number

    def open(self) -> None:
        """Clear the record of the alarm. After a reset, a station needs no other preparation."""
        self._alarmed = False

    def next_block(self) -> Response:
        """Raise OutOfRange, because a response on a line has only one block."""
        raise OutOfRange("answers of several blocks: only on the parallel bus")

    # ------------------------------------------------------------------ instructions

    def execute(self, block: bytes, gives: int = SHORTEST, milliseconds: int = ANSWER_MS) -> Response:
        """Execute an instruction; return its response in the form that it has on the parallel bus.

        Args:
            milliseconds: longest execution time on the parallel bus.

        Raises:
            CommandRefused: the station rejected the instruction.
            LostReply: it is unknown whether the instruction was executed.
            StationNotResponding, CorruptReply, LinkError: the line failed.
        """
        data = line_data(block)
        resolver = LostReplyResolver(self._station, block)
        reply = self.request(data, max(0, milliseconds - ANSWER_MS) / 1000, resolver.resolve)
        self.answers += 1
        error = reply.error
        if error is None:
            return response(block, reply)
        if resolver.repeated and block[2] in _STOPPING and error == Error.STATUS and self._ended():
            return response(block, reply)
        if block[2] == Code.EVENT_SET and block[3] & 2 and error == Error.REGISTRATION:
            return Response(bytes([3, 2, Code.EVENT_SET, 5]))
        state = self._station.status().raw if error == Error.STATUS else None
        raise resolver.error_for(serial_command_error(self._station._message_prefix, block[2], error, state))

    def read(self, code: int) -> bytes:
        """Execute a read instruction that only the serial mode has. Raises the error of the station."""
        reply = self.request(bytes([code]))
        if reply.error is None:
            return reply.data
        state = self.status().raw if reply.error == Error.STATUS else None
        raise serial_command_error(self._station._message_prefix, code, reply.error, state)

    def _ended(self) -> bool:
        """Return True if the motion of this object is over."""
        self.collect()
        motion = self._station.motion
        return motion is not None and motion.over

    def request(
        self,
        data: bytes | None,
        extra: float = 0.0,
        resolve: Callable[[], bool] = lambda: False,
        attempts: int = ATTEMPTS,
    ) -> Reply:
        """Send a frame and return its reply; send it up to `attempts` times until the reply is valid.

        Args:
            data: code and data, `None` for a poll.
            resolve: called after a lost reply. If it returns True, the instruction was executed and is not
                repeated. It may raise an exception.

        Raises:
            StationNotResponding, CorruptReply: no valid reply was received.
        """
        counters = self._line.counters[self._number]
        misses: list[MissingReply] = []
        refusal: Reply | None = None
        gives = 1 if data is None else DATA_BYTES.get(data[0], 0)
        for attempt in range(attempts):
            counters.repeated += attempt > 0
            got = self._line.exchange(self._number, data, gives, extra)
            if not isinstance(got, MissingReply) and not plausible(data, got):
                # The checksum does not protect the highest bit of a byte, so check the content, too.
                counters.garbled += 1
                got = MissingReply(Fault.BROKEN, got.data or b"?")
            if isinstance(got, MissingReply):
                misses.append(got)
                if resolve():
                    return Reply(self._number, READY, b"")
            elif got.error in DAMAGED:
                counters.refused += 1  # no instruction was executed
                refusal = got
            else:
                return got
        if refusal is not None and refusal.error == Error.COMMAND and not misses:
            return refusal
        raise unanswered(f"{self._line.name}: station {self._number}", misses, attempts, _CHECK, _OTHERS)

    def read_consistently(self, read: Callable[[], T], agree: Callable[[T, T], bool] = eq) -> T:
        """Read a value until two successive reads agree, and return it.

        A damaged reply may seem valid: the checksum has seven bits and does not protect the highest bit of a
        byte.

        Raises:
            CorruptReply: the reads do not agree.
        """
        last = read()
        for _ in range(ATTEMPTS):
            now = read()
            if agree(last, now):
                return now
            self._line.counters[self._number].garbled += 1
            last = now
        where = f"{self._line.name}: station {self._number}"
        raise CorruptReply(f"{where}: {ATTEMPTS} pairs of replies that do not agree: {_OTHERS}")

    # ------------------------------------------------------------------ polls

    def collect(self) -> None:
        """Poll until no report is pending; pass the reports to the station."""
        counters = self._line.counters[self._number]
        before = counters.faults
        for _ in range(MOST_REPORTS):
            reply = self.request(None)
            if reply.kind in (BUSY, READY):
                self.busy = reply.kind == BUSY
                break
            self._station._on_report(self._report(reply))
        else:
            raise ProtocolError(f"{self._line.name}: station {self._number} reports without end: reset it")
        if counters.faults != before:
            counters.lost_reports += 1
            self._check_alarm()

    def _check_alarm(self) -> None:
        """Read the state, because a lost reply may have contained the report of an alarm."""
        alarmed = self._station.status().state is State.ABN
        if alarmed and not self._alarmed:
            self._station._on_report(Alarm(0))
        self._alarmed = alarmed

    def end_status(self) -> Cause | None:
        """Return why the last motion ended, `None` if no motion has ended since the reset."""
        return END_CODES.get(self.request(bytes([END_STATUS])).data[0])

    def stop_report(self, cause: Cause) -> Stopped:
        """Return the report of the end of a motion.

        The driver reads the position, because the report on the line does not contain it.
        """
        return Stopped(cause, self._station.position)

    def _report(self, reply: Reply) -> Report:
        """Decode the report in a reply to a poll."""
        code = reply.data[0]
        if reply.kind == DATA:
            return self.stop_report(END_CODES[code])
        if code == INPUTS_CHANGED:
            return InputChange(reply.data[2], bool(reply.data[1]))
        if code in _FAILED:
            by = _FAILED[Error(code)]
            return Failed(by, serial_failure(self._station._message_prefix, by))
        report = _REPORTS[code]
        self._alarmed |= isinstance(report, Alarm)
        return report

    def status(self) -> Status:
        """Read the status; the attribute `answers` does not change."""
        return self.read_consistently(lambda: Status.parse(self.request(bytes([Code.STATUS])).data))


_REPORTS: dict[int, Report] = {
    0x46: Alarm(0),
    0x28: Executed(Source.OVERRIDE, None),
    0x29: Executed(Source.EVENT, None),
    0x22: InterlockEnded(),
    0x23: HoldExecuted(),
    0x26: InPositionChange(False),
    0x27: InPositionChange(True),
    0x24: EncoderChange(False),
    0x25: EncoderChange(True),
}
_FAILED = {Error.EVENT_FAILED: Source.EVENT, Error.OVERRIDE_FAILED: Source.OVERRIDE}
_SPECIFIC = {*_REPORTS, *_FAILED, INPUTS_CHANGED, Error.CHECKSUM}


def plausible(data: bytes | None, reply: Reply) -> bool:
    """Return True if a station may send this reply to a poll (`data` is `None`) or to an instruction.

    >>> plausible(bytes([Code.STATUS]), Reply(1, DATA, bytes([0, 0x82, 0])))
    False
    >>> plausible(None, Reply(1, BUSY, b""))
    True
    """
    code = reply.data[0] if reply.data else 0
    if data is None:
        known = {DATA: END_CODES, BUSY: {0}, READY: {0}}.get(reply.kind, _SPECIFIC)
        return code in known
    if reply.kind == SPECIFIC:
        return Error.CHECKSUM <= code <= Error.REGISTRATION
    if reply.kind != (DATA if data[0] in DATA_BYTES else READY):
        return False
    if data[0] == END_STATUS:
        return code == 0 or code in END_CODES
    return data[0] != Code.STATUS or reply.data[1] in set(State)
