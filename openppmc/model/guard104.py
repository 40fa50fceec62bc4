"""What ends or slows which operation (P104-LIM-02..06 and the table of section 7)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .codes104 import FINISH_ALARM, FINISH_LIMIT, ORIGIN


class Seen(NamedTuple):
    """Causes active on an edge: `ends` the motion now, with these finish bits; `slow` limit is active."""

    ends: bool
    bits: int
    slow: bool


def inspect(levels: Mapping[str, int], operation: int, direction: int) -> Seen:
    """Judge the synchronised levels for an operation (low three code bits) and its direction."""
    hard, slow = ("l2_n", "l4_n") if direction else ("l1_n", "l3_n")
    bits = 0
    if not levels[hard]:
        bits |= FINISH_LIMIT
    if not levels["alm_n"]:
        bits |= FINISH_ALARM
    origin = operation == ORIGIN and not levels["cnp_n"]
    return Seen(bool(bits) or origin, bits, not levels[slow])


def input_register(levels: Mapping[str, int]) -> int:
    """Byte of read command 0x81 (P104-RD-05)."""
    order = ((7, "cnp_n"), (6, "alm_n"), (3, "l1_n"), (2, "l2_n"), (1, "l3_n"), (0, "l4_n"))
    return sum(levels[pin] << bit for bit, pin in order)
