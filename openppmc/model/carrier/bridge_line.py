"""Receiver side of the bridge's golden model: line bytes to requests and faults (UB-FRM-01..06).

Written from docs/uart_bridge.md, on purpose without the host package's codec: one checks the other.
"""

from __future__ import annotations

from typing import NamedTuple

FLAG, ESCAPE = 0x7E, 0x7D
LONGEST, SHORTEST = 256, 3

NAK_FRAMING, NAK_CRC, NAK_LONG, NAK_SHORT, NAK_SILENCE, NAK_ABORTED = 1, 2, 3, 4, 5, 6
NAK_BUSY, NAK_SEQ = 7, 8


def crc(data: bytes) -> int:
    """CRC-16 of UB-FRM-03, bit by bit: polynomial 1021, start FFFF."""
    value = 0xFFFF
    for byte in data:
        for bit in range(7, -1, -1):
            feedback = (value >> 15) ^ (byte >> bit & 1)
            value = value << 1 & 0xFFFF
            if feedback:
                value ^= 0x1021
    return value


def frame(payload: bytes) -> bytes:
    """Line bytes of one frame as the bridge sends it: only 7D and 7E are escaped."""
    line = bytearray([FLAG])
    for byte in payload + crc(payload).to_bytes(2, "big"):
        line += bytes([ESCAPE, byte ^ 0x20]) if byte in (FLAG, ESCAPE) else bytes([byte])
    line.append(FLAG)
    return bytes(line)


class Request(NamedTuple):
    """A good frame: SEQ and the script."""

    seq: int
    script: bytes


class Receiver:
    """Takes one line byte at a time; `take` returns a Request, a NAK code, or None."""

    def __init__(self) -> None:
        self.hunt()

    def hunt(self) -> None:
        """Ignore everything up to the next flag (UB-FRM-05)."""
        self._hunting = True
        self._escaped = False
        self._content = bytearray()

    @property
    def inside(self) -> bool:
        """Part of a frame has arrived, so a silence breaks it. A lone 7D counts."""
        return not self._hunting and (self._escaped or bool(self._content))

    @property
    def hunting(self) -> bool:
        """Before the first flag."""
        return self._hunting

    def drop(self, nak: int) -> int | None:
        """A framing error or a silence: the frame is lost; in the hunt nobody is told (UB-FRM-06)."""
        hunting = self._hunting
        self.hunt()
        return None if hunting else nak

    def take(self, byte: int) -> Request | int | None:
        """One byte without framing error."""
        if byte == FLAG:
            return self._end()
        if self._hunting:
            return None
        if not self._escaped and byte == ESCAPE:
            self._escaped = True
            return None
        self._content.append(byte ^ 0x20 if self._escaped else byte)
        self._escaped = False
        return self.drop(NAK_LONG) if len(self._content) > LONGEST else None

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
        if len(content) < SHORTEST:
            return NAK_SHORT
        if crc(content[:-2]) != int.from_bytes(content[-2:], "big"):
            return NAK_CRC
        return Request(content[0], content[1:-2])
