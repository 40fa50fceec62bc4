"""PPMC-312 as one of sixteen stations on a line: the host side of its serial mode.

Rules: P312-SER-10..22, -30, -45, -46. `serial` defines frames and codes; `uart` models the bits.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import ceil
from typing import NamedTuple, Protocol

from ...chip import Context, Phase
from ...clock import Event
from ...uart import Receiver, Transmitter
from ..codes import Answer, Cause, Source, State
from ..timing import SILENCE, CoreTiming
from .responses import Responses
from .serial import (
    BUSY,
    DATA,
    END_CODES,
    LENGTHS,
    READY,
    SPECIFIC,
    Frame,
    Local,
    Outcome,
    Parser,
    ReportCode,
    addressed,
    block_of,
    frame,
    poll_reply_of,
    reply_of,
)

# Members of a host side that the part uses. A host side is the parallel bus (`mailbox`) or the line
# (`station`).


class HostSide(Protocol):
    """Host side of the part: parallel registers or serial station."""

    def levels(self) -> dict[str, int]:
        """Return the internal levels of the pins of this side."""

    def notify_response(self, t: int) -> None:
        """Process the event that a store may contain a new response or report."""

    def done(self, t: int) -> None:
        """Process the end of an instruction that the host sent; its response has been stored."""

    def ready(self, t: int) -> None:
        """Enable the interface."""

    def answer(self, t: int, source: Source, block: bytes) -> None:
        """Send the response to an instruction.

        Only the serial mode uses this method: it sends responses to instructions directly, without a store.
        """


_MAX_COUNT = 255
_STORED_ERRORS = (
    ReportCode.PARAMETER,
    ReportCode.STATUS,
    ReportCode.LIMIT,
    ReportCode.UNKNOWN,
    ReportCode.SIZE,
    ReportCode.REGISTRATION,
)
"""Values that the error-code register stores (P312-SER-45)."""


class Unit(Protocol):
    """Unit that executes instructions."""

    def host_block(self, t: int, block: bytes) -> None:
        """Process a complete block; the write event of its header is at edge t."""


class Operation(Protocol):
    """Last operation that moved the motor."""

    @property
    def last_cause(self) -> Cause | None:
        """Cause of the last stop report."""


class Core(Protocol):
    """Members of the part that a station uses."""

    context: Context
    core_timing: CoreTiming
    responses: Responses

    @property
    def unit(self) -> Unit:
        """Unit that executes instructions."""

    @property
    def operation(self) -> Operation:
        """Last operation that moved the motor."""

    @property
    def state(self) -> State:
        """Operation state (docs/ppmc312/README.md, 7 States)."""


class Log(NamedTuple):
    """Logs of the line.

    An entry of `replies` is (edge at which snd rises, frame). An entry of `sent` is (edge in the middle of
    the stop bit, character).
    """

    replies: list[tuple[int, bytes]]
    sent: list[tuple[int, int]]


class Driver(NamedTuple):
    """The parameters SND_LEAD and SND_WAIT, in bit times (P312-SER-18).

    Attributes:
        lead: SND_LEAD, from the rising edge of snd to the start bit.
        wait: SND_WAIT. snd does not rise before half a bit time plus this delay after the last character.
    """

    lead: int
    wait: int


class Station:
    """Station on a line.

    Args:
        bit: bit time in cycles, `None` for a station that does not send.
        address: 0..15.
        mode: SUM_MODE.
        log: log of all frames and characters sent.
        driver: SND_LEAD and SND_WAIT.
    """

    def __init__(
        self,
        core: Core,
        bit: Fraction | None,
        address: int,
        mode: str,
        log: Log,
        driver: Driver,
    ) -> None:
        self._core, self._queue, self._core_timing = core, core.context.queue, core.core_timing
        self._address, self._mode = address, mode
        self._is_ready = False
        self._parser = Parser(address, LENGTHS, mode)
        self._receiver = Receiver(core.context, bit, self.on_char) if bit else None
        self._transmitter = Transmitter(core.context, bit, log.sent, driver.lead) if bit else None
        self._silence: Event | None = None
        self._bit = bit
        self._last_char_at: int | None = None
        self._busy = self._instruction_pending = False
        self._code = 0
        self._result_code: ReportCode | None = None
        self._error = 0
        self.framing = self.overruns = self.checksums = 0
        self._log, self._wait = log, driver.wait

    # ------------------------------------------------------------------ methods that the part calls

    def sample(self, t: int, pins: Mapping[str, int]) -> None:
        """Sample a new level of the line at edge t."""
        if self._receiver:
            level = pins["rxd"]
            at = t + self._core.context.latency.input_sync
            self._queue.at(at, Phase.PINS, lambda now: self._on_level(now, level))

    def _on_level(self, t: int, level: int) -> None:
        assert self._receiver
        self._receiver.on_level(t, level)

    def levels(self) -> dict[str, int]:
        """Return inactive levels for the pins of the parallel bus."""
        return {"irq_n": 1}

    def notify_response(self, t: int) -> None:
        """Do nothing, because a report is sent only as the reply to a poll."""

    def done(self, t: int) -> None:
        """Do nothing at the end of an instruction."""

    def ready(self, t: int) -> None:
        """Accept frames from edge t on."""
        self._is_ready = True

    @property
    def busy(self) -> bool:
        """True if a reply is pending or being sent."""
        return self._busy

    # ------------------------------------------------------------------ characters

    def on_char(self, t: int, byte: int | None) -> None:
        """Process a character whose stop bit was sampled at edge t; `None` if the stop bit is missing."""
        self._last_char_at = t
        self._queue.at(t + self._core_timing.character, Phase.BUS, lambda now: self._character(now, byte))

    def _character(self, t: int, byte: int | None) -> None:
        if not self._is_ready or self._transmitter is None:
            return
        if self._silence:
            self._silence.cancel()
            self._silence = None
        if byte is None:
            self.framing = min(self.framing + 1, _MAX_COUNT)
            self._parser.abandon()
            return
        if self._busy and addressed(byte, self._address):
            self.overruns = min(self.overruns + 1, _MAX_COUNT)
            self._parser.abandon()
            return
        finished = self._parser.take(byte)
        if finished:
            self._take(t, finished)
        elif self._parser.unfinished:
            at = t + self._core.context.timebase.cyc(SILENCE) + self._core_timing.silence
            self._silence = self._queue.at(at, Phase.LEVELS, self._silent)

    def _silent(self, t: int) -> None:
        """Process 20 ms without a character (P312-SER-12, -16, -17)."""
        self._silence = None
        finished = self._parser.silence()
        if finished:
            self._take(t, finished)

    # ------------------------------------------------------------------ frames

    def _take(self, t: int, finished: Frame) -> None:
        """Process a frame for this station. Each frame causes one reply (P312-SER-19)."""
        self._busy = True
        code, data = finished.code, finished.data
        if finished.outcome is Outcome.INSTRUCTION and code not in list(Local):
            self._queue.at(t + self._core_timing.frame, Phase.BUS, lambda now: self._forward(now, code, data))
            return
        self._queue.at(
            t + self._core_timing.sampling,
            Phase.BUS,
            lambda now: self._reply(now, *self._answer(now, finished)),
        )

    def _forward(self, t: int, code: int, data: bytes) -> None:
        self._instruction_pending = True
        self._core.unit.host_block(t, block_of(code, data))

    def answer(self, t: int, source: Source, block: bytes) -> None:
        """Process a response of the instruction unit, in logical order (P312-SER-20, -22)."""
        if source is Source.EVENT:
            self._result_code = (
                ReportCode.EVENT_FAILED if block[2] == Answer.EVENT_FAILED else ReportCode.EVENT_DONE
            )
        elif source is Source.OVERRIDE:
            self._result_code = (
                ReportCode.OVERRIDE_FAILED if block[2] == Answer.OVERRIDE_FAILED else ReportCode.OVERRIDE_DONE
            )
        elif self._instruction_pending:
            self._instruction_pending = False
            self._reply(t, *reply_of(block))

    def _answer(self, t: int, finished: Frame) -> tuple[int, bytes]:
        """Return (kind, data) of the reply to an instruction that the station itself executes."""
        if finished.outcome is Outcome.POLL:
            return self._poll(t)
        if finished.outcome is Outcome.FAULT:
            self.checksums = min(self.checksums + 1, _MAX_COUNT)
            return SPECIFIC, bytes([ReportCode.CHECKSUM])
        if finished.outcome is Outcome.UNKNOWN:
            return SPECIFIC, bytes([ReportCode.UNKNOWN])
        if finished.code == Local.END_STATUS:
            cause = self._core.operation.last_cause
            return DATA, bytes([END_CODES[cause] if cause else 0])
        if self._core.state not in (State.INI, State.NOR):
            return SPECIFIC, bytes([ReportCode.STATUS])
        if finished.code == Local.ERROR_CODE:
            error, self._error = self._error, 0
            return DATA, bytes([error])
        counts = bytes([self.framing, self.overruns, self.checksums])
        self.framing = self.overruns = self.checksums = 0
        return DATA, counts

    def _poll(self, t: int) -> tuple[int, bytes]:
        """Return the reply to a poll (P312-SER-30).

        The order of priority is: the alarm, the result of an event or override, the other classes.
        """
        responses = self._core.responses
        if self._result_code is not None and not responses.alarm_waits:
            result, self._result_code = self._result_code, None
            return SPECIFIC, bytes([result])
        report = responses.take(t)
        if report:
            return poll_reply_of(*report)
        moving = self._core.state in (State.ACC, State.FIX, State.WRN)
        return (BUSY if moving else READY), b""

    def _reply(self, t: int, kind: int, data: bytes) -> None:
        """Schedule a reply whose content is determined at edge t.

        snd does not rise before the line is free (P312-SER-18).
        """
        if kind == SPECIFIC and data[0] in _STORED_ERRORS:
            self._error = data[0]
        message = frame(kind | self._address, data, self._mode)
        at = t + self._core_timing.reply
        if self._bit and self._last_char_at is not None and self._last_char_at < t:
            at = max(at, self._last_char_at + ceil(self._bit * (1 + self._wait)) + self._core_timing.clear)
        self._queue.at(at, Phase.PIN, lambda now: self._send(now, message))

    def _send(self, t: int, message: bytes) -> None:
        assert self._transmitter
        self._log.replies.append((t, message))
        self._transmitter.send(t, message, self._sent)

    def _sent(self, t: int) -> None:
        self._busy = False
