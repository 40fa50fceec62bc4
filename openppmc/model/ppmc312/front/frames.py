"""Frames of the PPMC-312's serial mode: control code, hex-ASCII data, checksum (P312-SER-02..17).

No time here: `Parser.take` gets character after character, `silence` is said after 20 ms without one.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum, auto
from typing import NamedTuple

POLL, INSTRUCTION = 0x80, 0x90
BUSY, READY, DATA, SPECIFIC = 0x80, 0x90, 0xA0, 0xB0
_DIGITS = b"0123456789abcdef"


class Outcome(Enum):
    """What a frame turned out to be."""

    POLL = auto()
    INSTRUCTION = auto()
    FAULT = auto()
    UNKNOWN = auto()


class Frame(NamedTuple):
    """A finished frame; code and data of an instruction."""

    outcome: Outcome
    code: int = 0
    data: bytes = b""


def checksum(control: int, data: bytes, mode: str) -> int:
    """Checksum of a frame (P312-SER-13). mode: SUM_MODE."""
    total = control + sum(data) if mode == "BINARY" else sum(data.hex().encode())
    return ~total & 0x7F


def frame(control: int, data: bytes = b"", mode: str = "BINARY") -> bytes:
    """A whole frame as it is on the line."""
    return bytes([control]) + data.hex().encode() + bytes([checksum(control, data, mode)])


def addressed(character: int, address: int) -> bool:
    """Whether a character is a control code of the two kinds that a master sends to this station."""
    return character & 0xF0 in (POLL, INSTRUCTION) and character & 0x0F == address


class Parser:
    """lengths: number of data bytes of each instruction code. mode: SUM_MODE."""

    def __init__(self, address: int, lengths: Mapping[int, int], mode: str) -> None:
        self._address, self._lengths, self._mode = address, lengths, mode
        self._open = b""

    @property
    def unfinished(self) -> bool:
        """A frame for this station has begun."""
        return bool(self._open)

    def abandon(self) -> None:
        """Ignore everything up to the next control code."""
        self._open = b""

    def take(self, character: int) -> Frame | None:
        """The next character; the frame that it completes."""
        if character & 0x80:
            self._open = bytes([character]) if addressed(character, self._address) else b""
            return None
        if not self._open:
            return None
        self._open += bytes([character])
        size = self._size()
        if size is None:
            # Only the code matters from here on.
            self._open = self._open[:3]
        if len(self._open) != size:
            return None
        finished, self._open = self._open, b""
        return self._judge(finished)

    def silence(self) -> Frame | None:
        """20 ms without a character: the answer that a frame of unknown length gets (P312-SER-12, -17)."""
        given, self._open = self._open[1:3], b""
        if any(character not in _DIGITS for character in given):
            return Frame(Outcome.FAULT)
        if len(given) < 2 or (code := int(given, 16)) in self._lengths:
            return None
        return Frame(Outcome.UNKNOWN, code)

    def _size(self) -> int | None:
        """Characters of the unfinished frame; 0 while its code is not complete, None if that says nothing."""
        if self._open[0] & 0xF0 == POLL:
            return 2
        if len(self._open) < 3:
            return 0
        code = _bytes(self._open[1:3])
        if code is None or code[0] not in self._lengths:
            return None
        return 1 + 2 * (1 + self._lengths[code[0]]) + 1

    def _judge(self, given: bytes) -> Frame:
        data = _bytes(given[1:-1])
        if data is None or given[-1] != checksum(given[0], data, self._mode):
            return Frame(Outcome.FAULT)
        return Frame(Outcome.INSTRUCTION, data[0], data[1:]) if data else Frame(Outcome.POLL)


def _bytes(characters: bytes) -> bytes | None:
    """Data from an even number of characters; None if they are not all lower-case hex digits."""
    if len(characters) % 2 or any(character not in _DIGITS for character in characters):
        return None
    return bytes.fromhex(characters.decode())
