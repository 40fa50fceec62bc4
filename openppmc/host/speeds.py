"""Pulses per second to the rate bytes of the part and back, exactly (P104-INT-01, -02, STMC-INI-01). Pure.

All speeds are in pulses per second (pps), as exact fractions; where a part gives no pulses, a pulse is a
step. A part cannot make every speed: it makes base clock / (rate + 1) with rate 0 to 255, or base clock /
divisor, so a speed that was asked for is rounded to the nearest interval.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from ..model.motion.codes import ENDLESS, PA_MAX, PA_MIN
from ..model.motion.ramp import Ramp
from .check import Number as Number
from .check import exact as exact
from .errors import OutOfRange

SLOWEST_RATE = 255
LONGEST_MOVE = ENDLESS
QUANTA_FAST, QUANTA_SLOW, QUANTA_EXTRA = 8, 32, 30


def nearby(speed: Fraction | float | int) -> str:
    """A speed for messages: six digits at most, no needless zeros."""
    return f"{float(speed):.6g}"


@dataclass(frozen=True)
class BaseClock:
    """What the intervals are counted in.

    period: of one base clock in s. extra: addition to every interval in s (vsel low). csel, vsel: levels of
    the strap pins that choose it. external: it comes in at the `clock` pin. least_rate: lowest rate byte
    that the driver uses with it. beyond: base clocks of an interval beyond its rate byte.
    slowest_rate: the highest rate. clk: its number on parts that number them.
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
        """500 kHz (csel 1) or 125 kHz (csel 0) at a 16 MHz crystal; vsel 0 adds 7.5 us to each interval."""
        quantum = Fraction(4, xtal_hz)
        quanta = QUANTA_FAST if csel else QUANTA_SLOW
        extra = (0 if vsel else QUANTA_EXTRA) * quantum
        return cls(quanta * quantum, extra, csel, vsel, least_rate=least_rate)

    @classmethod
    def external_pin(cls, hertz: Number) -> BaseClock:
        """A steady clock on the `clock` pin, 0 < hertz <= 1e6; vsel is kept high. OutOfRange otherwise."""
        return cls(pin_period(hertz), external=True)

    @property
    def hertz(self) -> Fraction:
        """Frequency in Hz."""
        return 1 / self.period

    def speed(self, rate: int) -> Fraction:
        """Speed of a rate byte in pps."""
        return self.speed_of(rate + self.beyond)

    def speed_of(self, periods: int) -> Fraction:
        """Speed of an interval of so many base clocks in pps."""
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
        """The speed lies between the slowest and the fastest."""
        return self.slowest <= exact(pps, "speed") <= self.fastest

    def choose(self, pps: Number, what: str = "speed") -> Speed:
        """The rate whose interval is nearest. Raises OutOfRange with the possible range."""
        asked = exact(pps, what)
        if not self.slowest <= asked <= self.fastest:
            raise OutOfRange(
                f"{what} {nearby(asked)} pps is outside {nearby(self.slowest)} to {nearby(self.fastest)} pps "
                f"(base clock {nearby(self.hertz)} Hz)"
            )
        periods = (1 / asked - self.extra) / self.period
        rate = min(self.slowest_rate, max(self.least_rate, int(periods + Fraction(1, 2)) - self.beyond))
        return Speed(asked, rate, self.speed(rate), self)


def pin_period(hertz: Number) -> Fraction:
    """Period of a clock that comes from outside in s. OutOfRange."""
    if not 0 < exact(hertz, "external clock") <= 1_000_000:
        raise OutOfRange(f"external clock {nearby(hertz)} Hz is outside 0 to 1000000 Hz")
    return 1 / Fraction(hertz)


@dataclass(frozen=True)
class Speed:
    """A speed as it was asked for and as the part makes it, both in pps."""

    asked: Fraction
    rate: int
    reached: Fraction
    clock: BaseClock = field(repr=False)

    @property
    def error(self) -> float:
        """Relative deviation: 0.01 is one per cent too fast."""
        return float(self.reached / self.asked - 1)

    def __str__(self) -> str:
        return f"{nearby(self.reached)} pps"


@dataclass(frozen=True)
class Setup:
    """Everything that an initialisation fixes, with the speeds that are really reached."""

    start: Speed
    high: Speed
    ramp_pulses: int
    code: int

    def __str__(self) -> str:
        return f"start {self.start}, high {self.high}, ramp {self.ramp_pulses} pulses, {self.clock}"

    @property
    def clock(self) -> BaseClock:
        """The base clock of the ramp."""
        return self.start.clock

    @property
    def data(self) -> bytes:
        """RL, RH, PA low, PA high."""
        return bytes([self.start.rate, self.high.rate]) + self.ramp_pulses.to_bytes(2, "little")

    @property
    def flat(self) -> bool:
        """There is one speed only, the high one (on an STMC with 0 ramp pulses, too: STMC-MOV-04)."""
        return not self.ramp_pulses or self.start.rate == self.high.rate

    def ramp(self) -> Ramp:
        """The ramp, to predict moves with; its rates are base clocks of an interval less one."""
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
        """Time of the acceleration in s, from the formula of constant acceleration."""
        return float(2 * self.ramp_pulses / (self.start.reached + self.high.reached))


def motor_bits(phases: int, half_step: bool) -> int:
    """Low bits of an initialisation code. phases 3, 4 or 5; OutOfRange otherwise."""
    if phases not in (3, 4, 5):
        raise OutOfRange(f"{phases} phases: the part drives motors with 3, 4 or 5")
    return phases - 2 | half_step << 2


def choose_clock(
    xtal_hz: int, start_pps: Number, base_clock: Number | None, vsel: int = 1, least_rate: int = 0
) -> BaseClock:
    """Internal base clock: the one asked for, or the one that reaches start_pps.

    base_clock in Hz: 500 000 or 125 000 at a 16 MHz crystal, None to choose. The fast one is preferred
    because its speeds lie closer together. Raises OutOfRange.
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
    """An internal base clock that reaches the speed, csel = first preferred. Raises OutOfRange."""
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
    """Rates of a ramp, the start rate at least `rate_gap` above the high rate; lengths: shortest and longest
    ramp. Raises OutOfRange for speeds or a length that the part cannot do."""
    shortest, longest = lengths
    if not shortest <= ramp_pulses <= longest:
        raise OutOfRange(f"ramp of {ramp_pulses} pulses is outside {shortest} to {longest} pulses")
    start = clock.choose(start_pps, "start speed")
    high = clock.choose(high_pps, "high speed")
    if start.asked > high.asked:
        raise OutOfRange(
            f"start speed {nearby(start.asked)} pps is above high speed {nearby(high.asked)} pps: swap them"
        )
    if start.rate < high.rate + rate_gap:
        raise OutOfRange(
            f"start speed {start} and high speed {high} are too close together: this part needs {rate_gap} "
            f"steps of its rate between them (rates {start.rate} and {high.rate} here)"
        )
    return Setup(start, high, ramp_pulses, code)
