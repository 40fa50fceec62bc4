"""Serial mode of the PPMC-312: line rates, frames, instruction codes and replies.

Rules: P312-SER-01, -20..47.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum, IntEnum, auto, unique
from fractions import Fraction
from typing import NamedTuple

from ..codes import DIR, IDX, OV, Answer, Cause, Code
from . import responses

# Frames of the PPMC-312's serial mode: control code, hex-ASCII data, checksum (P312-SER-02..17). This section
# does not model time: `Parser.take` processes one character after the other, and `silence` is called after 20
# ms without a character.

POLL, INSTRUCTION = 0x80, 0x90
BUSY, READY, DATA, SPECIFIC = 0x80, 0x90, 0xA0, 0xB0
_DIGITS = b"0123456789abcdef"


class Outcome(Enum):
    """Type of a frame."""

    POLL = auto()
    INSTRUCTION = auto()
    FAULT = auto()
    UNKNOWN = auto()


class Frame(NamedTuple):
    """A complete frame. The frame of an instruction has a code and data."""

    outcome: Outcome
    code: int = 0
    data: bytes = b""


def checksum(control: int, data: bytes, mode: str) -> int:
    """Return the checksum of a frame (P312-SER-13).

    Args:
        mode: SUM_MODE.
    """
    total = control + sum(data) if mode == "BINARY" else sum(data.hex().encode())
    return ~total & 0x7F


def frame(control: int, data: bytes = b"", mode: str = "BINARY") -> bytes:
    """Return a complete frame as it is sent on the line."""
    return bytes([control]) + data.hex().encode() + bytes([checksum(control, data, mode)])


def addressed(character: int, address: int) -> bool:
    """Return True for a control code (poll or instruction) of a master to this station."""
    return character & 0xF0 in (POLL, INSTRUCTION) and character & 0x0F == address


class Parser:
    """Receiver of frames.

    Args:
        lengths: number of data bytes of each instruction code.
        mode: SUM_MODE.
    """

    def __init__(self, address: int, lengths: Mapping[int, int], mode: str) -> None:
        self._address, self._lengths, self._mode = address, lengths, mode
        self._open = b""

    @property
    def unfinished(self) -> bool:
        """True if a frame for this station has begun."""
        return bool(self._open)

    def abandon(self) -> None:
        """Ignore all characters up to the next control code."""
        self._open = b""

    def take(self, character: int) -> Frame | None:
        """Process a character; return the frame if this character completes it."""
        if character & 0x80:
            self._open = bytes([character]) if addressed(character, self._address) else b""
            return None
        if not self._open:
            return None
        self._open += bytes([character])
        size = self._size()
        if size is None:
            # The following characters are checked only with the instruction code.
            self._open = self._open[:3]
        if len(self._open) != size:
            return None
        finished, self._open = self._open, b""
        return self._check(finished)

    def silence(self) -> Frame | None:
        """Process 20 ms without a character (P312-SER-12, -17).

        If a frame whose length is unknown has begun, return a `Frame` with the fault to which the station
        responds.
        """
        given, self._open = self._open[1:3], b""
        if any(character not in _DIGITS for character in given):
            return Frame(Outcome.FAULT)
        if len(given) < 2 or (code := int(given, 16)) in self._lengths:
            return None
        return Frame(Outcome.UNKNOWN, code)

    def _size(self) -> int | None:
        """Return the number of characters of the incomplete frame.

        The result is 0 while the instruction code is not complete, and `None` if the code is unknown.
        """
        if self._open[0] & 0xF0 == POLL:
            return 2
        if len(self._open) < 3:
            return 0
        code = _bytes(self._open[1:3])
        if code is None or code[0] not in self._lengths:
            return None
        return 1 + 2 * (1 + self._lengths[code[0]]) + 1

    def _check(self, given: bytes) -> Frame:
        data = _bytes(given[1:-1])
        if data is None or given[-1] != checksum(given[0], data, self._mode):
            return Frame(Outcome.FAULT)
        return Frame(Outcome.INSTRUCTION, data[0], data[1:]) if data else Frame(Outcome.POLL)


def _bytes(characters: bytes) -> bytes | None:
    """Return the bytes that lower-case hex digits represent.

    The result is `None` if the number of characters is odd or if one of them is not such a digit.
    """
    if len(characters) % 2 or any(character not in _DIGITS for character in characters):
        return None
    return bytes.fromhex(characters.decode())


_CYCLES = {5: Fraction(2500, 3), 6: Fraction(2500, 6), 7: Fraction(192)}
"""Number of crystal cycles of a bit, by the level of mod[2:0]."""


def bit_time(mod: int, clk_hz: int, xtal_hz: int) -> Fraction | None:
    """Return the number of cycles of a bit.

    The result is `None` if mod selects no documented speed; then the station does not send.
    """
    cycles = _CYCLES.get(mod)
    return None if cycles is None else cycles * clk_hz / xtal_hz


@unique
class ReportCode(IntEnum):
    """Data byte of each specific report, which is a reply of the kind SPECIFIC."""

    INTERLOCK = 0x22
    HOLD = 0x23
    ENCODE_INSIDE = 0x24
    ENCODE_OUTSIDE = 0x25
    POSITION_INSIDE = 0x26
    POSITION_OUTSIDE = 0x27
    OVERRIDE_DONE = 0x28
    EVENT_DONE = 0x29
    INPUT = 0x2A
    CHECKSUM = 0x41
    PARAMETER = 0x42
    STATUS = 0x43
    LIMIT = 0x44
    ALARM = 0x46
    UNKNOWN = 0x47
    SIZE = 0x48
    REGISTRATION = 0x49
    EVENT_FAILED = 0x4A
    OVERRIDE_FAILED = 0x4B


@unique
class Local(IntEnum):
    """Codes of instructions to which the station itself replies, without the instruction unit."""

    END_STATUS = 0x40
    ERROR_CODE = 0x4E
    ERROR_COUNT = 0x4F


END_CODES = {
    Cause.ALARM: 0x31,
    Cause.ORIGIN: 0x32,
    Cause.LIMIT: 0x33,
    Cause.LIMIT_SLOW: 0x34,
    Cause.SLOW: 0x36,
    Cause.STOP: 0x37,
    Cause.NORMAL: 0x38,
    Cause.LOW: 0x39,
}
"""Data of the reply to the end-status instruction 40, by cause (P312-SER-46)."""

ERRORS = {
    Answer.PARAMETER: ReportCode.PARAMETER,
    Answer.STATUS: ReportCode.STATUS,
    Answer.LIMIT: ReportCode.LIMIT,
    Answer.COMMAND: ReportCode.UNKNOWN,
    Answer.SIZE: ReportCode.SIZE,
    Answer.REGISTRATION: ReportCode.REGISTRATION,
}
_TRIGGERS = {0x00: (0x00, 0), 0x10: (OV, 4), 0x20: (OV | 1, 0), 0x30: (OV | 3, 0)}
"""Trigger of the codes 80, 81, 89 and 8A as (flag byte, number of trigger bytes) (P312-SER-40).

A key contains only bits 5:4 of the code; these bits select the trigger.
"""
_AUTO = 0x02
_REJECTED = (1, 2, 5)
"""Status bytes with which instruction 49 is rejected (P312-SER-43).

They mean: trigger in use, buffer full, nothing to delete.
"""


class SerialInstruction(NamedTuple):
    """Serial instruction: its number of data bytes, and its code and flag byte on the parallel bus."""

    n: int
    code: int
    flags: bytes = b""


def _serial_instructions() -> dict[int, SerialInstruction]:
    instructions = {
        0x00: SerialInstruction(8, Code.INITIAL),
        0x02: SerialInstruction(3, Code.IN_POSITION),
        0x03: SerialInstruction(3, Code.ENCODE),
    }
    instructions |= {
        0x04: SerialInstruction(4, Code.INTERLOCK_POSITION),
        0x05: SerialInstruction(2, Code.SPEED_LIMIT),
    }
    instructions |= {
        0x06: SerialInstruction(1, Code.END_TERMINAL),
        0x26: SerialInstruction(1, Code.OUTPUT),
        0x28: SerialInstruction(1, Code.MASK, b"\x01"),
    }
    instructions |= {
        code: SerialInstruction(0, code)
        for code in (0x20, 0x21, 0x22, 0x23, 0x24, 0x25, 0x27, 0x44, 0x45, 0x4D)
    }
    instructions |= {0x41: SerialInstruction(0, Code.VERSION), 0xFF: SerialInstruction(0, Code.RESET)}
    for bit, flag in ((0x00, b"\x00"), (0x20, b"\x01")):
        instructions |= {
            0x42 + bit: SerialInstruction(0, Code.POSITION_READ, flag),
            0x43 + bit: SerialInstruction(4, Code.POSITION_SET, flag),
        }
    for number in (0, 1):
        instructions[0x49 | number << 4] = SerialInstruction(10, Code.EVENT_SET, bytes([number]))
        instructions[0x69 | number << 4] = SerialInstruction(0, Code.EVENT_SET, bytes([number | 2]))
    for bits, (flags, more) in _TRIGGERS.items():
        instructions |= {
            first + bits: SerialInstruction(more, first, bytes([flags])) for first in (0x80, 0x81)
        }
        instructions |= {
            first + bits: SerialInstruction(2 + more, first - 2, bytes([flags])) for first in (0x89, 0x8A)
        }
    starts = {
        0x82: (0, Code.STEP),
        0x83: (6, Code.RAMP),
        0x84: (6, Code.CONSTANT),
        0x85: (2, Code.FOREVER_CONSTANT),
        0x86: (2, Code.FOREVER_RAMP),
        0x87: (2, Code.ORIGIN_SEARCH),
        0x88: (2, Code.ZERO_RETURN),
    }
    for first, (n, code) in starts.items():
        for bit, way in ((0x00, 0), (0x20, DIR)):
            instructions[first + bit] = SerialInstruction(n, code, bytes([way]))
            if code in (Code.ORIGIN_SEARCH, Code.ZERO_RETURN):
                instructions[first + bit + 0x10] = SerialInstruction(n, code, bytes([way | IDX]))
    return instructions


SERIAL_INSTRUCTIONS = _serial_instructions()
LENGTHS = {code: instruction.n for code, instruction in SERIAL_INSTRUCTIONS.items()} | dict.fromkeys(Local, 0)
"""Number of data bytes of every serial instruction."""


def block_of(code: int, data: bytes) -> bytes:
    """Return the block of the parallel bus for a serial instruction that is not `Local`, in logical order."""
    instruction, given = SERIAL_INSTRUCTIONS[code], data
    if code == 0x00:
        data = bytes([data[0] & 0x0F]) + data[1:]
    elif code in (0x02, 0x03):
        data = bytes([data[0] | _AUTO]) + data[1:]
    elif instruction.code == Code.EVENT_SET and data:
        data = data[: data[1] + 2]
        if len(data) != given[1] + 2:
            # The embedded instruction is longer than the frame permits, so its length byte is wrong.
            return bytes([0x03, 0, instruction.code]) + instruction.flags + data
    body = bytes([instruction.code]) + instruction.flags + data
    return bytes([0x03, len(body)]) + body


def reply_of(answer: bytes) -> tuple[int, bytes]:
    """Return (kind, data) of the reply to an instruction.

    Args:
        answer: response of the parallel bus, in logical order.
    """
    code, content = answer[2], answer[3:]
    if code in ERRORS:
        return SPECIFIC, bytes([ERRORS[Answer(code)]])
    if code == Code.EVENT_SET and content[0] in _REJECTED:
        return SPECIFIC, bytes([ReportCode.REGISTRATION])
    if code in (Code.INPUT, Code.TERMINALS, Code.VERSION, Code.STATUS):
        return DATA, content
    if code == Code.POSITION_READ:
        return DATA, content[1:]
    return READY, b""


def poll_reply_of(kind: int, report: bytes) -> tuple[int, bytes]:
    """Return (kind, data) of the reply to a poll (P312-SER-30).

    Args:
        report: report of a class in logical order.
    """
    content = report[3:]
    if kind == responses.STOPPED:
        return DATA, bytes([END_CODES[Cause(content[0])]])
    if kind == responses.INPUT:
        return SPECIFIC, bytes([ReportCode.INPUT]) + content
    if kind in (responses.POSITION, responses.ENCODE):
        inside = ReportCode.POSITION_INSIDE if kind == responses.POSITION else ReportCode.ENCODE_INSIDE
        return SPECIFIC, bytes([inside + content[0]])
    single = {responses.ALARM: ReportCode.ALARM, responses.INTERLOCK: ReportCode.INTERLOCK}
    return SPECIFIC, bytes([single.get(kind, ReportCode.HOLD)])
