"""The moves of the bank's demo: 32 axes, each with a different ramp."""

from __future__ import annotations

from dataclasses import dataclass

from openppmc.model.clock import Timebase
from openppmc.model.single.predict import Move, predict_move

AXES, CLK_HZ = 32, 32_000_000
"""Lowest clock frequency that supports 32 axes with a 16 MHz crystal (BANK-GEN-02)."""
BASE = 500_000  # Hz, base clock with csel = 1
INIT = 0x0A  # 4-phase motor, full step, a high level switches a coil on
RAMPED, CCW = 0x43, 0x08


@dataclass(frozen=True)
class Order:
    """An initialisation of one axis, and a move with acceleration and deceleration."""

    axis: int
    rl: int
    rh: int
    pa: int
    pulses: int

    @property
    def ramp(self) -> bytes:
        """The parameters of the initialisation."""
        return bytes((self.rl, self.rh, self.pa & 0xFF, self.pa >> 8))

    @property
    def code(self) -> int:
        """The code of the command; odd axes move CCW."""
        return RAMPED | (CCW if self.axis & 1 else 0)

    @property
    def distance(self) -> bytes:
        """The parameters of the command."""
        return (self.pulses - 1).to_bytes(3, "little")

    @property
    def signed(self) -> int:
        """The position after the move, if it begins at 0."""
        return -self.pulses if self.axis & 1 else self.pulses

    def predicted(self) -> Move:
        """Return the move that the golden model of a single PPMC-104 predicts."""
        return predict_move(self.ramp, self.pulses, timebase=Timebase(CLK_HZ, 16_000_000))


def order(axis: int) -> Order:
    """Return the move of an axis: top speed 25 to 9.8 kpps, ramps of 3 to 11 ms, plateaus of 0 to 18 ms."""
    rh = 19 + axis
    rl = 2 * rh + 40
    low, high = BASE / (rl + 1), BASE / (rh + 1)
    ramp, plateau = 3e-3 + 1.2e-3 * (5 * axis % 8), 3e-3 * (3 * axis % 7)
    pa = round(ramp * (low + high) / 2)
    return Order(axis, rl, rh, pa, 2 * pa + 2 + round(plateau * high))


ORDERS = tuple(order(axis) for axis in range(AXES))
