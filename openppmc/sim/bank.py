"""Machine model of a bank.

The plants of all axes are equal, unless the text of the board contains words (`cw3=20000`) for single axes.
"""

from __future__ import annotations

from ..model.bank.carrier import Carrier
from ..model.clock import Timebase
from .common.machine import MachineKind, Setup


def _check(setup: Setup) -> None:
    if setup.timing != "FAST":
        raise ValueError(f"timing={setup.timing}: a bank is always FAST")
    if 4 * setup.clk_hz % setup.xtal_hz:
        raise ValueError(f"clk={setup.clk_hz}: 4 * clk must be a multiple of xtal={setup.xtal_hz} in a bank")
    axes = len(setup.plants)
    if Timebase(setup.clk_hz, setup.xtal_hz).cyc(16) < axes:
        least = -(-axes * setup.xtal_hz // 16)
        raise ValueError(f"clk={setup.clk_hz}: {axes} axes at xtal={setup.xtal_hz} need clk={least} at least")


def _carrier(setup: Setup) -> Carrier:
    return Carrier(setup.plants, setup.clk_hz, setup.xtal_hz, setup.on_interrupt)


MACHINE = MachineKind(
    "a bank",
    _carrier,
    own={"axes": ("8", "4", "16", "32", "64")},
    check=_check,
    timed=False,
    counters=False,
)
