"""The registers of a bank's window, and what they tell, as dataclasses (BANK-WIN-02, -03, -07). Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from ..axis.registers import Inputs, Status

STATUS, CONFIG, SELECT, POSITION = 0x1, 0x2, 0x3, 0x4
"""Of an axis. SELECT is the bridge's view of the window: the axis whose registers all others are."""
MASK, PENDING, GO, STOP, INFO = 0x8, 0x9, 0xA, 0xB, 0xC
"""Of the bank."""
MARK, VERSION = 0x42, 0x01
CSEL, VSEL = 0x01, 0x02
POSITION_BYTES = 4


class Info(NamedTuple):
    """INFO: version of the window, number of axes."""

    version: int
    axes: int


class Config(NamedTuple):
    """CONFIG of an axis. csel: base clock XTAL / 32 (1) or XTAL / 128; vsel 0: 7.5 us more an interval."""

    csel: int
    vsel: int

    @classmethod
    def parse(cls, raw: int) -> Config:
        """From the byte."""
        return cls(int(bool(raw & CSEL)), int(bool(raw & VSEL)))


@dataclass(frozen=True)
class Look:
    """What one look at an axis shows; position as the axis counts, `Axis.zero` included."""

    status: Status
    position: int
    inputs: Inputs


@dataclass(frozen=True)
class BankStatus:
    """All status registers, axis 1 first. raw: as one number, axis 1 in the low byte."""

    raw: int
    axes: tuple[Status, ...]

    @classmethod
    def parse(cls, raw: bytes) -> BankStatus:
        """From a byte an axis."""
        return cls(int.from_bytes(raw, "little"), tuple(Status.parse(byte) for byte in raw))

    @property
    def busy(self) -> tuple[int, ...]:
        """Numbers of the axes that move."""
        return tuple(number for number, one in enumerate(self.axes, 1) if one.busy)


def members(raw: bytes) -> tuple[int, ...]:
    """Numbers of the axes whose bits are 1 in a register of a bit an axis, byte 0 first."""
    bits = int.from_bytes(raw, "little")
    return tuple(place + 1 for place in range(8 * len(raw)) if bits >> place & 1)


def bit_bytes(numbers: tuple[int, ...], axes: int) -> bytes:
    """A register of a bit an axis with those of these axes 1, byte 0 first."""
    return sum(1 << number - 1 for number in numbers).to_bytes((axes + 7) // 8, "little")
