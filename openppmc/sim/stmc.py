"""Machine model of an STMC; the word `read_map` selects the read codes of the device.

The reference point is between the deceleration limits of a J105 STMC. A search for the reference point also
ends at each of these limits.
"""

from __future__ import annotations

from ..model.carrier.carrier import Plant
from ..model.stmc.carrier import Carrier
from ..model.stmc.codes import READ_MAPS
from ..model.stmc.part import Stmc
from .common.machine import MachineKind, Setup


def _carrier(setup: Setup) -> Carrier:
    one = setup.plants[0]
    return Carrier(one, setup.clk_hz, setup.xtal_hz, setup.timing, setup.on_interrupt, setup.own["read_map"])


MACHINE = MachineKind(
    "an stmc",
    _carrier,
    plant=Plant(ccw=-1000, slow_ccw=-200),
    own={"read_map": tuple(READ_MAPS)},
    xtal_max=Stmc.XTAL_MAX,
    alarm="MON low",
)
