"""Frames of the PPMC-312's serial mode: control code, hex characters, checksum. Pure.

>>> frame(POLL | 1).hex(" "), frame(INSTRUCTION | 1, bytes.fromhex("061f")).hex(" ")
('81 7e', '91 30 36 31 66 49')
>>> receiver = Receiver(1)
>>> [receiver.take(byte) for byte in bytes.fromhex("A1 61 35 39")]
[None, None, None, Reply(station=1, kind=160, data=b'\\xa5')]
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

from ...basis.arguments import whole
from ...basis.errors import OutOfRange
from ...line.faults import Fault

STATIONS = 16
POLL, INSTRUCTION = 0x80, 0x90
BUSY, READY, DATA, SPECIFIC = 0x80, 0x90, 0xA0, 0xB0
"""Kinds of replies: upper half of the control code."""
INPUTS_CHANGED = 0x2A
_SPECIFIC_BYTES = {INPUTS_CHANGED: 3}
_DIGITS = {ord(digit): value for value, digit in enumerate("0123456789abcdef")}
SPEEDS = (19_200, 38_400, 83_333)
"""Line rates in bit/s at a 16 MHz crystal; the last one is 16 MHz / 192."""


class SumMode(Enum):
    """What a checksum adds: control code and data bytes, or the characters between."""

    BINARY = "binary"
    CHARS = "chars"


def sum_mode_of(mode: SumMode) -> SumMode:
    """The mode itself. OutOfRange for what is none: its name as a text, say."""
    if not isinstance(mode, SumMode):
        raise OutOfRange(f"sum_mode {mode!r}: there are {' and '.join(map(str, SumMode))}")
    return mode


def station_number(station: int) -> int:
    """The number itself if there can be such a station. OutOfRange."""
    number = whole(station, "station")
    if number not in range(STATIONS):
        raise OutOfRange(f"station {number}: a line has stations 0 to {STATIONS - 1}")
    return number


def checksum(control: int, data: bytes, mode: SumMode = SumMode.BINARY) -> int:
    """The last byte of a frame.

    >>> f"{checksum(1, bytes([2, 3, 4, 5, 6])):02X}"
    '6A'
    >>> f"{checksum(0x91, bytes.fromhex('001011225566abcdef'), SumMode.CHARS):02X}"
    '4D'
    """
    added = control + sum(data) if sum_mode_of(mode) is SumMode.BINARY else sum(data.hex().encode())
    return ~added & 0x7F


def frame(control: int, data: bytes = b"", mode: SumMode = SumMode.BINARY) -> bytes:
    """A whole frame as it goes over the line."""
    return bytes([control]) + data.hex().encode() + bytes([checksum(control, data, mode)])


class Reply(NamedTuple):
    """A frame of a station. kind: BUSY, READY, DATA or SPECIFIC."""

    station: int
    kind: int
    data: bytes

    @property
    def error(self) -> int | None:
        """The code of a specific report, None for other replies."""
        return self.data[0] if self.kind == SPECIFIC else None


class Receiver:
    """Takes the bytes of one reply of a station.

    gives: data bytes of a data reply, which the instruction decides: a reply does not say how long it is.
    """

    def __init__(self, station: int, gives: int = 1, mode: SumMode = SumMode.BINARY) -> None:
        self._station, self._gives, self._mode = station, gives, mode
        self._control: int | None = None
        self._digits = bytearray()

    def take(self, byte: int) -> Reply | Fault | None:
        """See `master.Listener`."""
        if byte & 0x80:
            # A control code always begins anew, as at the station.
            broken = self._control is not None
            self._control, self._digits = byte, bytearray()
            if byte & 0x40 or byte & 0x0F != self._station:
                return Fault.FOREIGN
            return Fault.BROKEN if broken else None
        if self._control is None:
            return Fault.NOISE
        if len(self._digits) < 2 * self._length(self._control & 0x30 | 0x80):
            self._digits.append(byte)
            return None if byte in _DIGITS else Fault.BROKEN
        data = bytes.fromhex(self._digits.decode("ascii"))
        if byte != checksum(self._control, data, self._mode):
            return Fault.BROKEN
        return Reply(self._station, self._control & 0xF0, data)

    def _length(self, kind: int) -> int:
        """Data bytes of the reply, as far as it is known."""
        if kind == DATA:
            return self._gives
        if kind == SPECIFIC:
            code = int(self._digits[:2].decode("ascii"), 16) if len(self._digits) >= 2 else 0
            return _SPECIFIC_BYTES.get(code, 1)
        return 0
