"""Bytes of a PPMC-2104AFP host as text."""

from __future__ import annotations

from collections.abc import Sequence

from ..common.mnemonics import CommandDecoder

FLAGS = (
    (0x20, "CMND2"),
    (0x10, "CMND1"),
    (0x08, "BUSY2"),
    (0x04, "BUSY1"),
    (0x02, "IBF"),
    (0x01, "OBF"),
)


class Ppmc2104Decoder(CommandDecoder):
    """Decoder for the bytes of a PPMC-2104, which has two axes and a separate register for error numbers."""

    reads = {
        0x80: ("read end status", 1),
        0x81: ("read control inputs", 1),
        0x82: ("read output signals", 1),
        0x83: ("read remaining pulses", 3),
        0x86: ("read error code", 1),
        0xC2: ("read auxiliary inputs", 1),
    }
    switches = ((0x80, "ORG"), (0x40, "ALM"), (8, "FL"), (4, "FHL"), (2, "BL"), (1, "BHL"))

    def axis(self, code: int) -> int:
        """Return bit 5 of a code, which selects the axis; 0 for auxiliary codes, which have no axis."""
        return 0 if code & 0xCF == 0xC1 or code == 0xC2 else code & 0x20

    def status(self, byte: int) -> str:
        """Return the names of the flags that are set in the status register as text."""
        flags = [name for bit, name in FLAGS if byte & bit]
        if byte & 0x80:
            flags.append("ERROR")
        return ", ".join(flags) or "ready, nothing pending"

    def setting(self, code: int, data: Sequence[int]) -> str:
        """Return motor, step, clock, chopping and ramp as text."""
        step = "half" if code & 4 else "full"
        clock = "EXTCK pin" if code & 0x08 else "internal clock"
        chop = "switched at rest" if code & 0x10 else "full current at rest"
        return f"initial setting: {(code & 3) + 2} phases, {step} step, {clock}, {chop}{self.ramp(data)}"

    def other(self, code: int, data: Sequence[int]) -> str:
        """Return an auxiliary code as text; the base class decodes all other codes."""
        if code & 0xCF == 0xC1:
            return f"AUXO1 {'HL'[code >> 5 & 1]}, AUXO0 {'HL'[code >> 4 & 1]}"
        if code & 0xDF == 0xC0:
            return "excitation off"
        return super().other(code & ~self.axis(code), data)

    def phases(self, byte: int) -> str:
        """Return the phase bits of the output register as text: 0 = on."""
        active = [f"S{index + 1}" for index in range(5) if not byte & 0x80 >> index]
        return f"{' '.join(active) or 'no phase'} on"

    def command(self, code: int, data: Sequence[int]) -> str:
        """Return a command with its data bytes and its axis as text."""
        number = 2 if self.axis(code) else 1
        text = super().command(code, data)
        return text if code & 0xCF == 0xC1 or code == 0xC2 else f"axis {number}: {text}"

    def answer(self, code: int, data: Sequence[int], stopped: bool) -> str:
        """Return the error number as text; the base class decodes all other responses."""
        if code == 0x86:
            return f"error {data[0]}" if data[0] else "no error"
        return super().answer(code, data, stopped)
