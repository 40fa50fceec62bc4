"""What a PPMC-312 allows. Pure but for reading the file of a free curve."""

from __future__ import annotations

from pathlib import Path

from ...parts import part
from ..basis.errors import OutOfRange
from ..basis.kind import COILS_OFF, CURVES, FREE_CURVES, LONG, OWN_STOP, PHASES, Kind, Wanted
from . import free, profile


class TableKind(Kind):
    """Speeds are a base clock over a 16-bit rate, and the clock is part of the table. It has neither phases
    nor straps that choose anything."""

    def plan(self, xtal_hz: int, wanted: Wanted) -> profile.Setup:
        self.check_axis(wanted.axis)
        motor = wanted.half_step or wanted.phases != 4 or wanted.chop or wanted.positive_logic
        for asked, what in (
            (motor, PHASES),
            (wanted.long_intervals, LONG),
            (wanted.own_stop, OWN_STOP),
            (wanted.curve is not None, FREE_CURVES),
        ):
            if asked:
                self.need(what)
        clocks = (wanted.base_clock, wanted.external_clock)
        if wanted.curve is not None:
            if wanted.sigmoid or wanted.own_stop:
                raise OutOfRange("a free curve has its own speeds and pulses: give either it or those")
            return free.plan_file(xtal_hz, Path(wanted.curve), *clocks)
        start, stop = wanted.start_pps, wanted.stop_pps
        clock = profile.choose_clock(xtal_hz, start if stop is None else min(start, stop), *clocks)
        ramp = self.usual_ramp if wanted.ramp_pulses is None else wanted.ramp_pulses
        return profile.plan_setup(
            clock, start, wanted.high_pps, ramp, stop, wanted.down_pulses, wanted.sigmoid
        )


KIND = TableKind(
    part("ppmc312"),
    has=frozenset((COILS_OFF, OWN_STOP, CURVES, FREE_CURVES)),
    outputs=63,
    alarm=("alarm input", "clear the drive's alarm, then the part's"),
    origin_between=True,
    usual_ramp=2000,
)
