"""One request at a time over a line that may lose, break or repeat bytes (UB-SEQ, UB-MSG). Pure.

No I/O and no clock: the caller passes the time in seconds (any origin, never backwards), sends the bytes
that the methods return and hands over the bytes that arrive.
"""

from __future__ import annotations

from collections import deque
from enum import IntEnum

from .frames import REQUEST_LIMIT, Deframer, Frame, encode

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
