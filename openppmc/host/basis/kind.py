"""What the numbers of each part allow, for drivers and for plans that need no board. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TypeAlias

from ...model.motion.codes import PA_MAX, PA_MIN
from ...model.stmc.codes import BOARD_CLOCK_HZ, TICK_XT
from ..ppmc312 import free, profile
from ..ppmc312.line.ascii import STATIONS, station_number
from . import units
from .ending import ALARM_INPUT
from .errors import OutOfRange, WrongDevice

AnySetup: TypeAlias = units.Setup | profile.Setup312
AXIS_BIT = 0x20
"""Bit of a command code that names axis 2."""
BOARD_CLOCK = BOARD_CLOCK_HZ
"""Second step clock of the J105 board: 48 675 Hz."""
POSITIVE = "positive logic"
LONG = "long intervals"
PULSE_ONLY = "pulse only"
COILS_OFF = "excitation off"
FREE_CURVES = "free curves"
AUX = "output AUX"
PHASES = "phase outputs"
OWN_STOP = "a deceleration of its own"
CURVES = "ramps of other shapes"
"""What not all parts have."""


@dataclass(frozen=True)
class Kind:
    """One part. number: as IDENT tells it. word: as users type it; name: as it is printed. axes: how many.
    has: of the words above. outputs: highest value of the auxiliary outputs. lengths: shortest and longest
    ramp in pulses. least_rate: with an internal base clock. rate_gap: by how much the start rate is above the
    high rate at least. alarm: what its alarm input is called, and what to do about it. origin_between: the
    origin lies between the slow-down limits, and a search ends at them."""

    number: int
    word: str
    name: str
    axes: int = 1
    has: frozenset[str] = frozenset()
    outputs: int = 15
    lengths: tuple[int, int] = (PA_MIN, PA_MAX)
    least_rate: int = 0
    rate_gap: int = 0
    alarm: tuple[str, str] = ALARM_INPUT
    origin_between: bool = False
    usual_ramp: int = 200

    def __str__(self) -> str:
        return self.name

    def check_axis(self, axis: int) -> int:
        """The number itself if there is such an axis; OutOfRange otherwise."""
        if not 1 <= axis <= self.axes:
            there = "one axis" if self.axes == 1 else f"axes 1 to {self.axes}"
            raise OutOfRange(f"axis {axis}: a {self} has {there}")
        return axis

    def need(self, what: str) -> None:
        """OutOfRange if the part lacks one of the things in `has`."""
        if what not in self.has:
            raise OutOfRange(f"{what}: a {self} does not have that")

    # ------------------------------------------------------------------ speeds

    def any_clock(self, xtal_hz: int, pps: units.Number, vsel: int = 1, first: int = 1) -> units.BaseClock:
        """The internal base clock that reaches the speed, csel = first preferred. Raises OutOfRange."""
        return units.any_clock(xtal_hz, pps, vsel, first, self.least_rate)

    def constant_clock(
        self, xtal_hz: int, ramp: units.BaseClock | None, pps: units.Number
    ) -> units.BaseClock:
        """The base clock of a constant speed, after that of the ramp (None: nobody knows it). Raises
        OutOfRange for a speed that no clock reaches."""
        if ramp is None:
            return self.any_clock(xtal_hz, pps)
        return ramp if ramp.external else self.any_clock(xtal_hz, pps, ramp.vsel, ramp.csel)

    def ramp_clock(
        self,
        xtal_hz: int,
        start_pps: units.Number,
        base_clock: units.Number | None,
        external_clock: units.Number | None,
        vsel: int = 1,
    ) -> units.BaseClock:
        """The base clock of an initialisation; arguments as those of the drivers' `initialise`."""
        if external_clock is not None:
            return units.BaseClock.external_pin(external_clock)
        return units.choose_clock(xtal_hz, start_pps, base_clock, vsel, self.least_rate)

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
        stop_pps: units.Number | None = None,
        down_pulses: int | None = None,
        sigmoid: bool = False,
        curve: str | None = None,
    ) -> AnySetup:
        """Rates and command of an initialisation; arguments as those of the drivers' `initialise`.

        positive_logic None: what the part has, or positive where it has both. curve: a file, see
        `free.read_stages`. Raises OutOfRange.
        """
        own_stop = stop_pps is not None or down_pulses is not None
        shaped = sigmoid or curve is not None
        for wanted, what in (
            (positive_logic, POSITIVE),
            (long_intervals, LONG),
            (own_stop, OWN_STOP),
            (shaped, CURVES),
        ):
            if wanted:
                self.need(what)
        clock = self.ramp_clock(xtal_hz, start_pps, base_clock, external_clock, int(not long_intervals))
        bits = units.motor_bits(phases, half_step)
        if POSITIVE in self.has:
            code = bits | (positive_logic is not False) << 3 | clock.external << 4 | chop << 5
        else:
            code = bits | clock.external << 3 | chop << 4 | (self.check_axis(axis) - 1) * AXIS_BIT
        return units.plan_setup(clock, start_pps, high_pps, ramp_pulses, code, self.rate_gap, self.lengths)


class Kind312(Kind):
    """The PPMC-312: speeds are a base clock over a 16-bit rate, and the clock is part of the table. It has
    neither phases nor straps that choose anything."""

    def constant_clock(
        self, xtal_hz: int, ramp: units.BaseClock | None, pps: units.Number
    ) -> units.BaseClock:
        if ramp is None:
            raise OutOfRange("a speed needs a base clock, which an initialisation chooses: initialise first")
        ramp.choose(pps)
        return ramp

    def plan(
        self,
        xtal_hz: int,
        start_pps: units.Number = 1000,
        high_pps: units.Number = 5000,
        ramp_pulses: int = 2000,
        phases: int = 4,
        half_step: bool = False,
        positive_logic: bool | None = None,
        chop: bool = False,
        base_clock: units.Number | None = None,
        external_clock: units.Number | None = None,
        long_intervals: bool = False,
        axis: int = 1,
        stop_pps: units.Number | None = None,
        down_pulses: int | None = None,
        sigmoid: bool = False,
        curve: str | None = None,
    ) -> AnySetup:
        self.check_axis(axis)
        for wanted, what in (
            (half_step or phases != 4 or chop or positive_logic, PHASES),
            (long_intervals, LONG),
            (stop_pps is not None or down_pulses is not None, OWN_STOP),
            (curve is not None, FREE_CURVES),
        ):
            if wanted:
                self.need(what)
        if curve is not None:
            if sigmoid or stop_pps is not None or down_pulses is not None:
                raise OutOfRange("a free curve has its own speeds and pulses: give either it or those")
            return free.plan_file(xtal_hz, Path(curve), base_clock, external_clock)
        slowest = start_pps if stop_pps is None else min(start_pps, stop_pps)
        clock = profile.choose_clock(xtal_hz, slowest, base_clock, external_clock)
        return profile.plan_setup(clock, start_pps, high_pps, ramp_pulses, stop_pps, down_pulses, sigmoid)


class Kind312Line(Kind312):
    """Stations of a line: their numbers begin with 0."""

    def check_axis(self, axis: int) -> int:
        return station_number(axis)


class KindStmc(Kind):
    """The STMC: speeds are a step clock over a divisor, and the clock is chosen by the initialisation."""

    def constant_clock(
        self, xtal_hz: int, ramp: units.BaseClock | None, pps: units.Number
    ) -> units.BaseClock:
        if ramp is None:
            raise OutOfRange("a speed needs a step clock, which an initialisation chooses: initialise first")
        ramp.choose(pps)
        return ramp

    def ramp_clock(
        self,
        xtal_hz: int,
        start_pps: units.Number,
        base_clock: units.Number | None,
        external_clock: units.Number | None,
        vsel: int = 1,
    ) -> units.BaseClock:
        if external_clock is not None:
            return units.BaseClock.divided(external_clock)
        internal = units.BaseClock.divided(Fraction(xtal_hz, TICK_XT), external=False)
        board = units.BaseClock.divided(BOARD_CLOCK)
        if base_clock is None:
            return board if board.slowest <= units.exact(start_pps, "start speed") else internal
        for clock in (internal, board):
            if clock.hertz == units.exact(base_clock, "base clock"):
                return clock
        raise OutOfRange(
            f"base clock {units.nearby(base_clock)} Hz: this board has {units.nearby(internal.hertz)} and "
            f"{BOARD_CLOCK} Hz"
        )


PPMC104 = Kind(104, "ppmc104", "PPMC-104", has=frozenset((POSITIVE, LONG, PULSE_ONLY, COILS_OFF, AUX)))
PPMC2104 = Kind(
    2104,
    "ppmc2104",
    "PPMC-2104",
    axes=2,
    has=frozenset((PULSE_ONLY, COILS_OFF)),
    outputs=3,
    least_rate=1,
    rate_gap=2,
)
STMC = KindStmc(
    105,
    "stmc",
    "J105 STMC",
    has=frozenset((POSITIVE,)),
    outputs=0,
    lengths=(0, 65_535),
    alarm=("MON input", "switch the motor on (MON high)"),
    origin_between=True,
)
PPMC312 = Kind312(
    312,
    "ppmc312",
    "PPMC-312",
    has=frozenset((COILS_OFF, OWN_STOP, CURVES, FREE_CURVES)),
    outputs=63,
    lengths=(1, 0xFFFFFF),
    alarm=("alarm input", "clear the drive's alarm, then the part's"),
    origin_between=True,
    usual_ramp=2000,
)
PPMC312_SERIAL = Kind312Line(
    312,
    "ppmc312-serial",
    "PPMC-312 in serial mode",
    axes=STATIONS,
    has=frozenset((COILS_OFF, CURVES)),
    outputs=PPMC312.outputs,
    lengths=PPMC312.lengths,
    alarm=PPMC312.alarm,
    origin_between=True,
    usual_ramp=PPMC312.usual_ramp,
)
PMC006 = Kind(6, "pmc006", "PMC006B4", outputs=31)
KINDS = {kind.number: kind for kind in (PPMC104, PPMC2104, STMC, PPMC312)}
BY_WORD = {kind.word: kind for kind in (*KINDS.values(), PPMC312_SERIAL, PMC006)}


def name_of(number: int) -> str:
    """Name of the part with this number, known or not."""
    return str(KINDS[number]) if number in KINDS else f"PPMC-{number}"


def kind_of(number: int, where: str = "") -> Kind:
    """The part with this number; WrongDevice if there is no driver for it."""
    try:
        return KINDS[number]
    except KeyError:
        *most, last = map(str, KINDS.values())
        raise WrongDevice(
            f"{where}: the part is a {name_of(number)}; there are drivers for {', '.join(most)} and {last}: "
            "renew the package"
        ) from None
