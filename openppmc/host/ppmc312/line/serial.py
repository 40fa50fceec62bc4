"""Instructions of the PPMC-312 on the serial line: bus block to code and data, and back. Pure.

Most differ from the blocks in their code only; the flag byte moves into the code.

>>> line_data(blocks.acceleration(blocks.CW, 5000)).hex(" ")
'83 00 00 00 00 13 88'
>>> line_data(blocks.immediate_stop(blocks.Trigger.POSITION, 0x1000)).hex(" ")
'90 00 00 10 00'
>>> line_data(blocks.change(400, trigger=blocks.Trigger.EVENT2)).hex(" ")
'b9 01 90'
>>> line_data(blocks.free_curve(1, [100, 200], [5, 4])[0])
Traceback (most recent call last):
openppmc.host.basis.errors.OutOfRange: free curves: only on the parallel bus
"""

from __future__ import annotations

from ....model.ppmc312.codes import DIR, IDX, LE, OV, Code
from ...basis.errors import OutOfRange
from .. import blocks
from ..answers import Response
from .ascii import DATA, Reply

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
"""Reading codes, and how many bytes they give."""
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
"""Bits 5:4 of a code by TRG of the flag byte."""
_ONLY_PARALLEL = {
    Code.FREE_CURVE: "free curves",
    Code.TABLE_READ: "reading the table",
    Code.EVENT_READ: "reading an event buffer",
}
_RESULT = {(Code.EVENT_SET, 0): b"\x00", (Code.EVENT_SET, 2): b"\x03"}
"""What the bus would have answered: registered, deleted."""


def line_data(block: bytes) -> bytes:
    """Code and data for an instruction block in logical order. OutOfRange for what serial mode cannot do."""
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
            raise OutOfRange("a deceleration of its own: serial mode has one ramp for both")
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
    """Starts have no triggers on the line."""
    flags, rest = data[0], data[1:]
    if flags & OV and code not in (Code.ORIGIN_SEARCH, Code.ZERO_RETURN, Code.STEP):
        raise OutOfRange("a start cannot wait for an event in serial mode: put it into an event buffer")
    side = bool(flags & DIR) << 5
    if code in (Code.ORIGIN_SEARCH, Code.ZERO_RETURN):
        side |= bool(flags & IDX) << 4
    return bytes([_MOTIONS[code] | side]) + rest


def _event(flags: int, embedded: bytes) -> bytes:
    """Registering takes ten bytes, whatever the instruction has."""
    code = 0x49 | (flags & 1) << 4 | (flags & 2) << 4
    if flags & 2:
        return bytes([code])
    if len(embedded) > LONGEST_EVENT:
        raise OutOfRange(f"an instruction of {len(embedded)} bytes: serial events take {LONGEST_EVENT}")
    return bytes([code]) + embedded.ljust(LONGEST_EVENT, b"\0")


def response(block: bytes, reply: Reply) -> Response:
    """A good reply as the bus would have answered."""
    code, data = block[2], reply.data if reply.kind == DATA else b""
    if code == Code.POSITION_READ:
        data = block[3:4] + data
    elif code == Code.EVENT_SET:
        data = _RESULT[Code.EVENT_SET, block[3] & 2]
    return Response(blocks.block(code, data))
