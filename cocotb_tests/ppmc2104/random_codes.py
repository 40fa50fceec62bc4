"""Instructions with data for the random hosts of the PPMC-2104AFP; most are legal and of short duration."""

from __future__ import annotations

import random

OPERATIONS = (0x42, 0x43, 0x43, 0x43, 0x44, 0x44, 0x45, 0x46, 0x47, 0xC3, 0xC3, 0xC6)
KNOWN_CODES = (
    0x40, 0x41, 0x42, 0x43, 0x44, 0x80, 0x81, 0x83, 0x84, 0x85, 0x86, 0x0A, 0x12, 0xC0, 0xC1, 0xC2, 0x87,
)  # fmt: skip
WRONG_SETTINGS = (
    (5, 4, 100),
    (5, 6, 100),
    (5, 0, 100),
    (9, 4, 3),
    (9, 4, 11221),
    (5, 6, 0xFFFF),
    (0, 255, 0),
)
COUNTS = (1, 1, 2, 3, 4, 5, 7, 8, 9, 10, 13, 21, 22, 30, 40, 60, 1000)

Instruction = tuple[int, list[int]]


class Codes:
    """Generator of instructions.

    Args:
        external: for each axis, whether its external clock runs.
    """

    def __init__(self, rng: random.Random, datasheet: bool, external: tuple[bool, bool]) -> None:
        self.rng = rng
        self.datasheet = datasheet
        self.external = external

    def setting(self, axis: int, wrong: float) -> Instruction:
        """Return an initial setting; with the probability `wrong` it may be one that is rejected."""
        rng = self.rng
        external = self.external[axis - 1] and rng.random() < 0.8
        code = rng.choice((1, 2, 3)) | rng.getrandbits(1) << 2 | external << 3 | rng.getrandbits(1) << 4
        rl, rh, pa = self._ramp(0 if external else 1)
        if rng.random() < wrong:
            rl, rh, pa = rng.choice(WRONG_SETTINGS)
        return code | (axis - 1) << 5, [rl, rh, pa & 0xFF, pa >> 8]

    def _ramp(self, lowest: int) -> tuple[int, int, int]:
        """Return a legal (RL, RH, PA); most are small, so that their tables are built quickly."""
        rng = self.rng
        kind = rng.random()
        if self.datasheet and kind < 0.8:  # near the rate limits
            rh = rng.choice((0x0B, 0x0C, 0x11, 0x12, 0x18, 0x19, 0x22, 0x23))
            return rh + rng.randint(2, 20), rh, rng.choice((4, 5, 8))
        if kind < 0.65:
            rl = rng.choice((3, 5, 9, 12, 19, 25))
            return rl, rng.randint(lowest, rl - 2), rng.choice((4, 4, 5, 6, 8, 10, 15))
        if kind < 0.75:  # the ramp begins flat: its first indices have the rate RL
            rl = rng.randint(4, 16)
            return rl, rl - 2, rng.randint(4, 24)
        if kind < 0.9 or self.datasheet:
            rl = rng.randint(3, 60)
            return rl, rng.randint(lowest, rl - 2), rng.randint(4, 60)
        return rng.choice(((255, 1, 4), (255, 1, 11220), (255, 253, 11220), (3, 1, 4), (40, 1, 1000)))

    def operation(self, axis: int) -> Instruction:
        """Return an operation: short moves, small rates, in some cases too few or too many data bytes."""
        rng = self.rng
        code = rng.choice(OPERATIONS) | rng.getrandbits(1) << 3 | (rng.random() < 0.3) << 4 | (axis - 1) << 5
        d = rng.choice(COUNTS) - 1
        if rng.random() < 0.02:
            d = rng.choice((1 << 24, 1 << 16, 257)) - 1
        quick = (
            (0x11, 0x12, 0x13, 0x14, 0x22, 0x23, 0x25, 0x30)
            if self.datasheet
            else (1, 1, 2, 3, 4, 7, 9, 15, 30)
        )
        rate = rng.choice((*quick, 0 if rng.random() < 0.3 else quick[1]))
        count = [d & 0xFF, d >> 8 & 0xFF, d >> 16]
        data = {3: count, 4: [rate, *count], 5: [rate], 7: [rate]}.get(code & 7, [])
        if rng.random() < 0.04:
            data = data[:-1] if rng.random() < 0.5 else [*data, rng.getrandbits(8)]
        return code, data
