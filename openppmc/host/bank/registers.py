"""Capabilities, errors and window registers of a bank (BANK-WIN-02, -03, -07). Pure."""

# ruff: noqa: N818

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from ...parts import part
from .. import speeds
from ..capabilities import CHOPPER, COILS_OFF, LONG, POSITIVE, PULSE_ONLY, RateCapabilities, SetupRequest
from ..errors import BY_NUMBER, CommandRefused, NothingToStop, PpmcError
from ..registers import Inputs, Status

# Errors of an axis of a bank.

NOTHING_HELD = "GO found no waiting motion: start one while the axis is in the group"


def command_error(status: int, number: int) -> CommandRefused:
    """Return the exception for a status byte with ERR = 1 of the axis with this number."""
    kind = BY_NUMBER[status >> 4 & 7]
    return kind(status, f"axis {number}: {kind.text}")


def go_error(status: int, number: int) -> CommandRefused:
    """Return the exception for a status byte with ERR = 1 after GO (BANK-GRP-02)."""
    error = command_error(status, number)
    return NothingToStop(status, f"axis {number}: {NOTHING_HELD}") if type(error) is NothingToStop else error


class GroupRefused(PpmcError):
    """Some axes of a group did not start; the other axes of the group are running.

    Args:
        refusals: exception of each axis, by number.
    """

    def __init__(self, refusals: Mapping[int, CommandRefused]) -> None:
        super().__init__("; ".join(str(one) for one in refusals.values()))
        self.refusals = dict(refusals)


# Registers, written by `make packages` from packages/registers/ppmc_bank.rdl.
DATA = 0x0  # read: byte of a response; write: data byte
STATUS = 0x1  # result of the last byte, state of part and buffers
COMMAND = 0x1  # command byte
CONFIG = 0x2  # levels of the pins of the old chip
POSITION = 0x4  # position of the axis, low byte first; a read of the first byte latches the other three
MASK = 0x8  # byte k: members of the group
PENDING = 0x9  # byte k: map of the interrupts pending
GO = 0xA  # any byte: the held operations of the group continue; reads as 0x00
STOP = 0xB  # any byte: every motion ends; reads as 0x00
INFO = 0xC  # k = 0: 0x42 ("B"); 1: 0x01 (version); 2: N; else 0x00
ERR = 0x80  # the most recent byte, command or data, was faulty
NUM = 0x70  # ERR = 0: number of parameter bytes still expected, 0 to 4; ERR = 1: error number
BUSY = 0x04  # an operation is running (not during initialisation)
IBF = 0x02  # the input buffer is full: do not write
OBF = 0x01  # the data register holds an unread byte
VSEL = 0x02  # intervals by the rate formula alone, else 7.5 us longer
CSEL = 0x01  # base clock XTAL / 32, else XTAL / 128
INFO_MARK = 0x42  # byte 0
INFO_VERSION = 0x01  # byte 1: version of the window
# End of the registers.
SELECT = 0x3
"""Register of the bridge that selects the axis to which all other registers belong."""
POSITION_BYTES = 4


class Info(NamedTuple):
    """Content of INFO: version of the window, number of axes."""

    version: int
    axes: int


class Config(NamedTuple):
    """Content of the register CONFIG of an axis.

    Attributes:
        csel: base clock XTAL / 32 (1) or XTAL / 128 (0).
        vsel: level of vsel; 0 makes each interval 7.5 us longer.
    """

    csel: int
    vsel: int

    @classmethod
    def parse(cls, raw: int) -> Config:
        """Decode the CONFIG byte."""
        return cls(int(bool(raw & CSEL)), int(bool(raw & VSEL)))


@dataclass(frozen=True)
class AxisSnapshot:
    """State of an axis at one time.

    Attributes:
        position: position counter of the axis, plus the offset that `BankAxis.zero` has stored.
    """

    status: Status
    position: int
    inputs: Inputs


@dataclass(frozen=True)
class BankStatus:
    """Status registers of all axes, axis 1 first.

    Attributes:
        raw: all status registers as one number, axis 1 in the lowest byte.
    """

    raw: int
    axes: tuple[Status, ...]

    @classmethod
    def parse(cls, raw: bytes) -> BankStatus:
        """Decode one byte per axis."""
        return cls(int.from_bytes(raw, "little"), tuple(Status.parse(byte) for byte in raw))

    @property
    def busy(self) -> tuple[int, ...]:
        """Numbers of the axes that move."""
        return tuple(number for number, one in enumerate(self.axes, 1) if one.busy)


def members(raw: bytes) -> tuple[int, ...]:
    """Return the numbers of the axes whose bits are 1 in a register.

    The register has one bit per axis, byte 0 first.
    """
    bits = int.from_bytes(raw, "little")
    return tuple(place + 1 for place in range(8 * len(raw)) if bits >> place & 1)


def bit_bytes(numbers: tuple[int, ...], axes: int) -> bytes:
    """Return the bytes of a register in which only the bits of these axes are 1.

    The register has one bit per axis, byte 0 first.
    """
    return sum(1 << number - 1 for number in numbers).to_bytes((axes + 7) // 8, "little")


# Capabilities of a bank of PPMC-104 axes.

SIZES = (4, 8, 16, 32, 64)
"""Supported numbers of axes (BANK-GEN-01)."""


class BankCapabilities(RateCapabilities):
    """Capabilities of a PPMC-104, without the functions that BANK-GEN-03 excludes."""

    def ramp_clock(self, xtal_hz: int, request: SetupRequest) -> speeds.BaseClock:
        if request.external_clock is not None:
            self.need("external clock")
        return super().ramp_clock(xtal_hz, request)


CAPABILITIES = BankCapabilities(
    part("bank"),
    axes=SIZES[-1],
    has=frozenset((POSITIVE, LONG, PULSE_ONLY, COILS_OFF, CHOPPER)),
    outputs=0,
)
"""Capabilities of the largest bank. A driver uses the capabilities of its own bank."""
