"""A limit and an alarm seen on one edge: no pulse more, both bits, whatever runs and wherever on its ramp."""

from __future__ import annotations

from collections.abc import Sequence

from .drive import Drive
from .figures import NO_PULSES_DONE

BOTH = 0xB0
"""Finish status without the operation's code."""
MOVES = (
    (0x43, 24, None, (2, 10, 22)),
    (0x44, 24, 9, (6,)),
    (0x45, None, 9, (6,)),
    (0x46, None, None, (2, 10)),
    (0x47, None, 9, (6,)),
)
"""Operation, its pulses and rate, pulses made when both come: up, top and down of a ramp of 4 steps."""


async def two_causes(axis: Drive, rule: str, pins: Sequence[str]) -> None:
    """All operations CW; `pins`: limit and alarm, both active low, as the bench names them."""
    for code, n, rate, places in MOVES:
        for made in places:
            await axis.go(code, n, rate)
            await axis.pulse(made, 100)
            axis.bench.set(**dict.fromkeys(pins, 0))
            await axis.idle()
            axis.bench.set(**dict.fromkeys(pins, 1))
            what = f"{rule}: {code:#x} behind pulse {made}"
            await axis.result(what, made, BOTH | code & 7, (n or NO_PULSES_DONE) - made - 1)
