"""Machine model of a PPMC-104; the word `bridge=0` selects the character host (docs/char_host.md)."""

from __future__ import annotations

from ..model.ppmc104 import Carrier
from .common.machine import MachineKind, Setup


def _carrier(setup: Setup) -> Carrier:
    if setup.own["bridge"] == "0":
        raise ValueError("bridge=0: model: has no character host; use char:sim:bridge=0")
    return Carrier(setup.plants[0], setup.clk_hz, setup.xtal_hz, setup.timing, setup.on_interrupt)


MACHINE = MachineKind("a ppmc104", _carrier, own={"bridge": ("1", "0")})
