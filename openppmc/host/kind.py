"""What a part allows, for drivers and for plans that need no board: what all parts have in common. Pure.

Each part's own is `KIND` in its folder (`openppmc.parts`, column `kind`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, cast

from ..model.motion.codes import PA_MAX, PA_MIN
from ..parts import Row, by_number, part
from . import speeds as units
from .ending import ALARM_INPUT
from .errors import OutOfRange

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
class Wanted:
    """What an initialisation asks for; names and units as those of the drivers' `initialise`.

    ramp_pulses None: as usual for the part. positive_logic None: what the part has, or positive where it has
    both. axis: its number. curve: file of a free curve, as `ppmc312.free.read_stages` reads it.
    """

    start_pps: units.Number = 1000
    high_pps: units.Number = 5000
    ramp_pulses: int | None = None
    phases: int = 4
    half_step: bool = False
    positive_logic: bool | None = None
    chop: bool = False
    base_clock: units.Number | None = None
    external_clock: units.Number | None = None
    long_intervals: bool = False
    axis: int = 1
    stop_pps: units.Number | None = None
    down_pulses: int | None = None
    sigmoid: bool = False
    curve: str | None = None

    @property
    def own_stop(self) -> bool:
        """With a deceleration that is not the acceleration backwards."""
        return self.stop_pps is not None or self.down_pulses is not None


class AnySetup(Protocol):
    """What the plans of all parts tell. start, high: speeds as asked for and as reached. ramp_pulses: from
    one to the other. clock: base clock of the ramp."""

    @property
    def start(self) -> units.Speed: ...
    @property
    def high(self) -> units.Speed: ...
    @property
    def ramp_pulses(self) -> int: ...
    @property
    def clock(self) -> units.BaseClock: ...


@dataclass(frozen=True)
class Kind:
    """One part. row: in the table of parts. axes: how many. has: of the words above. outputs: highest value
    of the auxiliary outputs. alarm: what its alarm input is called, and what to do about it. origin_between:
    the origin lies between the slow-down limits, and a search ends at them. usual_ramp: in pulses."""

    row: Row
    axes: int = 1
    has: frozenset[str] = frozenset()
    outputs: int = 15
    alarm: tuple[str, str] = ALARM_INPUT
    origin_between: bool = False
    usual_ramp: int = 200

    def __str__(self) -> str:
        return self.row.title

    @property
    def number(self) -> int:
        """As IDENT of the bridge tells it, 0 for parts that are on no bridge."""
        return self.row.number

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

    def constant_clock(
        self, xtal_hz: int, ramp: units.BaseClock | None, pps: units.Number
    ) -> units.BaseClock:
        """The base clock of a constant speed, after that of the ramp (None: nobody knows it). Raises
        OutOfRange for a speed that no clock reaches. Here: the one that an initialisation has chosen."""
        if ramp is None:
            raise OutOfRange("a speed needs a base clock, which an initialisation chooses: initialise first")
        ramp.choose(pps)
        return ramp

    def plan(self, xtal_hz: int, wanted: Wanted) -> AnySetup:
        """The initialisation, with what it really reaches. Raises OutOfRange for what the part
        cannot do."""
        raise OutOfRange(f"plan: a {self} does not have that")


def kind_of(name: str) -> Kind:
    """The kind of the part of this name. UnknownPartError."""
    return cast(Kind, part(name).load("kind"))


def name_of(number: int) -> str:
    """Name of the part with this number, known or not."""
    row = by_number(number)
    return f"PPMC-{number}" if row is None else row.title


# What parts allow whose speeds are a rate byte over a base clock (P104-INT-01). Pure.

AXIS_BIT = 0x20
"""Bit of a command code that names axis 2."""


@dataclass(frozen=True)
class RateKind(Kind):
    """See `Kind`. lengths: shortest and longest ramp in pulses. least_rate: with an internal base clock.
    rate_gap: by how much the start rate is above the high rate at least."""

    lengths: tuple[int, int] = (PA_MIN, PA_MAX)
    least_rate: int = 0
    rate_gap: int = 0

    def constant_clock(
        self, xtal_hz: int, ramp: units.BaseClock | None, pps: units.Number
    ) -> units.BaseClock:
        if ramp is None:
            return units.any_clock(xtal_hz, pps, least_rate=self.least_rate)
        if ramp.external:
            return ramp
        return units.any_clock(xtal_hz, pps, ramp.vsel, ramp.csel, self.least_rate)

    def ramp_clock(self, xtal_hz: int, wanted: Wanted) -> units.BaseClock:
        """The base clock of an initialisation. OutOfRange."""
        if wanted.external_clock is not None:
            return units.BaseClock.external_pin(wanted.external_clock)
        vsel = int(not wanted.long_intervals)
        return units.choose_clock(xtal_hz, wanted.start_pps, wanted.base_clock, vsel, self.least_rate)

    def plan(self, xtal_hz: int, wanted: Wanted) -> units.Setup:
        for asked, what in (
            (wanted.positive_logic, POSITIVE),
            (wanted.long_intervals, LONG),
            (wanted.own_stop, OWN_STOP),
            (wanted.sigmoid or wanted.curve is not None, CURVES),
        ):
            if asked:
                self.need(what)
        clock = self.ramp_clock(xtal_hz, wanted)
        code = units.motor_bits(wanted.phases, wanted.half_step)
        if POSITIVE in self.has:
            code |= (wanted.positive_logic is not False) << 3 | clock.external << 4 | wanted.chop << 5
        else:
            code |= clock.external << 3 | wanted.chop << 4 | (self.check_axis(wanted.axis) - 1) * AXIS_BIT
        ramp = self.usual_ramp if wanted.ramp_pulses is None else wanted.ramp_pulses
        speeds = (wanted.start_pps, wanted.high_pps, ramp)
        return units.plan_setup(clock, *speeds, code, self.rate_gap, self.lengths)
