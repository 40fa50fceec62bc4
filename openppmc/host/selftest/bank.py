"""Self-test of a board with a bank: all functions of axis 1, then several axes together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...model.single.codes import decode
from ..bank.registers import CONFIG, GO, INFO, MASK, PENDING, POSITION, POSITION_BYTES, SELECT, STOP
from ..script import Identity, Script
from .bytes import CCW, CONSTANT, CONTINUOUS, ORIGIN, RAMP, ByteBus
from .plan import MOVES, REGISTERS, SWITCHES, PartAccess, Section, Wire

ONCE, AN_AXIS = 32, 14
"""Number of pin levels in a record: once for the bus and the shared pins, and for each axis."""
SHOWN = 3
"""Largest number of axes that are started together. With more axes, the recorder would have to be large."""


def axis(number: int) -> ByteBus:
    """Return the byte bus of axis `number`, from 0."""
    return ByteBus(decode, before=Script().write(SELECT, number))


FIRST = axis(0)


def _axes(width: int) -> int:
    return (width - ONCE) // AN_AXIS


class PlanBank:
    """Plan of a bank; see `plan.Plan`."""

    part = "bank"
    jumpers = (
        Wire("dir[1]", "l2_n[0]", "limit CCW of axis 1"),
        Wire("dir[2]", "cnp_n[0]", "origin of axis 1"),
    )

    def layout(self, width: int) -> tuple[tuple[str, int], ...]:
        axes = _axes(width)
        switches = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n")
        return (
            *(("rst_n", 1), ("a", 10), ("cs_n", 1), ("rd_n", 1), ("wr_n", 1), ("d_i", 8)),
            *((name, axes) for name in switches),
            *(("d_o", 8), ("d_oe", 1), ("int_n", 1)),
            *(("pout_n", axes), ("dir", axes), ("hold", axes), ("s", 5 * axes)),
        )

    def params(self, identity: Identity, width: int, reset: Mapping[str, int]) -> list[dict[str, Any]]:
        idle = int(bool(reset["s"]))
        known = {"CLK_HZ": identity.clk_hz, "XTAL_HZ": identity.xtal_hz, "PHASE_IDLE": idle}
        return [{"AXES": _axes(width), **known}]

    def sections(self, identity: Identity, width: int, records: int) -> list[Section]:
        axes = _axes(width)

        def window(access: PartAccess) -> None:
            for number in range(axes):
                access.run(Script().write(SELECT, number))
                for register in (CONFIG, MASK, PENDING, INFO, *range(POSITION, POSITION + POSITION_BYTES)):
                    access.read(register)

        def move_together(access: PartAccess) -> None:
            some = [axis(number) for number in range(min(SHOWN, axes))]
            for bus in some:
                bus.initialise(access)
            access.write(MASK, [(1 << len(some)) - 1])
            for number, bus in enumerate(some):
                bus.command(access, RAMP | CCW * (number & 1), 9 + 3 * number, 0, 0)
            access.pause(0.003)
            access.write(GO, [(1 << len(some)) - 1])
            for bus in some:
                bus.read_end(access)

        def stopped(access: PartAccess) -> None:
            some = [axis(number) for number in range(min(SHOWN, axes))]
            for bus in some:
                bus.initialise(access)
                bus.command(access, CONTINUOUS, 199)
            access.write(STOP, [(1 << len(some)) - 1])
            for bus in some:
                bus.read_end(access)

        return [
            FIRST.registers(),
            Section("registers of the window", REGISTERS, window),
            *FIRST.codes(identity, records),
            *FIRST.moves(),
            Section("group started in the same cycle", MOVES, move_together),
            Section("all stopped in the same cycle", MOVES, stopped),
        ]

    def switches(self, identity: Identity, width: int) -> list[Section]:
        def by_axis(number: int, code: int) -> Any:
            def play(access: PartAccess) -> None:
                other = axis(number)
                for bus in (FIRST, other):
                    bus.initialise(access)
                other.go(CONSTANT | CCW, 199, 0, 0, 0)(access)
                FIRST.command(access, code, 199)
                access.pause(0.005)
                other.go(CONSTANT, 199, 0, 0, 0)(access)
                FIRST.read_end(access)

            return play

        return [
            Section("limit CCW by axis 2", SWITCHES, by_axis(1, CONTINUOUS | CCW)),
            Section("origin by axis 3", SWITCHES, by_axis(2, ORIGIN | CCW)),
        ]


PLAN = PlanBank()
