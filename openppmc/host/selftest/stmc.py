"""Self-test of a board with an STMC (`host.selftest`).

A host cannot set any output of the part directly. Therefore, the wires for the sections about switches
connect a phase output and HOLD to the switch inputs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ...model.stmc.codes import READ_MAPS, decode
from ...model.stmc.pins import INPUTS, OUTPUTS, WIDTHS
from ..script import Identity, Script
from .bytes import CCW, CONSTANT, CONTINUOUS, LONGEST_MOVE_S, ORIGIN, RAMP, ByteBus, Rates
from .plan import MOVES, SWITCHES, PartAccess, Section, Wire, recorded, timed

INSIDE = 0xFE
"""Strap levels that stop the step clock of the board. Its edges would fill the recorder."""
OUTSIDE = 0xFF
EXTERNAL = 0x1A
LAYOUT = recorded(INPUTS, OUTPUTS, WIDTHS)
# Divisors of the 12 500 Hz step clock.
BUS = ByteBus(decode, Rates(start=12, high=4, ramp=(10, 0), slow=6))


class PlanStmc:
    """Plan of an STMC; see `plan.Plan`."""

    part = "stmc"
    jumpers = (Wire("hold", "l1_n", "limit CW"), Wire("s[1]", "cnp_n", "origin"))

    def layout(self, width: int) -> tuple[tuple[str, int], ...]:
        return LAYOUT

    def params(self, identity: Identity, width: int, reset: Mapping[str, int]) -> list[dict[str, Any]]:
        known = {**timed(identity), "PHASE_IDLE": int(bool(reset["s"]))}
        return [{**known, "READ_MAP": name} for name in READ_MAPS]

    def sections(self, identity: Identity, width: int, records: int) -> list[Section]:
        found = [BUS.registers(), *BUS.codes(identity, records), *BUS.moves(pulse_only=False)]

        def by_board(access: PartAccess) -> None:
            # Each cycle of the step clock causes two records, so the clock runs only during the motion.
            BUS.initialise(access, EXTERNAL)
            BUS.command(access, CONSTANT, 20, 3, 0, 0)
            access.run(Script().straps(OUTSIDE))
            access.until_interrupt(LONGEST_MOVE_S)
            access.run(Script().straps(INSIDE))
            BUS.read_finish(access)

        return [
            *(replace(section, straps=INSIDE) for section in found),
            Section("steps by the clock of the board", MOVES, by_board, INSIDE),
        ]

    def switches(self, identity: Identity, width: int) -> list[Section]:
        def limit(access: PartAccess) -> None:
            BUS.initialise(access)
            BUS.go(CONTINUOUS, 20)(access)
            BUS.go(RAMP | CCW, 9, 0, 0)(access)

        origin = BUS.motion(BUS.go(ORIGIN, 20))
        return [
            Section("limit CW by HOLD", SWITCHES, limit, INSIDE),
            Section("origin by S1", SWITCHES, origin, INSIDE),
        ]


PLAN = PlanStmc()
