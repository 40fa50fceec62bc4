"""Ports for tests of the PPMC-312's line: plans of spoiled frames, and a bus on such a port."""

from __future__ import annotations

from collections.abc import Callable

from openppmc.host import Ppmc312Bus
from tests.common.host.line_ports import Spoiled

BAUD = 38_400


def once(code: int, fate: str, times: int = 1) -> Callable[[bytes], str | None]:
    """Return a plan in which the first `times` frames with this serial code have that fault."""
    left = times

    def plan(frame: bytes) -> str | None:
        nonlocal left
        if left and frame[1:3] == f"{code:02x}".encode():
            left -= 1
            return fate
        return None

    return plan


def spoiled(text: str = "stations=2") -> tuple[Spoiled, Ppmc312Bus]:
    """Return such a port, and a bus on it."""
    port = Spoiled("speed=max," + text, BAUD, "ppmc312-serial")
    return port, Ppmc312Bus.open(port, BAUD)
