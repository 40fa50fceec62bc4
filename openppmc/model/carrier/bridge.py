"""Golden model of `ppmc_uart_bridge` at the level of line bytes (docs/uart_bridge.md).

Bit times are not modelled (UB-LIN-03, -04, UB-BUS-01). The caller reports events that depend on time:
`receive_bad` for a byte with a framing error, `idle` for an idle line. If more bytes follow a request in the
same call of `receive`, the model assumes that they arrive while the script of the request runs (UB-FRM-07).
"""

from __future__ import annotations

from typing import NamedTuple

from .bridge_ops import BUILD_BYTES, Bus, Engine

# Receiver of the golden model of the bridge: converts line bytes to requests and faults (UB-FRM-01..06). It
# is written from docs/uart_bridge.md and deliberately does not use the codec of the host package, so that
# each of the two is a check of the other.

FLAG, ESCAPE = 0x7E, 0x7D
MAX_LENGTH, MIN_LENGTH = 256, 3

NAK_FRAMING, NAK_CRC, NAK_LONG, NAK_SHORT, NAK_SILENCE, NAK_ABORTED = 1, 2, 3, 4, 5, 6
NAK_BUSY, NAK_SEQ = 7, 8


def crc(data: bytes) -> int:
    """Return the CRC-16 of UB-FRM-03, bit by bit: polynomial 1021, initial value FFFF."""
    value = 0xFFFF
    for byte in data:
        for bit in range(7, -1, -1):
            feedback = (value >> 15) ^ (byte >> bit & 1)
            value = value << 1 & 0xFFFF
            if feedback:
                value ^= 0x1021
    return value


def frame(payload: bytes) -> bytes:
    """Return the line bytes of a frame from the bridge, in which only 7D and 7E are escaped."""
    line = bytearray([FLAG])
    for byte in payload + crc(payload).to_bytes(2, "big"):
        line += bytes([ESCAPE, byte ^ 0x20]) if byte in (FLAG, ESCAPE) else bytes([byte])
    line.append(FLAG)
    return bytes(line)


class Request(NamedTuple):
    """Valid frame: SEQ and the script."""

    seq: int
    script: bytes


class Receiver:
    """Receiver of line bytes; `take` returns a Request, a NAK code, or `None`."""

    def __init__(self) -> None:
        self.hunt()

    def hunt(self) -> None:
        """Ignore all bytes up to the next flag (UB-FRM-05)."""
        self._hunting = True
        self._escaped = False
        self._content = bytearray()

    @property
    def inside(self) -> bool:
        """True if a frame has begun but is not complete. If the line becomes idle, this frame is invalid.

        A single byte 7D also begins a frame.
        """
        return not self._hunting and (self._escaped or bool(self._content))

    @property
    def hunting(self) -> bool:
        """True while the receiver ignores all bytes up to the next flag."""
        return self._hunting

    def drop(self, nak: int) -> int | None:
        """Discard the frame after a framing error or on an idle line (UB-FRM-06).

        Before the first flag, no NAK is returned.
        """
        hunting = self._hunting
        self.hunt()
        return None if hunting else nak

    def take(self, byte: int) -> Request | int | None:
        """Process one byte without framing error."""
        if byte == FLAG:
            return self._end()
        if self._hunting:
            return None
        if not self._escaped and byte == ESCAPE:
            self._escaped = True
            return None
        self._content.append(byte ^ 0x20 if self._escaped else byte)
        self._escaped = False
        return self.drop(NAK_LONG) if len(self._content) > MAX_LENGTH else None

    def _end(self) -> Request | int | None:
        hunting, escaped, content = self._hunting, self._escaped, bytes(self._content)
        self.hunt()
        self._hunting = False
        if hunting:
            return None
        if escaped:
            return NAK_ABORTED
        if not content:
            return None
        if len(content) < MIN_LENGTH:
            return NAK_SHORT
        if crc(content[:-2]) != int.from_bytes(content[-2:], "big"):
            return NAK_CRC
        return Request(content[0], content[1:-2])


MESSAGE_EVENT, MESSAGE_NAK = 0x80, 0x81
SEQ_LIMIT = 128
SILENCE_MS, RATE_TRIAL_MS = 100, 1000
INT_PIN = 0x01


class Bridge:
    """One bridge with its part.

    Args:
        bus: part; see `bridge_ops.Bus`.
        part: part number in the answer to IDENT.
        clk_hz: 1..2^32-1; it determines the available line rates.
        xtal_hz, datasheet, counter: values for the answer to IDENT; they have no other effect.
        axes: number of pulse counters, 1 or 2.
        build: answer to VERSION, 16 bytes.
        recorder: True if the bus has a recorder.

    Attributes:
        rate: code of the current line rate.
        scripts: number of executed requests.
    """

    def __init__(
        self,
        bus: Bus,
        part: int = 104,
        clk_hz: int = 24_000_000,
        xtal_hz: int = 16_000_000,
        datasheet: bool = False,
        counter: bool = True,
        axes: int = 1,
        build: bytes = bytes(BUILD_BYTES),
        recorder: bool = False,
    ) -> None:
        self._engine = Engine(
            bus, part, clk_hz, xtal_hz, datasheet, counter, axes, self._set_events, build, recorder
        )
        self._receiver = Receiver()
        self._stored: tuple[int, bytes] | None = None
        self._event = False
        self._running = False
        self.rate = 0
        self.scripts = 0
        self._trial_ms: float | None = None
        self._silent_ms = 0.0

    # ------------------------------------------------------------------ from the line

    def receive(self, data: bytes) -> bytes:
        """Process bytes without framing error; return the line bytes that the bridge sends in response."""
        sent = b""
        place = 0
        while place < len(data):
            self._silent_ms = 0
            item = self._receiver.take(data[place])
            place += 1
            if isinstance(item, Request):
                self._trial_ms = None
                if item.seq >= SEQ_LIMIT:
                    sent += self._nak(NAK_SEQ)
                    continue
                more_bytes = any(byte != FLAG for byte in data[place:])
                sent += self._execute(item, more_bytes)
                place = len(data)
            elif item is not None:
                sent += self._nak(item)
        return sent

    def receive_bad(self, data_bits: int) -> bytes:
        """Process a character with a low stop bit; data_bits 0 makes it a break (UB-LIN-05, -06)."""
        self._silent_ms = 0
        nak = self._receiver.drop(NAK_FRAMING)
        if data_bits == 0:
            self.rate = 0
            self._trial_ms = None
        return b"" if nak is None else self._nak(nak)

    def idle(self, milliseconds: float) -> bytes:
        """Process the detection of an idle line (UB-FRM-06 fault 5, UB-LIN-07)."""
        self._silent_ms += milliseconds
        nak = None
        if self._silent_ms >= SILENCE_MS and self._receiver.inside:
            nak = self._receiver.drop(NAK_SILENCE)
        if self._trial_ms is not None:
            self._trial_ms += milliseconds
            if self._trial_ms >= RATE_TRIAL_MS:
                self.rate, self._trial_ms = 0, None
        return b"" if nak is None else self._nak(nak)

    # ------------------------------------------------------------------ requests

    def _execute(self, request: Request, more_bytes: bool) -> bytes:
        """Execute a request, or repeat its answer.

        Args:
            more_bytes: True if further bytes arrive before the answer is sent (UB-FRM-07).
        """
        code = None
        if request.seq and self._stored and self._stored[0] == request.seq:
            payload = self._stored[1]
        else:
            self._running = True
            result, position, last, data = self._engine.run(request.script, lambda: more_bytes)
            self._running = False
            self.scripts += 1
            code = self._engine.rate
            head = bytes([request.seq, result])
            payload = head + (bytes([position, last]) if result else b"") + data
            self._stored = (request.seq, payload)
        sent = frame(payload) + self._flush_event()
        if code is not None:
            self.rate, self._trial_ms = code, 0.0
        if more_bytes:
            self._receiver.hunt()
            sent += self._nak(NAK_BUSY)
        return sent

    def _nak(self, code: int) -> bytes:
        return frame(bytes([MESSAGE_NAK, code]))

    # ------------------------------------------------------------------ events

    def interrupt(self) -> bytes:
        """Process a falling edge of `int_n`; return the event message.

        The result is empty if events are disabled, or if the message must wait until an answer is sent.
        """
        if not self._engine.events:
            return b""
        self._event = True
        return b"" if self._running else self._flush_event()

    def _set_events(self, on: bool) -> None:
        """Execute the operation EVENTS (UB-MSG-02)."""
        was, self._engine.events = self._engine.events, on
        if not on:
            self._event = False
        elif not was and not self._engine.hook("pins", 0xFF) & INT_PIN:
            self._event = True

    def _flush_event(self) -> bytes:
        if not self._event:
            return b""
        self._event = False
        return frame(bytes([MESSAGE_EVENT, self._engine.hook("pins", 0xFF)]))
