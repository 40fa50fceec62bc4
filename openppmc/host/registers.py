"""Readable registers of PPMC-104 and STMC as dataclasses (P104-STA-01..06, P104-RD-06). Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from ..model.single.codes import BUSY, ERR, IBF, OBF, Error


@dataclass(frozen=True)
class Status:
    """Status register.

    Attributes:
        error: error number of the last byte, or `None`.
        expected: number of parameter bytes still required.
    """

    raw: int
    busy: bool
    error: Error | None
    expected: int
    input_full: bool
    output_full: bool

    @classmethod
    def parse(cls, raw: int) -> Status:
        """Decode the status byte."""
        number = raw >> 4 & 7
        faulty = bool(raw & ERR)
        return cls(
            raw,
            busy=bool(raw & BUSY),
            error=Error(number) if faulty else None,
            expected=0 if faulty else number,
            input_full=bool(raw & IBF),
            output_full=bool(raw & OBF),
        )


Pins = TypeVar("Pins", bound="Switches")


@dataclass(frozen=True)
class ReadCodes:
    """Codes of those read commands whose codes differ between parts."""

    outputs: int = 0x82
    remaining: int = 0x83


FAMILY = ReadCodes()
"""Codes of these read commands on most parts."""


@dataclass(frozen=True)
class Switches:
    """Switches of an axis; True = active (pin low). Subclasses add the sixth switch of the part."""

    limit_cw: bool
    limit_ccw: bool
    slow_cw: bool
    slow_ccw: bool
    origin: bool

    @classmethod
    def of_pins(cls: type[Pins], raw: int) -> Pins:
        """Decode the PINS byte of the bridge, which can be read during a motion (unlike command 0x81)."""
        return cls(*(not raw >> bit & 1 for bit in (2, 3, 4, 5, 6, 7)))

    @property
    def active(self) -> list[str]:
        """Names of the active switches."""
        return [name.replace("_", " ") for name, on in vars(self).items() if on]


@dataclass(frozen=True)
class Inputs(Switches):
    """Switches of a PPMC part."""

    alarm: bool


@dataclass(frozen=True)
class Outputs:
    """Motor outputs.

    Attributes:
        phases: levels of S1 to S5.
        hold: True if the motor has been stopped for 34 ms.
        ccw: level of DIR; True is CCW.
    """

    phases: tuple[int, ...]
    hold: bool
    ccw: bool

    @classmethod
    def parse(cls, raw: int) -> Outputs:
        """Decode the byte of the read command."""
        return cls(tuple(raw >> bit & 1 for bit in (7, 6, 5, 4, 3)), bool(raw & 4), bool(raw & 2))
