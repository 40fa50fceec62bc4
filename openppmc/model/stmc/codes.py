"""Command codes of the STMC (table 3.0 of its rules).

Status bits and error numbers are those of `single.codes`.
"""

from __future__ import annotations

from ..motion.codes import Command, Kind, operation_command

INIT_BYTES = 4
# Period of the internal step clock in crystal periods (STMC-CLK-01).
TICK_XT = 1280
# Frequency of the external step clock, which the board generates, in Hz (J105-06).
BOARD_CLOCK_HZ = 48_675
FINISH_STATUS, INPUTS, OUTPUTS, REMAINING = "finish status", "inputs", "outputs", "remaining steps"

# Meaning of each read code, by READ_MAP; the default is first (docs/stmc/README.md, 6.6 Reads).
READ_MAPS: dict[str, dict[int, str]] = {
    "FAMILY": {0x80: FINISH_STATUS, 0x81: INPUTS, 0x82: OUTPUTS, 0x83: REMAINING},
    "SHEET": {0x80: FINISH_STATUS, 0x82: INPUTS, 0x83: OUTPUTS, 0x84: REMAINING},
}


def decode(code: int, read_map: str = "FAMILY") -> Command:
    """Decode one of the 256 command bytes. Raises ValueError outside 0..255."""
    if not 0 <= code <= 255:
        raise ValueError(f"command byte {code}")
    if code < 0x40:
        # Motor type 00 has no meaning (STMC-INI-05).
        return Command(Kind.INITIALISE, code, INIT_BYTES) if code & 3 else Command(Kind.UNDEFINED, code)
    if code < 0x80:
        if code & 6:
            return operation_command(code)
        return Command(Kind.SLOW_STOP if code & 1 else Kind.STOP, code)
    return Command(Kind.READ if code in READ_MAPS[read_map] else Kind.UNDEFINED, code)
