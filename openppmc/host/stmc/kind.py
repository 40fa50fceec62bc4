"""What an STMC on the J105 board allows. Pure."""

from __future__ import annotations

from fractions import Fraction

from ...model.stmc.codes import BOARD_CLOCK_HZ, TICK_XT
from ...parts import part
from ..axis.kind import RateKind
from ..basis import units
from ..basis.errors import OutOfRange
from ..basis.kind import POSITIVE, Kind, Wanted
from .clock import divided

BOARD_CLOCK = BOARD_CLOCK_HZ
"""Second step clock of the J105 board: 48 675 Hz."""


class StmcKind(RateKind):
    """Speeds are a step clock over a divisor, and the clock is chosen by the initialisation."""

    def constant_clock(
        self, xtal_hz: int, ramp: units.BaseClock | None, pps: units.Number
    ) -> units.BaseClock:
        return Kind.constant_clock(self, xtal_hz, ramp, pps)

    def ramp_clock(self, xtal_hz: int, wanted: Wanted) -> units.BaseClock:
        if wanted.external_clock is not None:
            return divided(wanted.external_clock)
        internal = divided(Fraction(xtal_hz, TICK_XT), external=False)
        board = divided(BOARD_CLOCK)
        if wanted.base_clock is None:
            return board if board.slowest <= units.exact(wanted.start_pps, "start speed") else internal
        for clock in (internal, board):
            if clock.hertz == units.exact(wanted.base_clock, "base clock"):
                return clock
        raise OutOfRange(
            f"base clock {units.nearby(wanted.base_clock)} Hz: this board has {units.nearby(internal.hertz)} "
            f"and {BOARD_CLOCK} Hz"
        )


KIND = StmcKind(
    part("stmc"),
    has=frozenset((POSITIVE,)),
    outputs=0,
    lengths=(0, 65_535),
    alarm=("MON input", "switch the motor on (MON high)"),
    origin_between=True,
)
