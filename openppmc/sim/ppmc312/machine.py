"""Machine model of a PPMC-312: the motor has an encoder.

A cam between the limits activates the origin switch, because the zero return of the PPMC-312 requires an
origin at a distance from the limits.
"""

from __future__ import annotations

from ...model.carrier.carrier import Plant
from ...model.ppmc312.carrier import Carrier
from ..common.machine import MachineKind, Setup


def _carrier(setup: Setup) -> Carrier:
    return Carrier(setup.plants[0], setup.clk_hz, setup.xtal_hz, setup.timing, setup.on_interrupt)


MACHINE = MachineKind(
    "a ppmc312",
    _carrier,
    plant=Plant(ccw=-4000, slow_ccw=-3000, origin_from=-50, index=400),
    encoder=True,
)
