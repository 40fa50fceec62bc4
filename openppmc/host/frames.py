"""Frames (UB-FRM-01..04) and sessions (UB-SEQ, UB-MSG) of the UART bridge. Pure.

See docs/uart_bridge.md.

A session has at most one outstanding request. The line may lose, corrupt or repeat bytes. This module
performs no I/O and reads no clock: the caller passes the time in seconds (any origin, never decreasing),
sends the bytes that the methods return, and passes the bytes that arrive. A payload is the content between
the flags without the CRC: SEQ and the bytes that follow it.
"""

from __future__ import annotations

import binascii
from collections import deque
from dataclasses import dataclass
from enum import IntEnum

FLAG, ESCAPE, TOGGLE = 0x7E, 0x7D, 0x20
CRC_START = 0xFFFF
CRC_BYTES = 2

REQUEST_LIMIT = 256
"""Longest content of a request in bytes, including SEQ and CRC (UB-FRM-04)."""
ANSWER_LIMIT = 262
"""Longest content that a bridge sends, in bytes (UB-ANS-01, -02).

The content consists of SEQ, RESULT, POS, LAST, 256 data bytes and CRC.
"""


class Fault(IntEnum):
    """Error of a frame; its number is the same as in the NAK messages of the bridge (UB-FRM-06)."""

    FRAMING = 1
    CRC = 2
    TOO_LONG = 3
    TOO_SHORT = 4
    SILENCE = 5
    ABORTED = 6


@dataclass(frozen=True)
class Frame:
    """Frame whose CRC, length and escapes are valid."""

    payload: bytes

    @property
    def seq(self) -> int:
        """First byte: SEQ of a request or an answer; 128 or more for a message."""
        return self.payload[0]


@dataclass(frozen=True)
class Broken:
    """Invalid frame that was dropped.

    Attributes:
        fault: reason why the frame is invalid.
    """

    fault: Fault


def crc16(data: bytes) -> int:
    """Return the CRC of UB-FRM-03.

    The CRC has the polynomial 1021 and the initial value FFFF, and is not reflected and not inverted.
    """
    return binascii.crc_hqx(data, CRC_START)


def escape(data: bytes) -> bytes:
    """Replace flag and escape bytes (UB-FRM-02)."""
    return data.replace(b"\x7d", b"\x7d\x5d").replace(b"\x7e", b"\x7d\x5e")


def encode(payload: bytes, limit: int = ANSWER_LIMIT) -> bytes:
    """Return the line bytes of a frame: flag, escaped payload and CRC, flag.

    Args:
        payload: 1 to limit - 2 bytes, SEQ first.
        limit: REQUEST_LIMIT for requests.

    Raises:
        ValueError: the payload has a wrong length.
    """
    if not 1 <= len(payload) <= limit - CRC_BYTES:
        raise ValueError(f"a frame carries 1 to {limit - CRC_BYTES} bytes, not {len(payload)}")
    flag = bytes([FLAG])
    return flag + escape(payload + crc16(payload).to_bytes(CRC_BYTES, "big")) + flag


class Deframer:
    """Receiver that converts line bytes to frames. An incomplete frame is kept for the next call.

    Bytes before the first flag are ignored (UB-FRM-05).

    Args:
        limit: longest content in bytes, including the CRC; a longer frame is dropped as too long.
    """

    def __init__(self, limit: int = ANSWER_LIMIT) -> None:
        self._limit = limit
        self.reset()

    def reset(self) -> None:
        """Discard all received bytes and wait for a flag."""
        self._hunting = True
        self._escaped = False
        self._content = bytearray()

    def feed(self, data: bytes) -> list[Frame | Broken]:
        """Process line bytes; return the complete frames and the invalid frames, in order."""
        found: list[Frame | Broken] = []
        for byte in data:
            item = self._flag() if byte == FLAG else self._byte(byte)
            if item is not None:
                found.append(item)
        return found

    def _byte(self, byte: int) -> Broken | None:
        if self._hunting:
            return None
        if byte == ESCAPE and not self._escaped:
            self._escaped = True
            return None
        self._content.append(byte ^ TOGGLE if self._escaped else byte)
        self._escaped = False
        if len(self._content) > self._limit:
            self.reset()
            return Broken(Fault.TOO_LONG)
        return None

    def _flag(self) -> Frame | Broken | None:
        hunting, aborted, content = self._hunting, self._escaped, bytes(self._content)
        self.reset()
        self._hunting = False
        if hunting:
            return None
        if aborted:
            return Broken(Fault.ABORTED)
        if not content:
            return None
        if len(content) <= CRC_BYTES:
            return Broken(Fault.TOO_SHORT)
        # The CRC of a payload followed by its own CRC is 0.
        return Broken(Fault.CRC) if crc16(content) else Frame(content[:-CRC_BYTES])


MESSAGE_EVENT, MESSAGE_NAK = 0x80, 0x81
LAST_SEQ = 127
WAKE_UP = b"\x00\x00\x7d\x7e"
"""Bytes that wake a bridge up at 115 200 baud (UB-LIN-06).

At any rate, and within any frame, they return the bridge to the idle state. 7D 7E ends a frame as invalid.
With 7E alone, the bridge would execute a request that lacks only its last flag: at that point, the CRC
register of the bridge is 0, and the bytes 00 00 do not change it.
"""


class Nak(IntEnum):
    """Reason for which the bridge dropped a frame (UB-FRM-06, -07, UB-SEQ-03)."""

    FRAMING = 1
    CRC = 2
    TOO_LONG = 3
    TOO_SHORT = 4
    SILENCE = 5
    ABORTED = 6
    BUSY = 7
    SEQ = 8


_REPEAT_AFTER = frozenset(Nak) - {Nak.SEQ}


class RetriesExhausted(Exception):  # noqa: N818 - names the event; the link raises an error for it
    """No answer after all attempts.

    Args:
        naks: NAKs that the bridge sent during the attempts.
        received: number of bytes received during the attempts.
    """

    def __init__(self, attempts: int, naks: tuple[int, ...], received: int) -> None:
        super().__init__(f"no answer after {attempts} attempts")
        self.attempts, self.naks, self.received = attempts, naks, received


class Session:
    """Session of one host: its requests, one at a time.

    Args:
        attempts: largest number of times that a request is sent.
        grace: time in s from a NAK to the repetition of the request. The NAK may have been caused by noise
            before the request; then the answer arrives within this time, and no repetition is necessary.
    """

    def __init__(self, attempts: int = 4, grace: float = 0.05) -> None:
        if attempts < 1:
            raise ValueError(f"{attempts} attempts")
        self._attempts = attempts
        self._grace = grace
        self._deframer = Deframer()
        self._next_seq = 0
        self._answer: bytes | None = None
        self.outstanding: bytes | None = None
        """Line bytes of the outstanding request; the caller may set it to None to cancel the request."""
        self._received = 0
        self.events: deque[int] = deque()
        """Pin bytes of the received events, oldest first; the caller removes them."""
        self.repeats = 0
        """Number of repeated requests, for statistics."""

    @property
    def busy(self) -> bool:
        """True if a request is outstanding."""
        return self.outstanding is not None

    @property
    def deadline(self) -> float | None:
        """Time at which `tick` must be called if no byte arrives; `None` if no request is outstanding."""
        return self._deadline if self.busy else None

    def restart(self) -> None:
        """Return to the initial state after a wake-up of the link: SEQ 0, no request, no incomplete frame."""
        self._deframer.reset()
        self._next_seq = 0
        self.outstanding = self._answer = None

    def request(self, script: bytes, patience: float, now: float) -> bytes:
        """Return the line bytes of a new request.

        Args:
            patience: seconds to wait for the answer before the request is repeated.

        Raises:
            RuntimeError: another request is outstanding.
            ValueError: the script is too long.
        """
        if self.busy:
            raise RuntimeError("a request is outstanding")
        # A CRC that ends with 00 is avoided: the frame would also be valid without this 00, or with two of
        # them.
        while not crc16(bytes([self._next_seq]) + script) & 0xFF:
            self._next_seq = self._following_seq()
        line = encode(bytes([self._next_seq]) + script, REQUEST_LIMIT)
        self.outstanding = self._line = line
        self._answer = None
        self._seq = self._next_seq
        self._next_seq = self._following_seq()
        self._patience = patience
        self._sent = 1
        self._naks: list[int] = []
        self._received = 0
        self._deadline = now + patience
        return line

    def _following_seq(self) -> int:
        return self._next_seq % LAST_SEQ + 1

    def repeat(self, now: float) -> bytes:
        """Return the line bytes of the last request again, after an answer that does not match it."""
        line = self._line
        self.outstanding, self._sent = line, self._sent + 1
        self.repeats += 1
        self._deadline = now + self._patience
        return line

    def receive(self, data: bytes, now: float) -> bytes | None:
        """Process received bytes. Return the answer without its SEQ if they complete the answer."""
        self._received += len(data)
        for item in self._deframer.feed(data):
            if isinstance(item, Frame):
                self._sort(item.payload, now)
        answer, self._answer = self._answer, None
        return answer

    def tick(self, now: float) -> bytes:
        """Return the line bytes of the outstanding request if its deadline has passed, else no bytes.

        Raises RetriesExhausted after the last attempt.
        """
        if self.outstanding is None or now < self._deadline:
            return b""
        if self._sent >= self._attempts:
            self.outstanding = None
            raise RetriesExhausted(self._sent, tuple(self._naks), self._received)
        self._sent += 1
        self.repeats += 1
        self._deadline = now + self._patience
        return self.outstanding

    def _sort(self, payload: bytes, now: float) -> None:
        """Process an answer, an event or a NAK; ignore other payloads."""
        kind = payload[0]
        if kind == MESSAGE_EVENT and len(payload) == 2:
            self.events.append(payload[1])
        elif self.outstanding is None:
            return
        elif kind == MESSAGE_NAK and len(payload) == 2:
            self._naks.append(payload[1])
            if payload[1] in _REPEAT_AFTER:
                self._deadline = min(self._deadline, now + self._grace)
        elif kind == self._seq and len(payload) >= 2:
            self.outstanding = None
            self._answer = payload[1:]
