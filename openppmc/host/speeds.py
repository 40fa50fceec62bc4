"""Exact conversion between pulses per second and rate bytes. Pure.

Rules: P104-INT-01, P104-INT-02, STMC-INI-01.

All speeds are exact fractions in pulses per second (pps); for a part without a pulse output, a pulse means a
step. A part supports only certain speeds: base clock / (rate + 1) with rate 0 to 255, or base clock /
divisor. Therefore a requested speed is rounded to the nearest interval.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from ..lazy import Renamed
from ..model.motion.codes import ENDLESS, PA_MAX, PA_MIN
from ..model.motion.ramp import Ramp
from .check import Number as Number
from .check import exact as exact
from .errors import OutOfRange

SLOWEST_RATE = 255
LONGEST_MOVE = ENDLESS
QUANTA_FAST, QUANTA_SLOW, QUANTA_EXTRA = 8, 32, 30


def nearby(speed: Fraction | float | int) -> str:
    """Return a speed as text for messages: at most six digits, without unnecessary zeros."""
    return f"{float(speed):.6g}"


@dataclass(frozen=True)
class BaseClock:
    """Base clock. The intervals between pulses are counted in its periods.

    Attributes:
        period: period of the base clock in s.
        extra: time in s that is added to every interval (vsel low).
        csel, vsel: levels of the strap pins that select this clock.
        external: True for the clock at the pin `clock`.
        least_rate: lowest rate byte that the driver uses with this clock.
        beyond: number of base clock periods of an interval, minus the rate byte of the interval: 1 if the
            speed is base clock / (rate + 1), 0 if it is base clock / divisor.
        slowest_rate: highest rate byte, which selects the slowest speed.
        clk: number of the clock in the initialisation, on parts that number their clocks.
    """

    period: Fraction
    extra: Fraction = Fraction(0)
    csel: int = 1
    vsel: int = 1
    external: bool = False
    least_rate: int = 0
    beyond: int = 1
    slowest_rate: int = SLOWEST_RATE
    clk: int = 0

    def __str__(self) -> str:
        return f"base clock {nearby(self.hertz)} Hz"

    @classmethod
    def internal(cls, xtal_hz: int, csel: int = 1, vsel: int = 1, least_rate: int = 0) -> BaseClock:
        """Return an internal base clock.

        At a 16 MHz crystal, its frequency is 500 kHz (csel 1) or 125 kHz (csel 0); vsel 0 adds 7.5 us to each
        interval.
        """
        quantum = Fraction(4, xtal_hz)
        quanta = QUANTA_FAST if csel else QUANTA_SLOW
        extra = (0 if vsel else QUANTA_EXTRA) * quantum
        return cls(quanta * quantum, extra, csel, vsel, least_rate=least_rate)

    @classmethod
    def external_pin(cls, hertz: Number) -> BaseClock:
        """Return the base clock for a clock of constant frequency at the pin `clock`; vsel stays high.

        Raises:
            OutOfRange: hertz is not in 0 < hertz <= 1e6.
        """
        return cls(pin_period(hertz), external=True)

    @property
    def hertz(self) -> Fraction:
        """Frequency in Hz."""
        return 1 / self.period

    def speed(self, rate: int) -> Fraction:
        """Return the speed of a rate byte in pps."""
        return self.speed_of(rate + self.beyond)

    def speed_of(self, periods: int) -> Fraction:
        """Return the speed in pps for intervals of this number of base clock periods."""
        return 1 / (periods * self.period + self.extra)

    @property
    def slowest(self) -> Fraction:
        """Lowest speed in pps."""
        return self.speed(self.slowest_rate)

    @property
    def fastest(self) -> Fraction:
        """Highest speed in pps."""
        return self.speed(self.least_rate)

    def reaches(self, pps: Number) -> bool:
        """Return True if the speed is between the lowest and the highest speed."""
        return self.slowest <= exact(pps, "speed") <= self.fastest

    def choose(self, pps: Number, what: str = "speed") -> Speed:
        """Return the rate whose interval is nearest to the interval of the speed `pps`.

        Raises:
            OutOfRange: the speed is out of range; the message states the range.
        """
        requested = exact(pps, what)
        if not self.slowest <= requested <= self.fastest:
            raise OutOfRange(
                f"{what} {nearby(requested)} pps is outside {nearby(self.slowest)} to "
                f"{nearby(self.fastest)} pps "
                f"(base clock {nearby(self.hertz)} Hz)"
            )
        periods = (1 / requested - self.extra) / self.period
        rate = min(self.slowest_rate, max(self.least_rate, int(periods + Fraction(1, 2)) - self.beyond))
        return Speed(requested, rate, self.speed(rate), self)


def pin_period(hertz: Number) -> Fraction:
    """Return the period of an external clock in s. Raises OutOfRange."""
    if not 0 < exact(hertz, "external clock") <= 1_000_000:
        raise OutOfRange(f"external clock {nearby(hertz)} Hz is outside 0 to 1000000 Hz")
    return 1 / Fraction(hertz)


@dataclass(frozen=True)
class Speed:
    """Speed as requested and as reached by the part, both in pps."""

    requested: Fraction
    rate: int
    reached: Fraction
    clock: BaseClock = field(repr=False)
    asked = Renamed("requested")

    @property
    def error(self) -> float:
        """Relative deviation; 0.01 = one per cent too fast."""
        return float(self.reached / self.requested - 1)

    def __str__(self) -> str:
        return f"{nearby(self.reached)} pps"


@dataclass(frozen=True)
class Setup:
    """All settings of an initialisation, with the requested and the reached speeds."""

    start: Speed
    high: Speed
    ramp_pulses: int
    code: int

    def __str__(self) -> str:
        return f"start {self.start}, high {self.high}, ramp {self.ramp_pulses} pulses, {self.clock}"

    @property
    def clock(self) -> BaseClock:
        """Base clock of the ramp."""
        return self.start.clock

    @property
    def data(self) -> bytes:
        """Data bytes of the initialisation: start rate, high rate, ramp pulses (two bytes, low first)."""
        return bytes([self.start.rate, self.high.rate]) + self.ramp_pulses.to_bytes(2, "little")

    @property
    def flat(self) -> bool:
        """True if moves have no ramp, because the start speed equals the high speed.

        On an STMC, this is also the case with 0 ramp pulses (STMC-MOV-04).
        """
        return not self.ramp_pulses or self.start.rate == self.high.rate

    def ramp(self) -> Ramp:
        """Return the ramp for predictions of moves.

        A rate of this ramp is the number of base clock periods of an interval minus 1.
        """
        beyond = self.clock.beyond - 1
        slow, fast = self.start.rate + beyond, self.high.rate + beyond
        return Ramp(slow, fast, self.ramp_pulses) if self.ramp_pulses else Ramp(fast, fast, 0)

    @property
    def acceleration(self) -> float:
        """Mean acceleration of the ramp in pps per second; 0 without a ramp."""
        v0, v1 = self.start.reached, self.high.reached
        return 0.0 if self.flat else float((v1 * v1 - v0 * v0) / (2 * self.ramp_pulses))

    @property
    def ramp_seconds(self) -> float:
        """Duration of the acceleration in s, calculated for constant acceleration."""
        return float(2 * self.ramp_pulses / (self.start.reached + self.high.reached))


def motor_bits(phases: int, half_step: bool) -> int:
    """Return the low bits of an initialisation code. Raises OutOfRange if phases is not 3, 4 or 5."""
    if phases not in (3, 4, 5):
        raise OutOfRange(f"{phases} phases: the part drives motors with 3, 4 or 5")
    return phases - 2 | half_step << 2


def choose_clock(
    xtal_hz: int, start_pps: Number, base_clock: Number | None, vsel: int = 1, least_rate: int = 0
) -> BaseClock:
    """Return the internal base clock `base_clock`, or the most suitable one for start_pps.

    The most suitable clock is the fast one, because of its finer speed resolution, if it reaches start_pps;
    otherwise, it is the slow clock.

    Args:
        base_clock: frequency, 500 000 or 125 000 Hz at a 16 MHz crystal; `None` for the most suitable clock.

    Raises:
        OutOfRange: the part does not have this base clock.
    """
    fast, slow = (BaseClock.internal(xtal_hz, csel, vsel, least_rate) for csel in (1, 0))
    if base_clock is None:
        return fast if fast.slowest <= exact(start_pps, "start speed") else slow
    for clock in (fast, slow):
        if clock.hertz == exact(base_clock, "base clock"):
            return clock
    raise OutOfRange(
        f"base clock {nearby(base_clock)} Hz: this part has {nearby(fast.hertz)} and {nearby(slow.hertz)} Hz"
    )


def any_clock(xtal_hz: int, pps: Number, vsel: int = 1, first: int = 1, least_rate: int = 0) -> BaseClock:
    """Return an internal base clock that reaches the speed.

    If both clocks reach it, the clock with csel = `first` is returned.

    Raises:
        OutOfRange: no base clock reaches the speed.
    """
    clocks = [BaseClock.internal(xtal_hz, csel, vsel, least_rate) for csel in (first, 1 - first)]
    for clock in clocks:
        if clock.reaches(pps):
            return clock
    low, high = min(clock.slowest for clock in clocks), max(clock.fastest for clock in clocks)
    raise OutOfRange(f"speed {nearby(pps)} pps is outside {nearby(low)} to {nearby(high)} pps")


def plan_setup(
    clock: BaseClock,
    start_pps: Number,
    high_pps: Number,
    ramp_pulses: int,
    code: int,
    rate_gap: int = 0,
    lengths: tuple[int, int] = (PA_MIN, PA_MAX),
) -> Setup:
    """Return the set-up of a ramp.

    Args:
        rate_gap: smallest difference of start rate and high rate.
        lengths: shortest and longest ramp in pulses.

    Raises:
        OutOfRange: the part does not support these speeds or this length.
    """
    shortest, longest = lengths
    if not shortest <= ramp_pulses <= longest:
        raise OutOfRange(f"ramp of {ramp_pulses} pulses is outside {shortest} to {longest} pulses")
    start = clock.choose(start_pps, "start speed")
    high = clock.choose(high_pps, "high speed")
    if start.requested > high.requested:
        raise OutOfRange(
            f"start speed {nearby(start.requested)} pps is above high speed {nearby(high.requested)} pps: "
            "swap them"
        )
    if start.rate < high.rate + rate_gap:
        raise OutOfRange(
            f"start speed {start} and high speed {high} are too close together: this part needs {rate_gap} "
            f"steps of its rate between them (rates {start.rate} and {high.rate} here)"
        )
    return Setup(start, high, ramp_pulses, code)
