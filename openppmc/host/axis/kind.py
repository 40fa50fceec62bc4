"""What parts allow whose speeds are a rate byte over a base clock (P104-INT-01). Pure."""

from __future__ import annotations

from dataclasses import dataclass

from ...model.motion.codes import PA_MAX, PA_MIN
from ..basis import units
from ..basis.kind import CURVES, LONG, OWN_STOP, POSITIVE, Kind, Wanted

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
