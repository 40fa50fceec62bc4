"""Self-test of a board with a PPMC-2104: each axis alone, then both axes, started by one edge of RUN."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...model.ppmc2104.codes import CMND, INPUTS, OUTPUTS, WIDTHS, decode
from ..script import Identity, Script
from .bytes import AXIS_2, CCW, CONSTANT, CONTINUOUS, DATA, ORIGIN, RAMP, ByteBus
from .plan import MOVES, REGISTERS, SWITCHES, PartAccess, Section, Wire, recorded, timed

BOTH_HIGH, FIRST_LOW, SECOND_LOW = 0xC1, 0xD1, 0xE1
"""Codes that set the auxiliary outputs: both high, or one of them low."""
RUN_LOW, SLOW_CLOCK = 0xF3, 0xFC
LAYOUT = recorded(INPUTS, OUTPUTS, WIDTHS)
BUILDING = sum(CMND)
FIRST, SECOND = (
    ByteBus(decode, axis=axis, building=BUILDING, positive=0, chopped=0x10) for axis in (0, AXIS_2)
)


class Plan2104:
    """Plan of a PPMC-2104; see `plan.Plan`."""

    part = "ppmc2104"
    jumpers = (
        Wire("auxo[0]", "fl_n[1]", "limit CW of axis 1"),
        Wire("auxo[1]", "org_n[1]", "origin of axis 1"),
    )

    def layout(self, width: int) -> tuple[tuple[str, int], ...]:
        return LAYOUT

    def params(self, identity: Identity, width: int, reset: Mapping[str, int]) -> list[dict[str, Any]]:
        return [timed(identity)]

    def sections(self, identity: Identity, width: int, records: int) -> list[Section]:
        def errors(access: PartAccess) -> None:
            for bus in (FIRST, SECOND):
                bus.command(access, 0x43 | bus.axis)  # rejected: the axis is not initialised yet
                bus.command(access, 0x86 | bus.axis)
                access.read(DATA)

        def move_together(access: PartAccess) -> None:
            for bus in (FIRST, SECOND):
                bus.initialise(access)
            FIRST.command(access, RAMP, 29, 0, 0)
            SECOND.command(access, CONSTANT | CCW | AXIS_2, 120, 9, 0, 0)
            access.pause(0.003)
            access.run(Script().straps(0xFF))
            for bus in (FIRST, SECOND):
                bus.read_end(access)

        slow = FIRST.motion(FIRST.go(CONSTANT, 49, 5, 0, 0))
        return [
            FIRST.registers(),
            Section("error registers", REGISTERS, errors),
            *FIRST.codes(identity, records, [SECOND]),
            *FIRST.moves(),
            *(Section(f"axis 2: {one.title}", one.what, one.play) for one in SECOND.moves()),
            Section("both axes from one edge of RUN on", MOVES, move_together, RUN_LOW),
            Section("slow base clock", MOVES, slow, SLOW_CLOCK),
        ]

    def switches(self, identity: Identity, width: int) -> list[Section]:
        def play_of(code: int, low: int) -> Any:
            def play(access: PartAccess) -> None:
                FIRST.initialise(access)
                FIRST.command(access, BOTH_HIGH)
                FIRST.command(access, code, 199)
                access.pause(0.005)
                FIRST.command(access, low)
                FIRST.read_end(access)
                FIRST.go(RAMP, 9, 0, 0)(access)

            return play

        return [
            Section("limit CW by AUXO1", SWITCHES, play_of(CONTINUOUS, FIRST_LOW)),
            Section("origin by AUXO2", SWITCHES, play_of(ORIGIN, SECOND_LOW)),
        ]


PLAN = Plan2104()
