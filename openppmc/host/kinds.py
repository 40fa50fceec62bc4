"""What the numbers of each part allow, for drivers and for plans that need no board. Pure."""

from __future__ import annotations

from dataclasses import dataclass

from . import units
from .errors import OutOfRange, WrongDevice

AXIS_BIT = 0x20
"""Bit of a command code that names axis 2."""


@dataclass(frozen=True)
class Kind:
    """One part. number: as IDENT tells it. axes: how many. least_rate: with an internal base clock.
    rate_gap: by how much the start rate is above the high rate at least. logic_bit: the host chooses the
    level that switches coils on, and may have long intervals (vsel); otherwise coils are on with low."""

    number: int
    axes: int
    least_rate: int
    rate_gap: int
    logic_bit: bool

    def __str__(self) -> str:
        return f"PPMC-{self.number}"

    def check_axis(self, axis: int) -> int:
        """The number itself if there is such an axis; OutOfRange otherwise."""
        if not 1 <= axis <= self.axes:
            there = "one axis" if self.axes == 1 else f"axes 1 to {self.axes}"
            raise OutOfRange(f"axis {axis}: a {self} has {there}")
        return axis

    def internal(self, xtal_hz: int, csel: int = 1, vsel: int = 1) -> units.BaseClock:
        """An internal base clock."""
        return units.BaseClock.internal(xtal_hz, csel, vsel, self.least_rate)

    def any_clock(self, xtal_hz: int, pps: units.Number, vsel: int = 1, first: int = 1) -> units.BaseClock:
        """The internal base clock that reaches the speed, csel = first preferred. Raises OutOfRange."""
        return units.any_clock(xtal_hz, pps, vsel, first, self.least_rate)

    def plan(
        self,
        xtal_hz: int,
        start_pps: units.Number = 1000,
        high_pps: units.Number = 5000,
        ramp_pulses: int = 200,
        phases: int = 4,
        half_step: bool = False,
        positive_logic: bool | None = None,
        chop: bool = False,
        base_clock: units.Number | None = None,
        external_clock: units.Number | None = None,
        long_intervals: bool = False,
        axis: int = 1,
    ) -> units.Setup:
        """Rates and command of an initialisation; arguments as those of the drivers' `initialise`.

        positive_logic None: what the part has, or positive where it has both. Raises OutOfRange.
        """
        if external_clock is not None:
            clock = units.BaseClock.external_pin(external_clock)
        else:
            vsel = int(not long_intervals)
            clock = units.choose_clock(xtal_hz, start_pps, base_clock, vsel, self.least_rate)
        bits = units.motor_bits(phases, half_step)
        if self.logic_bit:
            code = bits | (positive_logic is not False) << 3 | clock.external << 4 | chop << 5
        elif positive_logic or long_intervals:
            what = "positive logic" if positive_logic else "long intervals"
            raise OutOfRange(f"{what}: a {self} does not have that (coils are on with a low level, no VSEL)")
        else:
            code = bits | clock.external << 3 | chop << 4 | (self.check_axis(axis) - 1) * AXIS_BIT
        return units.plan_setup(clock, start_pps, high_pps, ramp_pulses, code, self.rate_gap)


PPMC104 = Kind(104, axes=1, least_rate=0, rate_gap=0, logic_bit=True)
PPMC2104 = Kind(2104, axes=2, least_rate=1, rate_gap=2, logic_bit=False)
KINDS = {kind.number: kind for kind in (PPMC104, PPMC2104)}


def kind_of(number: int, where: str = "") -> Kind:
    """The part with this number; WrongDevice if there is no driver for it."""
    try:
        return KINDS[number]
    except KeyError:
        known = " and ".join(map(str, KINDS.values()))
        raise WrongDevice(
            f"{where}: the part is a PPMC-{number}; there are drivers for {known}: renew the package"
        ) from None
