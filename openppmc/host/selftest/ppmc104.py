"""Self-test of a board with a PPMC-104 (`host.selftest`)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...model.ppmc104 import INPUTS, OUTPUTS, WIDTHS
from ...model.single.codes import decode
from ..script import Identity
from .bytes import CCW, CONSTANT, CONTINUOUS, ORIGIN, RAMP, ByteBus
from .plan import MOVES, SWITCHES, PartAccess, Section, Wire, recorded, timed

AUX_ON, AUX_OFF, AUX_OUTPUT = 0xC1, 0xC2, 0x86
SLOW_CLOCK, LONG_INTERVALS = 0xFE, 0xFD
"""Strap levels with csel low, and strap levels with vsel low."""
LAYOUT = recorded(INPUTS, OUTPUTS, WIDTHS)
BUS = ByteBus(decode)


class Plan104:
    """Plan of a PPMC-104; see `plan.Plan`."""

    part = "ppmc104"
    jumpers = (Wire("aux_n", "l1_n", "limit CW"), Wire("auxo[0]", "cnp_n", "origin"))

    def layout(self, width: int) -> tuple[tuple[str, int], ...]:
        return LAYOUT

    def params(self, identity: Identity, width: int, reset: Mapping[str, int]) -> list[dict[str, Any]]:
        return [{**timed(identity), "PHASE_IDLE": int(bool(reset["s"]))}]

    def sections(self, identity: Identity, width: int, records: int) -> list[Section]:
        constant = BUS.motion(BUS.go(CONSTANT, 49, 5, 0, 0))
        return [
            BUS.registers(),
            *BUS.codes(identity, records),
            *BUS.moves(),
            Section("slow base clock", MOVES, constant, SLOW_CLOCK),
            Section("long intervals", MOVES, constant, LONG_INTERVALS),
        ]

    def switches(self, identity: Identity, width: int) -> list[Section]:
        def limit(access: PartAccess) -> None:
            BUS.initialise(access)
            BUS.command(access, AUX_OFF)
            BUS.command(access, CONTINUOUS, 199)
            access.pause(0.005)
            BUS.command(access, AUX_ON)
            BUS.read_end(access)
            BUS.go(RAMP, 9, 0, 0)(access)  # towards the active limit, so the move outputs no pulse
            BUS.go(RAMP | CCW, 9, 0, 0)(access)

        def origin(access: PartAccess) -> None:
            BUS.initialise(access)
            BUS.command(access, AUX_OUTPUT, 0)
            BUS.command(access, ORIGIN, 199)
            access.pause(0.005)
            BUS.command(access, AUX_OUTPUT, 1)
            BUS.read_end(access)

        return [Section("limit CW by AUX*", SWITCHES, limit), Section("origin by AUXO0", SWITCHES, origin)]


PLAN = Plan104()
