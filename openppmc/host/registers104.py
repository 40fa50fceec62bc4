"""The PPMC-104's readable registers as dataclasses (P104-STA-01..06, P104-RD-06). Pure."""

from __future__ import annotations

from dataclasses import dataclass

from ..model.codes104 import BUSY, ERR, IBF, OBF, Error


@dataclass(frozen=True)
class Status:
    """Status register. error: number of the last byte's error or None. expected: parameter bytes wanted."""

    raw: int
    busy: bool
    error: Error | None
    expected: int
    input_full: bool
    output_full: bool

    @classmethod
    def parse(cls, raw: int) -> Status:
        """From the byte."""
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


@dataclass(frozen=True)
class Inputs:
    """Switches; True: active (pin low)."""

    limit_cw: bool
    limit_ccw: bool
    slow_cw: bool
    slow_ccw: bool
    origin: bool
    alarm: bool

    @classmethod
    def of_pins(cls, raw: int) -> Inputs:
        """From the bridge's PINS byte; unlike command 0x81 it may be asked for during a motion."""
        return cls(*(not raw >> bit & 1 for bit in (2, 3, 4, 5, 6, 7)))

    @property
    def active(self) -> list[str]:
        """Names of the active ones."""
        return [name.replace("_", " ") for name, on in vars(self).items() if on]


@dataclass(frozen=True)
class Outputs:
    """Motor outputs. phases: levels of S1 to S5; hold: the motor has rested for 34 ms; ccw: level of DIR."""

    phases: tuple[int, ...]
    hold: bool
    ccw: bool

    @classmethod
    def parse(cls, raw: int) -> Outputs:
        """From the byte of command 0x82."""
        return cls(tuple(raw >> bit & 1 for bit in (7, 6, 5, 4, 3)), bool(raw & 4), bool(raw & 2))
