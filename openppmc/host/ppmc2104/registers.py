"""The PPMC-2104's status register as a dataclass (P2104-STA-01). Pure."""

from __future__ import annotations

from dataclasses import dataclass

from ...model.motion.codes import IBF, OBF
from ...model.ppmc2104.codes import BUSY, CMND, ERROR


@dataclass(frozen=True)
class Status:
    """Status register. busy, working: of axis 1 and 2; working: data are wanted, or a command is under way.
    error: an error register is not 0."""

    raw: int
    busy: tuple[bool, bool]
    working: tuple[bool, bool]
    error: bool
    input_full: bool
    output_full: bool

    @classmethod
    def parse(cls, raw: int) -> Status:
        """From the byte."""
        return cls(
            raw,
            busy=(bool(raw & BUSY[0]), bool(raw & BUSY[1])),
            working=(bool(raw & CMND[0]), bool(raw & CMND[1])),
            error=bool(raw & ERROR),
            input_full=bool(raw & IBF),
            output_full=bool(raw & OBF),
        )
