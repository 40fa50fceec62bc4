"""Capabilities of a part, for drivers and for plans without a board. Pure.

This module has the members that all parts share.

The capabilities of a part are `CAPABILITIES` in its folder (`openppmc.parts`, column `capabilities`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, cast

from ..model.motion.codes import PA_MAX, PA_MIN
from ..parts import Row, by_number, part
from . import speeds as units
from .errors import OutOfRange
from .motion_result import ALARM_INPUT

POSITIVE = "positive logic"
LONG = "long intervals"
PULSE_ONLY = "pulse only"
COILS_OFF = "excitation off"
CHOPPER = "chopper times"
FREE_CURVES = "free curves"
AUX = "output AUX"
PHASES = "phase outputs"
OWN_STOP = "a separate deceleration"
CURVES = "ramps of other shapes"
OWN_SETTINGS = "settings instead of a set-up"
"""Capabilities that not all parts have, as text."""


@dataclass(frozen=True)
class SetupRequest:
    """A request for an initialisation; names and units are those of `initialise` of the drivers.

    Attributes:
        ramp_pulses: `None` for the default of the part.
        positive_logic: `None` for the only logic of the part, or for positive logic if the part has both.
        axis: number of the axis.
        curve: file of a free curve; see `ppmc312.profile.read_stages`.
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
        """True if the deceleration ramp is set separately.

        Otherwise, it is the reversed acceleration ramp.
        """
        return self.stop_pps is not None or self.down_pulses is not None


class AnySetup(Protocol):
    """Members of the set-ups of all parts.

    Attributes:
        start, high: start speed and high speed, as requested and as reached.
        ramp_pulses: pulses of the ramp between these speeds.
        clock: base clock of the ramp.
    """

    @property
    def start(self) -> units.Speed: ...
    @property
    def high(self) -> units.Speed: ...
    @property
    def ramp_pulses(self) -> int: ...
    @property
    def clock(self) -> units.BaseClock: ...


@dataclass(frozen=True)
class Capabilities:
    """Capabilities of one part.

    Attributes:
        row: row of the part in the table of parts.
        axes: number of axes.
        has: capabilities that this part has (see above).
        outputs: highest value of the auxiliary outputs; 0 if the part has no such outputs.
        alarm: name of the alarm input, and the advice in the message about an alarm.
        origin_between: True if the origin is between the two slow-down limits. A search that reaches a
        slow-down limit then ends there.
        usual_ramp: default length of a ramp in pulses.
    """

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
        """Part number in IDENT of the bridge, 0 for a part that is not accessed through a bridge."""
        return self.row.number

    def check_axis(self, axis: int) -> int:
        """Return the axis number unchanged. Raises OutOfRange if the part does not have this axis."""
        if not 1 <= axis <= self.axes:
            there = "one axis" if self.axes == 1 else f"axes 1 to {self.axes}"
            raise OutOfRange(f"axis {axis}: a {self} has {there}")
        return axis

    def need(self, what: str) -> None:
        """Raise OutOfRange if the part lacks this capability (a member of `has`)."""
        if what not in self.has:
            raise OutOfRange(f"{what}: a {self} does not have that")

    def constant_clock(
        self, xtal_hz: int, ramp: units.BaseClock | None, pps: units.Number
    ) -> units.BaseClock:
        """Return the base clock of a constant speed.

        This method returns the clock that the initialisation has selected; subclasses may select another
        clock.

        Args:
            ramp: base clock of the ramp, `None` if it is unknown.

        Raises:
            OutOfRange: no clock reaches the speed.
        """
        if ramp is None:
            raise OutOfRange("a speed needs a base clock, which an initialisation chooses: initialise first")
        ramp.choose(pps)
        return ramp

    def plan(self, xtal_hz: int, request: SetupRequest) -> AnySetup:
        """Return the set-up of an initialisation, with the values that are reached.

        Raises:
            OutOfRange: the part does not support the request.
        """
        raise OutOfRange(f"plan: a {self} does not have that")


def capabilities_of(name: str) -> Capabilities:
    """Return the capabilities of the part with this name. Raises UnknownPartError."""
    return cast(Capabilities, part(name).load("capabilities"))


def name_of(number: int) -> str:
    """Return the name of the part with this number; a text with the number for an unknown part."""
    row = by_number(number)
    return f"PPMC-{number}" if row is None else row.title


# Capabilities of parts whose speeds are a base clock divided by a rate byte + 1 (P104-INT-01).

AXIS_BIT = 0x20
"""Bit of a command code that selects axis 2."""


@dataclass(frozen=True)
class RateCapabilities(Capabilities):
    """Capabilities of a part with rate bytes; see `Capabilities`.

    Attributes:
        lengths: smallest and largest number of ramp pulses.
        least_rate: lowest rate byte that is used with an internal base clock.
        rate_gap: smallest difference of start rate and high rate.
    """

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

    def ramp_clock(self, xtal_hz: int, request: SetupRequest) -> units.BaseClock:
        """Return the base clock of an initialisation. Raises OutOfRange."""
        if request.external_clock is not None:
            return units.BaseClock.external_pin(request.external_clock)
        vsel = int(not request.long_intervals)
        return units.choose_clock(xtal_hz, request.start_pps, request.base_clock, vsel, self.least_rate)

    def plan(self, xtal_hz: int, request: SetupRequest) -> units.Setup:
        for requested, what in (
            (request.positive_logic, POSITIVE),
            (request.long_intervals, LONG),
            (request.own_stop, OWN_STOP),
            (request.sigmoid or request.curve is not None, CURVES),
        ):
            if requested:
                self.need(what)
        clock = self.ramp_clock(xtal_hz, request)
        code = units.motor_bits(request.phases, request.half_step)
        if POSITIVE in self.has:
            code |= (request.positive_logic is not False) << 3 | clock.external << 4 | request.chop << 5
        else:
            code |= clock.external << 3 | request.chop << 4 | (self.check_axis(request.axis) - 1) * AXIS_BIT
        ramp = self.usual_ramp if request.ramp_pulses is None else request.ramp_pulses
        speeds = (request.start_pps, request.high_pps, ramp)
        return units.plan_setup(clock, *speeds, code, self.rate_gap, self.lengths)
