"""Frames of the UART bridge: payload to line bytes and back (docs/uart_bridge.md, UB-FRM-01..04).

Pure: no I/O, no clock. A payload is what stands between the flags without the CRC: SEQ and what follows.
"""

from __future__ import annotations

import binascii
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
