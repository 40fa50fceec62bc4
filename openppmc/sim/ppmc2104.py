"""Machine model of a PPMC-2104: two axes."""

from __future__ import annotations

from ..model.ppmc2104.carrier import Carrier
from .common.machine import MachineKind, Setup


def _carrier(setup: Setup) -> Carrier:
    return Carrier(setup.plants, setup.clk_hz, setup.xtal_hz, setup.timing, setup.on_interrupt)


MACHINE = MachineKind("a ppmc2104", _carrier, axes=2)
