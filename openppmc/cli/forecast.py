"""Key figures of a move before it is made, from the golden model's ramp. Pure but for the plot."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

from ..host import units
from ..host.errors import OutOfRange, PpmcError
from ..host.kinds import Kind
from ..model.codes import ENDLESS
from ..model.predict import predict_move
from ..model.ramp import Ramp, profile_index
from ..model.timebase import Timebase

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
    ramp = Ramp(setup.start.rate, setup.high.rate, setup.ramp_pulses)
    pa, clock = setup.ramp_pulses, setup.clock
    plateau = max(0, n - 1 - 2 * pa)
    sloped = range(1, n) if not plateau else (*range(1, pa + 1), *range(n - pa, n))
    periods = [1 / clock.speed(ramp.rate(profile_index(n, pa, j))) for j in sloped]
    slopes = sum(periods, Fraction(0))
    top = setup.high.reached if plateau else 1 / min(periods, default=1 / setup.start.reached)
    return {
        "pulses": pulses,
        "profile": "trapezoid" if plateau else "triangle",
        "top_pps": float(top),
        "ramp_pulses": pa if plateau else (n - 1) // 2,
        "plateau_intervals": plateau,
        "ramp_seconds": float(sum(periods[: len(periods) // 2], Fraction(0))),
        "seconds": float(slopes + plateau / setup.high.reached),
    }


def plot_move(
    setup: units.Setup, pulses: int, speed: units.Speed | None, xtal_hz: int, path: Path, kind: Kind
) -> None:
    """Speed over time as PNG, SVG or PDF. OutOfRange for moves too long to draw, with an external clock, and
    for file names that the plotter does not know."""
    try:
        from ..plot.profile import FORMATS, draw_profile
    except ImportError as error:
        raise PpmcError(f"a plot needs matplotlib ({error}): pip install matplotlib") from error
    if setup.clock.external:
        raise OutOfRange("a plot needs an internal base clock: leave --external-clock out")
    if abs(pulses) > LONGEST_PLOT:
        raise OutOfRange(f"a plot shows up to {LONGEST_PLOT} pulses: choose a shorter move")
    if path.suffix.lower() not in FORMATS:
        raise OutOfRange(f"{path}: the name of a plot ends in {', '.join(FORMATS)}")
    clock = setup.clock if speed is None else speed.clock
    move = predict_move(
        setup.data,
        abs(pulses),
        None if speed is None else speed.rate,
        clock.csel,
        clock.vsel,
        Timebase(16_000_000, xtal_hz),
        part=f"ppmc{kind.number}",
    )
    draw_profile(move, f"{pulses} pulses", path)
