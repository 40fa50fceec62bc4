"""Frames, speeds and times of the serial mode of the PPMC-312, and settings that its tests use."""

from __future__ import annotations

from fractions import Fraction

SPEEDS = {5: Fraction(19_200), 6: Fraction(38_400), 7: Fraction(250_000, 3)}
"""Speeds in bits/s for mod[2:0], with a 16 MHz crystal."""
T_EXEC, T_INIT = 4_096, 65_536
"""Maximum number of cycles before the reply: T_EXEC to any instruction except 00, T_INIT to instruction 00.
"""
SILENCE = 320_000
"""20 ms in cycles at 16 MHz."""

T1 = "00 01 03E8 00C8 0007D0"
"""F = 1 MHz, linear curve, rates 1000 to 200, 2000 pulses."""
TS = "00 00 01F4 00C8 000320"
"""F = 8 MHz, linear curve, rates 500 to 200, 800 pulses: a pulse interval is 400 to 1000 cycles."""


def summed(control: int, data: bytes = b"", mode: str = "BINARY") -> bytes:
    """Return a frame with its checksum (P312-SER-13)."""
    text = "".join(f"{byte:02x}" for byte in data).encode("ascii")
    total = sum(text) if mode == "CHARS" else (control + sum(data)) % 256
    return bytes([control]) + text + bytes([(total ^ 0xFF) & 0x7F])
