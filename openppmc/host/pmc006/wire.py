"""Frames, instructions, status bits and errors of the PMC006B4, as seen by a host. Pure.

>>> command(1, 0x73, 287).hex(" ")
'a5 01 73 1f 01 00 00 39'
>>> receiver = Receiver(1)
>>> [receiver.feed(byte) for byte in bytes.fromhex("A5 7A 01 03 00 00 00 23")][-1]
Reply(address=1, value=3)
"""

# ruff: noqa: N818

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, NamedTuple

from ...lazy import renamed
from ...parts import part
from ..capabilities import OWN_SETTINGS, Capabilities
from ..check import whole
from ..errors import CommandRefused, OutOfRange
from ..line_port import Fault


class Code(IntEnum):
    """Instruction codes. The character of a code is the name of the instruction in manuals."""

    POINTER = ord("A")
    BURN = ord("B")
    TRY = ord("E")
    OFFLINE = ord("F")
    READ_WORD = ord("G")
    ABORT = ord("I")
    TRIGGER = ord("J")
    READ_TRIGGER = ord("K")
    START_SPEED = ord("L")
    CURRENT_COMPENSATION = ord("M")
    RUN = ord("N")
    STATUS_2 = ord("O")
    SPEED_COMPENSATION = ord("P")
    ATTENUATION = ord("Q")
    VERSION = ord("R")
    STOP_SPEED = ord("S")
    STALL_LENGTH = ord("T")
    READ_ATTENUATION = ord("U")
    STORED = ord("V")
    WRITE_WORD = ord("W")
    STALL_POSITION = ord("X")
    STALL_CONFIG = ord("Y")
    STALL_LEVEL = ord("Z")
    AUTO_DECAY = ord("a")
    CLEAR_EXT1 = ord("b")
    POSITION = ord("c")
    DIRECTION = ord("d")
    CURRENT = ord("e")
    EXT_ENABLE = ord("f")
    FREE = ord("g")
    READ_DECELERATION = ord("h")
    SET_POSITION = ord("i")
    STATUS_1 = ord("j")
    READ_MICROSTEPS = ord("k")
    CLEAR_EXT2 = ord("l")
    MICROSTEPS = ord("m")
    READ_CURRENT = ord("n")
    DECELERATION = ord("o")
    CLEAR_STALL = ord("p")
    READ_MAX_SPEED = ord("q")
    READ_ACCELERATION = ord("r")
    STEP = ord("s")
    SAVE = ord("t")
    ACCELERATION = ord("u")
    MAX_SPEED = ord("v")
    ADDRESS = ord("w")
    READ_IO = ord("x")
    WRITE_IO = ord("y")
    RUN_PROGRAM = ord("z")


@dataclass(frozen=True)
class Flags:
    """Status 1.

    Attributes:
        busy: True if a motion is planned or running.
        ext1, ext2: True if this input has stopped the motor and blocks starts.
    """

    busy: bool
    ext1: bool
    ext2: bool
    auto_decay: bool
    stall: bool

    @classmethod
    def parse(cls, value: int) -> Flags:
        """Decode the reply to `j`.

        >>> Flags.parse(0x0A).ext1, Flags.parse(8).busy
        (True, False)
        """
        return cls(*(bool(value >> bit & 1) for bit in range(5)))

    @property
    def stops(self) -> tuple[int, ...]:
        """Numbers of the EXT inputs whose stop has occurred."""
        return tuple(number for number, on in ((1, self.ext1), (2, self.ext2)) if on)


@dataclass(frozen=True)
class Modes:
    """Status 2.

    Attributes:
        free: True if the motor is switched off (FREE).
        running: True in speed mode.
        forward: True if the next motion is forward.
        offline: True if the program starts automatically after power-up.
    """

    free: bool
    ext1_enabled: bool
    ext2_enabled: bool
    running: bool
    forward: bool
    offline: bool

    @classmethod
    def parse(cls, value: int) -> Modes:
        """Decode the reply to `O`."""
        return cls(*(bool(value >> bit & 1) for bit in range(6)))


@dataclass(frozen=True)
class Ports:
    """Word with the levels of all inputs and outputs.

    Attributes:
        inputs, outputs: levels of the pins; GPI1 and GPO1 are bit 0.
        ext1, ext2: levels of the pins EXT1 and EXT2.
    """

    inputs: int
    outputs: int
    ext1: bool
    ext2: bool

    @classmethod
    def parse(cls, word: int) -> Ports:
        """Decode the reply to `x`.

        >>> Ports.parse(0xE09)
        Ports(inputs=17, outputs=1, ext1=True, ext2=True)
        """
        inputs = word & 7 | (word >> 8 & 3) << 3
        return cls(inputs, word >> 3 & 31, bool(word >> 10 & 1), bool(word >> 11 & 1))

    def level(self, ext: int) -> bool:
        """Return the level of EXT1 or EXT2."""
        return self.ext2 if ext == 2 else self.ext1


class Storage(IntEnum):
    """Reply to `V`: result of the last save, burn or restore of the EEPROM.

    The original part does not have the instruction V.
    """

    KEPT = 0
    WORKING = 1
    FAILED = 2


STATUS_1_BITS, STATUS_2_BITS, PORT_BITS = 5, 6, 12
"""Number of bits in use of status 1, status 2 and the word of the ports.

A reply with other bits set is invalid.
"""


# Errors of a PMC006B4. `status` is the data of the reply.


class SettingRefused(CommandRefused):
    """The part rejected the value for a setting. The active value is unchanged; `status` holds it."""


class ExtStopActive(CommandRefused):
    """An EXT stop has occurred; starts are rejected until its flag is cleared."""


class MotorDisabled(CommandRefused):
    """The motor is switched off (FREE)."""

    text = "the motor is off-line (free): switch it on first (free = 0)"


class SpeedRefused(CommandRefused):
    """The start speed or stop speed is above the maximum speed."""


class StorageBusy(CommandRefused):
    """The EEPROM is being written."""

    text = "the EEPROM is still being written: try again in half a second"


class StorageFailed(CommandRefused):
    """The EEPROM did not respond."""

    text = "the EEPROM did not respond, so nothing was stored: check that it exists, and its wires"


class ProgramRuns(CommandRefused):
    """A user program is running."""

    text = "a user program runs: halt it first"


class ProgramVerifyFailed(CommandRefused):
    """The program that was read back differs from the one that was written."""


def locked(numbers: tuple[int, ...], prefix: str = "") -> ExtStopActive:
    """Return the exception for a start that these EXT flags prevent.

    >>> str(locked((1,)))
    'EXT1 has stopped the motor: clear the flag (clear_stops, reset-flags), then move off the switch'
    """
    names, flags = " and ".join(f"EXT{number}" for number in numbers), "flags" if len(numbers) > 1 else "flag"
    have = "have" if len(numbers) > 1 else "has"
    return ExtStopActive(
        sum(1 << number for number in numbers),
        f"{prefix}{names} {have} stopped the motor: clear the {flags} (clear_stops, reset-flags), "
        "then move off the switch",
    )


HEAD, ANSWER, SIZE = 0xA5, 0x7A, 8
FACTORY, LAST = 255, 120
ADDRESSES = (FACTORY, *range(1, LAST + 1))
"""All valid addresses, in the order in which a host polls them during a search."""


class Reply(NamedTuple):
    """Reply of a controller.

    Attributes:
        value: its data, signed.
    """

    address: int
    value: int


def address_number(address: int) -> int:
    """Return the address unchanged. Raises OutOfRange if no controller can have it."""
    number = whole(address, "address")
    if number not in ADDRESSES:
        raise OutOfRange(f"address {number}: controllers have 1 to {LAST}, factory-new ones {FACTORY}")
    return number


def command(address: int, code: int, data: int = 0) -> bytes:
    """Return a frame to a controller.

    Args:
        data: 32 bits, signed or unsigned.
    """
    return _sealed(bytes([HEAD, address, code]) + (data & 0xFFFFFFFF).to_bytes(4, "little"))


def reply(address: int, value: int) -> bytes:
    """Return a frame from a controller."""
    return _sealed(bytes([HEAD, ANSWER, address]) + (value & 0xFFFFFFFF).to_bytes(4, "little"))


def _sealed(body: bytes) -> bytes:
    return body + bytes([sum(body) & 0xFF])


class Receiver:
    """Receiver for the bytes after a frame to `address`; see `host.line.ReplyReceiver`.

    Replies of other controllers, and damaged replies, are skipped, because the expected reply may follow. The
    property `fault` then states the reason.

    Args:
        sent: frame that was sent. If the master receives its own bytes, this frame is skipped.
    """

    def __init__(self, address: int, sent: bytes = b"") -> None:
        self._address = address
        self._echo = sent
        self._matched = 0
        self._open = b""
        self._foreign = self._broken = False
        self._noise = False

    @property
    def fault(self) -> Fault | None:
        """Fault that the received bytes contain instead of the reply, `None` if no byte was received."""
        if self._broken or self._open:
            return Fault.BROKEN
        if self._foreign:
            return Fault.FOREIGN
        return Fault.NOISE if self._noise else None

    def feed(self, byte: int) -> Reply | Fault | None:
        """Process a byte; return the reply if it is complete."""
        if self._matched < len(self._echo):
            if byte == self._echo[self._matched]:
                self._matched += 1
                self._open = b"" if self._matched == len(self._echo) else self._open + bytes([byte])
                return None
            self._echo = b""
        self._open += bytes([byte])
        return self._match_frame()

    def _match_frame(self) -> Reply | None:
        """Return the reply in the bytes received so far, `None` if they contain no complete reply."""
        while self._open:
            start = next((at for at in range(len(self._open)) if _begins(self._open[at:])), len(self._open))
            self._noise |= start > 0
            self._open = self._open[start:]
            if len(self._open) < SIZE:
                return None
            whole = self._open[:SIZE]
            if sum(whole[:-1]) & 0xFF != whole[-1]:
                self._broken = True
                self._open = self._open[1:]
            elif whole[2] != self._address:
                self._foreign = True
                self._open = self._open[SIZE:]
            else:
                return Reply(whole[2], int.from_bytes(whole[3:7], "little", signed=True))
        return None


def _begins(data: bytes) -> bool:
    """Return True if these bytes can be the beginning of a reply."""
    return data[0] == HEAD and data[1:2] in (b"", bytes([ANSWER]))


# Capabilities of a PMC006B4.

CAPABILITIES = Capabilities(part("pmc006"), has=frozenset((OWN_SETTINGS,)), outputs=31)


if not TYPE_CHECKING:
    __getattr__ = renamed(
        __name__,
        {
            "LockedByExt": "ExtStopActive",
            "MotorFree": "MotorDisabled",
            "ProgramDiffers": "ProgramVerifyFailed",
        },
    )
