"""Sessions of the bank for the playground: moves of `make demo PART=bank` on its first axes."""

from __future__ import annotations

from collections.abc import Iterable

from openppmc.model.bank.window import GO, MASK
from scripts.demo.bank.moves import INIT, ORDERS, Order

AXES = 8


def _bytes(data: Iterable[int]) -> str:
    return " ".join(f"d {byte:02X}" for byte in data)


def _setup(orders: Iterable[Order]) -> list[str]:
    return [f"axis {one.axis}; c {INIT:02X} {_bytes(one.ramp)}" for one in orders]


def _moves(orders: Iterable[Order]) -> list[str]:
    return [f"axis {one.axis}; c {one.code:02X} {_bytes(one.distance)}" for one in orders]


def _ends(orders: Iterable[Order]) -> list[str]:
    lines = []
    for one in orders:
        place = " ".join(
            f"get {4 + n} {byte:02X}" for n, byte in enumerate(one.signed.to_bytes(4, "little", signed=True))
        )
        lines.append(f"axis {one.axis}; idle; c 80 r 83; {place}")
    return lines


_ALL, _ONE = ORDERS[:AXES], ORDERS[3:4]
_TOGETHER = [
    *_setup(_ALL),
    "# all axes wait for GO",
    f"axis 0; put {MASK} {(1 << AXES) - 1:02X}",
    *_moves(_ALL),
    "wait 1000",
    f"axis 0; put {GO} 00  # pulse 1 of all axes is at the same edge",
    *_ends(_ALL),
]
_LIMIT = ["c 45 d 31", "pulse 60 3", "set l1_n[3]=0", "idle", "c 80 r 95", "c 4D d 31", "pulse 20 3", "c 40"]
SESSIONS = {
    "One axis": "\n".join([*_setup(_ONE), *_moves(_ONE), *_ends(_ONE)]),
    "Eight axes from one GO": "\n".join(_TOGETHER),
    "Into a limit": "\n".join([*_setup(_ONE), *_LIMIT]),
}
