"""Key figures of a move before it is made, from the golden model's ramp, which most of the family have; and
the plot of any move. Pure but for the plot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate
from pathlib import Path
from typing import Any

from ...errors import needs
from ...host import speeds as units
from ...host.errors import OutOfRange
from ...model.motion.codes import ENDLESS
from ...model.motion.ramp import profile_index

LONGEST_PLOT = 1_000_000


def key_figures(setup: units.Setup, pulses: int, speed: units.Speed | None) -> dict[str, Any]:
    """Figures of an undisturbed move; times in s from the first to the last pulse, speeds in pps.

    Computed interval by interval along the ramp, in closed form on the plateau. OutOfRange for a number of
    pulses that the part cannot do.
    """
    n = abs(pulses)
    if not 1 <= n <= ENDLESS:
        raise OutOfRange(f"{pulses} pulses: a move has 1 to {ENDLESS} pulses either way")
    if speed is not None:
        return {
            "pulses": pulses,
            "profile": "constant speed",
            "top_pps": float(speed.reached),
            "seconds": float((n - 1) / speed.reached),
        }
    ramp, clock = setup.ramp(), setup.clock
    pa = ramp.pa
    plateau = max(0, n - 1 - 2 * pa)
    sloped = range(1, n) if not plateau else (*range(1, pa + 1), *range(n - pa, n))
    periods = [1 / clock.speed_of(ramp.rate(profile_index(n, pa, j)) + 1) for j in sloped]
    slopes = sum(periods, Fraction(0))
    top = setup.high.reached if plateau else 1 / min(periods, default=1 / clock.speed_of(ramp.rl + 1))
    return {
        "pulses": pulses,
        "profile": "trapezoid" if plateau else "triangle",
        "top_pps": float(top),
        "ramp_pulses": pa if plateau else (n - 1) // 2,
        "plateau_intervals": plateau,
        "ramp_seconds": float(sum(periods[: len(periods) // 2], Fraction(0))),
        "seconds": float(slopes + plateau / setup.high.reached),
    }


@dataclass(frozen=True)
class Course:
    """A move to draw: times of its pulses in s, speed of each interval in pps."""

    seconds: list[float]
    speeds: list[float]

    @classmethod
    def of(cls, setup: units.Setup, pulses: int, speed: units.Speed | None) -> Course:
        """With the ramp of the set-up or at a constant speed, pulses from 1 on."""
        if speed is None:
            ramp, clock = setup.ramp(), setup.clock
            counts = [ramp.rate(profile_index(pulses, ramp.pa, j)) + 1 for j in range(1, pulses)]
        else:
            clock = speed.clock
            counts = [speed.rate + clock.beyond] * (pulses - 1)
        period, extra = float(clock.period), float(clock.extra)
        seconds = [n * extra + total * period for n, total in enumerate(accumulate(counts, initial=0))]
        speeds = {count: float(clock.speed_of(count)) for count in set(counts)}
        return cls(seconds, [speeds[count] for count in counts])


def plot_move(course: Callable[[int], Course], pulses: int, path: Path) -> None:
    """Speed over time as PNG, SVG or PDF. course: makes that of so many pulses. OutOfRange for moves too long
    to draw and for file names that the plotter does not know."""
    needs("plot", "a plot", "matplotlib")
    from ...plot.profile import FORMATS, draw_profile

    if abs(pulses) > LONGEST_PLOT:
        raise OutOfRange(f"a plot shows up to {LONGEST_PLOT} pulses: choose a shorter move")
    if path.suffix.lower() not in FORMATS:
        raise OutOfRange(f"{path}: the name of a plot ends in {', '.join(FORMATS)}")
    draw_profile(course(abs(pulses)), f"{pulses} pulses", path)
