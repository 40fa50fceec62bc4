"""Ports for tests of a line: one damages frames and replies of a modelled line, one returns given replies."""

from __future__ import annotations

from collections.abc import Callable

from openppmc.host.line_port import ModelLine

LOSE_FRAME, LOSE_REPLY, BREAK_REPLY, BREAK_FRAME = "lose frame", "lose reply", "break reply", "break frame"


class Spoiled(ModelLine):
    """A modelled line that damages frames and replies.

    Attributes:
        frames: all frames that the host has sent.
        plan: function that returns the fault for a frame, or None.
    """

    def __init__(self, text: str, baud: int, part: str) -> None:
        super().__init__(text, baud, part)
        self.frames: list[bytes] = []
        self.plan: Callable[[bytes], str | None] = lambda frame: None
        self._fate: str | None = None

    def write(self, data: bytes) -> None:
        self.frames.append(data)
        self._fate = self.plan(data)
        self.forward(data)

    def forward(self, data: bytes) -> None:
        """Pass a frame to the line, complete or with its fault."""
        if self._fate == LOSE_FRAME:
            self.line.run(round(len(data) * 10 * self.line.bit))
        elif self._fate == BREAK_FRAME:
            super().write(data[:-1] + bytes([data[-1] ^ 1]))
        else:
            super().write(data)

    def read(self, timeout: float) -> bytes:
        end = self.clock() + timeout
        data = super().read(timeout)
        if data and self._fate == LOSE_REPLY:
            while (left := end - self.clock()) > 0:
                super().read(left)
            return b""
        return self.spoil(data) if data else data

    def spoil(self, data: bytes) -> bytes:
        """Return the bytes of a reply that the host receives."""
        if self._fate == BREAK_REPLY:
            self._fate = None
            return bytes([data[0] ^ 8]) + data[1:]
        return data


class Played:
    """A port that answers the n-th frame with the n-th reply, regardless of the frame.

    Its time advances only in `read`. With `pause`, it delivers single bytes, each after this time in s.
    """

    name = "played"

    def __init__(self, *replies: str, echo: bool = False, pause: float = 0.0) -> None:
        self.replies = [bytes.fromhex(reply) for reply in replies]
        self.frames: list[bytes] = []
        self._echo, self._pause = echo, pause
        self._now = 0.0
        self._waiting = b""

    def read(self, timeout: float) -> bytes:
        if not self._waiting or timeout < self._pause:
            self._now += timeout
            return b""
        self._now += self._pause
        count = 1 if self._pause else len(self._waiting)
        data, self._waiting = self._waiting[:count], self._waiting[count:]
        return data

    def write(self, data: bytes) -> None:
        self.frames.append(data)
        reply = self.replies.pop(0) if self.replies else b""
        self._waiting += (data if self._echo else b"") + reply

    def set_baud(self, baud: int) -> None:
        pass

    def clock(self) -> float:
        return self._now

    def close(self) -> None:
        pass
