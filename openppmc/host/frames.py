"""Frames of the UART bridge (docs/uart_bridge.md, UB-FRM-01..04), and one request at a time over a line
that may lose, break or repeat bytes (UB-SEQ, UB-MSG). Pure.

No I/O and no clock: the caller passes the time in seconds (any origin, never backwards), sends the bytes
that the methods return and hands over the bytes that arrive. A payload is what stands between the
flags without the CRC: SEQ and what follows.
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
"""Content of a request in bytes, SEQ and CRC included (UB-FRM-04)."""
ANSWER_LIMIT = 262
"""Longest content that a bridge sends: SEQ, RESULT, POS, LAST, 256 data bytes, CRC (UB-ANS-01, -02)."""


class Fault(IntEnum):
    """What is wrong with a frame; the numbers are those of the bridge's NAK messages (UB-FRM-06)."""

    FRAMING = 1
    CRC = 2
    TOO_LONG = 3
    TOO_SHORT = 4
    SILENCE = 5
    ABORTED = 6


@dataclass(frozen=True)
class Frame:
    """A good frame."""

    payload: bytes

    @property
    def seq(self) -> int:
        """First byte: SEQ of a request or an answer, 128.. for messages."""
        return self.payload[0]


@dataclass(frozen=True)
class Broken:
    """A frame that was dropped, and why."""

    fault: Fault


def crc16(data: bytes) -> int:
    """CRC of UB-FRM-03: polynomial 1021, start FFFF, not reflected, not inverted."""
    return binascii.crc_hqx(data, CRC_START)


def escape(data: bytes) -> bytes:
    """Replace flag and escape bytes (UB-FRM-02)."""
    return data.replace(b"\x7d", b"\x7d\x5d").replace(b"\x7e", b"\x7d\x5e")


def encode(payload: bytes, limit: int = ANSWER_LIMIT) -> bytes:
    """Line bytes of a frame: flag, payload and CRC escaped, flag.

    payload: 1 to limit - 2 bytes, SEQ first; ValueError otherwise. limit: REQUEST_LIMIT for requests.
    """
    if not 1 <= len(payload) <= limit - CRC_BYTES:
        raise ValueError(f"a frame carries 1 to {limit - CRC_BYTES} bytes, not {len(payload)}")
    flag = bytes([FLAG])
    return flag + escape(payload + crc16(payload).to_bytes(CRC_BYTES, "big")) + flag


class Deframer:
    """Line bytes to frames; keeps what is incomplete for the next call.

    limit: content in bytes, CRC included, beyond which a frame is dropped as too long. Bytes before the
    first flag are ignored (UB-FRM-05).
    """

    def __init__(self, limit: int = ANSWER_LIMIT) -> None:
        self._limit = limit
        self.reset()

    def reset(self) -> None:
        """Forget everything and hunt for a flag."""
        self._hunting = True
        self._escaped = False
        self._content = bytearray()

    def feed(self, data: bytes) -> list[Frame | Broken]:
        """Take line bytes; returns the frames that they complete or break, in order."""
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
        # Over a payload and its own CRC the CRC is 0.
        return Broken(Fault.CRC) if crc16(content) else Frame(content[:-CRC_BYTES])


MESSAGE_EVENT, MESSAGE_NAK = 0x80, 0x81
LAST_SEQ = 127
WAKE_UP = b"\x00\x00\x7e"
"""Sent at 115 200 baud: brings a bridge back from any rate and out of any frame (UB-LIN-06)."""


class Nak(IntEnum):
    """Why the bridge dropped something (UB-FRM-06, -07, UB-SEQ-03)."""

    FRAMING = 1
    CRC = 2
    TOO_LONG = 3
    TOO_SHORT = 4
    SILENCE = 5
    ABORTED = 6
    BUSY = 7
    SEQ = 8


_REPEAT_AFTER = frozenset(Nak) - {Nak.SEQ}


class GaveUp(Exception):  # noqa: N818 - says what happened, the link makes an error of it
    """No answer after all attempts. `naks`: what the bridge said meanwhile; `heard`: line bytes that came."""

    def __init__(self, attempts: int, naks: tuple[int, ...], heard: int) -> None:
        super().__init__(f"no answer after {attempts} attempts")
        self.attempts, self.naks, self.heard = attempts, naks, heard


class Session:
    """The requests of one host.

    attempts: how often a request is sent at most. grace: seconds from a NAK to the repeat; the NAK may
    concern noise before the request, then the answer comes within that time and nothing need be repeated.
    """

    def __init__(self, attempts: int = 4, grace: float = 0.05) -> None:
        if attempts < 1:
            raise ValueError(f"{attempts} attempts")
        self._attempts = attempts
        self._grace = grace
        self._deframer = Deframer()
        self._next_seq = 0
        self._answer: bytes | None = None
        self._request: bytes | None = None
        self._heard = 0
        self.events: deque[int] = deque()
        """Pin bytes of the events that came, oldest first; the caller takes them out."""
        self.repeats = 0
        """Requests sent again so far, for statistics."""

    @property
    def busy(self) -> bool:
        """A request is outstanding."""
        return self._request is not None

    @property
    def deadline(self) -> float | None:
        """When `tick` wants to be called if nothing arrives; None without a request."""
        return self._deadline if self.busy else None

    def restart(self) -> None:
        """Begin anew after the link was woken up: SEQ 0, no request, nothing half received."""
        self._deframer.reset()
        self._next_seq = 0
        self._request = self._answer = None

    def request(self, script: bytes, patience: float, now: float) -> bytes:
        """Line bytes of a new request; `patience`: seconds to wait for the answer before repeating.

        Raises RuntimeError while another one is outstanding, ValueError if the script is too long.
        """
        if self.busy:
            raise RuntimeError("a request is outstanding")
        line = encode(bytes([self._next_seq]) + script, REQUEST_LIMIT)
        self._request, self._answer = line, None
        self._seq = self._next_seq
        self._next_seq = self._next_seq % LAST_SEQ + 1
        self._patience = patience
        self._sent = 1
        self._naks: list[int] = []
        self._heard = 0
        self._deadline = now + patience
        return line

    def abandon(self) -> None:
        """Nobody waits for the outstanding request any more; its answer will be ignored."""
        self._request = self._answer = None

    def receive(self, data: bytes, now: float) -> bytes | None:
        """Bytes arrived. Returns the answer without its SEQ if it is complete now."""
        self._heard += len(data)
        for item in self._deframer.feed(data):
            if isinstance(item, Frame):
                self._sort(item.payload, now)
        answer, self._answer = self._answer, None
        return answer

    def tick(self, now: float) -> bytes:
        """At the deadline: the same request again. Empty before. Raises GaveUp after the last attempt."""
        if self._request is None or now < self._deadline:
            return b""
        if self._sent >= self._attempts:
            self._request = None
            raise GaveUp(self._sent, tuple(self._naks), self._heard)
        self._sent += 1
        self.repeats += 1
        self._deadline = now + self._patience
        return self._request

    def _sort(self, payload: bytes, now: float) -> None:
        """Answer, event, NAK, or nothing of ours."""
        kind = payload[0]
        if kind == MESSAGE_EVENT and len(payload) == 2:
            self.events.append(payload[1])
        elif self._request is None:
            return
        elif kind == MESSAGE_NAK and len(payload) == 2:
            self._naks.append(payload[1])
            if payload[1] in _REPEAT_AFTER:
                self._deadline = min(self._deadline, now + self._grace)
        elif kind == self._seq and len(payload) >= 2:
            self._request = None
            self._answer = payload[1:]
