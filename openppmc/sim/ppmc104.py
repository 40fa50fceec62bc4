"""Machine model of a PPMC-104: only the features that all devices have."""

from __future__ import annotations

from ..model.ppmc104 import Carrier
from .common.machine import MachineKind, Setup


def _carrier(setup: Setup) -> Carrier:
    return Carrier(setup.plants[0], setup.clk_hz, setup.xtal_hz, setup.timing, setup.on_interrupt)


MACHINE = MachineKind("a ppmc104", _carrier)
