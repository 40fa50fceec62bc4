"""Bytes of a J105 STMC host as text."""

from __future__ import annotations

from collections.abc import Sequence

from ...model.stmc import codes
from ..common.mnemonics import END_STATUS, INPUTS, OUTPUTS, REMAINING, OneAxisDecoder

ERRORS = (
    "undefined command, or a stop at rest",
    "not allowed while BUSY",
    "not initialised",
    "unexpected data byte",
    "unused",
    "divisor 0, or slow divisor below fast one",
    "unexpected data byte while BUSY",
    "already decelerating",
)


class StmcDecoder(OneAxisDecoder):
    """Decoder for the bytes of a J105 STMC: one axis with divisors, error numbers in the status register.

    Args:
        read_map: name of the set of read codes.
    """

    errors = ERRORS
    operations = {
        2: ("single step", 0),
        3: ("accelerate/decelerate", 3),
        4: ("constant speed", 4),
        5: ("constant speed to the limit", 1),
        6: ("accelerate to the limit", 0),
        7: ("constant speed to the reference point", 1),
    }
    causes = (
        (0x40, "a stop command"),
        (0x20, "MON low"),
        (0x10, "the limit"),
        (0x08, "the deceleration limit"),
    )
    switches = ((0x80, "CNP"), (8, "L1"), (4, "L2"), (2, "L3"), (1, "L4"))
    setting_names = ("D1", "D2", "PA")
    unit, speed, rate = "step", "thousand steps/s", "divisor"
    clock = "external clock"

    def __init__(self, read_map: str) -> None:
        kinds = {
            codes.FINISH_STATUS: END_STATUS,
            codes.INPUTS: INPUTS,
            codes.OUTPUTS: OUTPUTS,
            codes.REMAINING: REMAINING,
        }
        registers = codes.READ_MAPS[read_map]
        self.reads = {
            code: (f"read {name}", 3 if name == codes.REMAINING else 1) for code, name in registers.items()
        }
        self.read_codes = {code: kinds[name] for code, name in registers.items()}

    def ramp(self, data: Sequence[int]) -> str:
        """Return the divisors and the length of the ramp as text; an empty text if they are incomplete."""
        if len(data) < 4:
            return ""
        return f"; slow {data[0]}, fast {data[1]}, {data[2] | data[3] << 8} steps of acceleration"

    def command(self, code: int, data: Sequence[int]) -> str:
        """Return a command with its data bytes as text; bit 5 of a motion command has no effect."""
        return super().command(code & ~0x20 if code & 0xC0 == 0x40 else code, data)

    def end(self, byte: int) -> str:
        """Return how the last motion ended as text; no bit indicates the reference point."""
        return f"{self.operations[7][0]}: found" if byte & 0x7F == 7 else super().end(byte)

    def inputs(self, byte: int) -> str:
        """Return the active switches and MON as text."""
        return super().inputs(byte) + (", motor on" if byte & 0x40 else ", motor off")
