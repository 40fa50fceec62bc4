"""Key figures of a move of a PPMC-312 before it is made, from the golden model's tables. Pure."""

from __future__ import annotations

from itertools import accumulate
from typing import Any

from ...host import speeds
from ...host.errors import OutOfRange
from ...host.ppmc312.motion import SHAPES
from ...host.ppmc312.profile import Setup
from ...model.ppmc312.stages import Plan, constant, ramped
from ..common.forecast import Course

LONGEST_MOVE = (1 << 32) - 1


def _plan(setup: Setup, pulses: int, speed: speeds.Speed | None) -> Plan:
    if not 1 <= pulses <= LONGEST_MOVE:
        raise OutOfRange(f"{pulses} pulses: a move has 1 to {LONGEST_MOVE} pulses either way")
    if speed is None:
        return ramped(setup.table, setup.table.high, pulses)
    return constant(setup.table, setup.rate_of(speed.asked), pulses)


def figures(setup: Setup, pulses: int, speed: speeds.Speed | None) -> dict[str, Any]:
    """As `forecast.key_figures`: interval by interval on the ramps, in closed form between them."""
    n = abs(pulses)
    plan = _plan(setup, n, speed)
    sloped = [*range(1, plan.up + 1), *range(n - plan.down + 1, n + 1)]
    rates = {number: plan.step(number).rate for number in sloped}
    plateau = n - len(sloped)
    ticks = sum(rates.values()) + plateau * plan.rate
    ticks -= rates.get(n, plan.rate)  # nothing follows the last pulse
    fastest = min([*rates.values(), *([plan.rate] if plateau else [])])
    period = setup.clock.period
    values: dict[str, Any] = {
        "pulses": pulses,
        "profile": "constant speed" if speed is not None else SHAPES[plan.kind],
        "top_pps": float(setup.clock.speed(fastest)),
        "seconds": float(ticks * period),
    }
    if speed is None:
        rise = sum(rates[number] for number in range(1, plan.up + 1))
        values |= {
            "ramp_pulses": plan.up,
            "plateau_intervals": plateau,
            "down_pulses": plan.down,
            "ramp_seconds": float(rise * period),
        }
    return values


def course(setup: Setup, pulses: int, speed: speeds.Speed | None) -> Course:
    """With the table's ramps or at a constant speed, pulses from 1 on."""
    rates = [step.rate for step in _plan(setup, pulses, speed).steps()[:-1]]
    period = float(setup.clock.period)
    seconds = [ticks * period for ticks in accumulate(rates, initial=0)]
    return Course(seconds, [1 / (rate * period) for rate in rates])
