"""Serial mode of the PPMC-312: frames, and their conversion from and to bus blocks. Pure.

A frame consists of control code, hexadecimal characters and checksum. For most instructions, the content
differs from the block on the parallel bus only in the code: in serial mode, there is no flag byte, because
the code contains its information.

>>> line_data(blocks.acceleration(blocks.CW, 5000)).hex(" ")
'83 00 00 00 00 13 88'
>>> line_data(blocks.immediate_stop(blocks.Trigger.POSITION, 0x1000)).hex(" ")
'90 00 00 10 00'
>>> line_data(blocks.change(400, trigger=blocks.Trigger.EVENT2)).hex(" ")
'b9 01 90'
>>> line_data(blocks.free_curve(1, [100, 200], [5, 4])[0])
Traceback (most recent call last):
openppmc.host.errors.OutOfRange: free curves: only on the parallel bus
>>> frame(POLL | 1).hex(" "), frame(INSTRUCTION | 1, bytes.fromhex("061f")).hex(" ")
('81 7e', '91 30 36 31 66 49')
>>> receiver = Receiver(1)
>>> [receiver.feed(byte) for byte in bytes.fromhex("A1 61 35 39")]
[None, None, None, Reply(station=1, kind=160, data=b'\xa5')]
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

from ....model.ppmc312.codes import DIR, IDX, LE, OV, Code
from ...check import whole
from ...errors import OutOfRange
from ...line_port import Fault
from .. import blocks
from ..answers import Response

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
    """Sum from which the checksum is calculated.

    It is the sum of the control code and the data bytes, or the sum of the characters that represent the
    data.
    """

    BINARY = "binary"
    CHARS = "chars"


def sum_mode_of(mode: SumMode) -> SumMode:
    """Return the mode unchanged. Raises OutOfRange if it is not a SumMode, for example a name as text."""
    if not isinstance(mode, SumMode):
        raise OutOfRange(f"sum_mode {mode!r}: there are {' and '.join(map(str, SumMode))}")
    return mode


def station_number(station: int) -> int:
    """Return the number unchanged. Raises OutOfRange if it is not a station number."""
    number = whole(station, "station")
    if number not in range(STATIONS):
        raise OutOfRange(f"station {number}: a line has stations 0 to {STATIONS - 1}")
    return number


def checksum(control: int, data: bytes, mode: SumMode = SumMode.BINARY) -> int:
    """Return the checksum, which is the last byte of a frame.

    >>> f"{checksum(1, bytes([2, 3, 4, 5, 6])):02X}"
    '6A'
    >>> f"{checksum(0x91, bytes.fromhex('001011225566abcdef'), SumMode.CHARS):02X}"
    '4D'
    """
    added = control + sum(data) if sum_mode_of(mode) is SumMode.BINARY else sum(data.hex().encode())
    return ~added & 0x7F


def frame(control: int, data: bytes = b"", mode: SumMode = SumMode.BINARY) -> bytes:
    """Return a complete frame as it is sent on the line."""
    return bytes([control]) + data.hex().encode() + bytes([checksum(control, data, mode)])


class Reply(NamedTuple):
    """Frame of a station.

    Attributes:
        kind: BUSY, READY, DATA or SPECIFIC.
    """

    station: int
    kind: int
    data: bytes

    @property
    def error(self) -> int | None:
        """Code of a specific report, `None` for other replies."""
        return self.data[0] if self.kind == SPECIFIC else None


class Receiver:
    """Receiver for the bytes of one reply from a station.

    Args:
        gives: number of data bytes of a data reply. The instruction defines it; a reply does not contain its
            length.
    """

    def __init__(self, station: int, gives: int = 1, mode: SumMode = SumMode.BINARY) -> None:
        self._station, self._data_length, self._mode = station, gives, mode
        self._control: int | None = None
        self._digits = bytearray()

    def feed(self, byte: int) -> Reply | Fault | None:
        """Process a byte; see `host.line.ReplyReceiver`."""
        if byte & 0x80:
            # A control code always starts a new frame; a station does the same.
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
        """Return the number of data bytes of the reply, if it is known."""
        if kind == DATA:
            return self._data_length
        if kind == SPECIFIC:
            code = int(self._digits[:2].decode("ascii"), 16) if len(self._digits) >= 2 else 0
            return _SPECIFIC_BYTES.get(code, 1)
        return 0


END_STATUS, VERSION, ERROR_CODE, ERROR_COUNTS = 0x40, 0x41, 0x4E, 0x4F
DATA_BYTES = {
    0x25: 1,
    0x27: 2,
    END_STATUS: 1,
    VERSION: 1,
    0x42: 4,
    0x62: 4,
    0x4D: 3,
    ERROR_CODE: 1,
    ERROR_COUNTS: 3,
}
"""Code of each read instruction, and the number of bytes that it returns."""
LONGEST_EVENT = 10
_MOTIONS = {
    Code.RAMP: 0x83,
    Code.CONSTANT: 0x84,
    Code.STEP: 0x82,
    Code.FOREVER_RAMP: 0x86,
    Code.FOREVER_CONSTANT: 0x85,
    Code.ORIGIN_SEARCH: 0x87,
    Code.ZERO_RETURN: 0x88,
}
_STOPS = {Code.STOP: 0x80, Code.SLOW_STOP: 0x81, Code.RAMP_CHANGE: 0x89, Code.CHANGE: 0x8A}
_TRIGGERS = {0: 1, 2: 1, 1: 2, 3: 3}
"""Bits 5:4 of a code for each value of the field TRG of the flag byte."""
_ONLY_PARALLEL = {
    Code.FREE_CURVE: "free curves",
    Code.TABLE_READ: "reading the table",
    Code.EVENT_READ: "reading an event buffer",
}
_RESULT = {(Code.EVENT_SET, 0): b"\x00", (Code.EVENT_SET, 2): b"\x03"}
"""Data that a response on the parallel bus to a registration or a deletion would contain."""


def line_data(block: bytes) -> bytes:
    """Return code and data of the frame for a block in logical order.

    Raises OutOfRange if serial mode has no such instruction.
    """
    code, data = block[2], block[3:]
    if code in _ONLY_PARALLEL:
        raise OutOfRange(f"{_ONLY_PARALLEL[Code(code)]}: only on the parallel bus")
    if code in _MOTIONS:
        return _motion(Code(code), data)
    if code in _STOPS:
        flags = data[0]
        place = _TRIGGERS[flags & 3] << 4 if flags & OV else 0
        return bytes([_STOPS[Code(code)] | place]) + data[1:]
    if code == Code.INITIAL:
        if data[0] & LE:
            raise OutOfRange("a separate deceleration: serial mode has one ramp for both")
        return block[2:]
    if code in (Code.IN_POSITION, Code.ENCODE):
        flags = data[0]
        if flags & 3 == 1:
            raise OutOfRange("a single report: serial mode reports every change")
        return bytes([code, flags & ~2]) + data[1:]
    if code == Code.MASK:
        if not data[0] and data[1]:
            raise OutOfRange("a single report: serial mode reports every change")
        return bytes([code, data[1]])
    if code in (Code.POSITION_READ, Code.POSITION_SET):
        return bytes([code | data[0] << 5]) + data[1:]
    if code == Code.EVENT_SET:
        return _event(data[0], data[1:])
    return bytes([VERSION if code == Code.VERSION else code]) + data


def _motion(code: Code, data: bytes) -> bytes:
    """Return code and data of the frame for a start; a start on the line cannot have a trigger."""
    flags, rest = data[0], data[1:]
    if flags & OV and code not in (Code.ORIGIN_SEARCH, Code.ZERO_RETURN, Code.STEP):
        raise OutOfRange("a start cannot wait for an event in serial mode: put it into an event buffer")
    side = bool(flags & DIR) << 5
    if code in (Code.ORIGIN_SEARCH, Code.ZERO_RETURN):
        side |= bool(flags & IDX) << 4
    return bytes([_MOTIONS[code] | side]) + rest


def _event(flags: int, embedded: bytes) -> bytes:
    """Return code and data of the frame for a registration in an event buffer.

    The data have ten bytes for a registered instruction of any length.
    """
    code = 0x49 | (flags & 1) << 4 | (flags & 2) << 4
    if flags & 2:
        return bytes([code])
    if len(embedded) > LONGEST_EVENT:
        raise OutOfRange(f"an instruction of {len(embedded)} bytes: serial events hold {LONGEST_EVENT}")
    return bytes([code]) + embedded.ljust(LONGEST_EVENT, b"\0")


def response(block: bytes, reply: Reply) -> Response:
    """Convert a valid reply to a response of the parallel bus."""
    code, data = block[2], reply.data if reply.kind == DATA else b""
    if code == Code.POSITION_READ:
        data = block[3:4] + data
    elif code == Code.EVENT_SET:
        data = _RESULT[Code.EVENT_SET, block[3] & 2]
    return Response(blocks.block(code, data))
