"""Ports for tests of the PPMC-312's line: plans of damaged frames, and a bus on a port that damages
frames.
"""

from __future__ import annotations

from collections.abc import Callable

from openppmc.host import Ppmc312Bus
from tests.common.host.line_ports import Spoiled

BAUD = 38_400


def once(code: int, fate: str, times: int = 1) -> Callable[[bytes], str | None]:
    """Return a plan in which the first `times` frames with this serial code have the fault `fate`."""
    left = times

    def plan(frame: bytes) -> str | None:
        nonlocal left
        if left and frame[1:3] == f"{code:02x}".encode():
            left -= 1
            return fate
        return None

    return plan


def spoiled(text: str = "stations=2") -> tuple[Spoiled, Ppmc312Bus]:
    """Return a port that damages frames, and the driver of the bus on it."""
    port = Spoiled("speed=max," + text, BAUD, "ppmc312-serial")
    return port, Ppmc312Bus.open(port, BAUD)
