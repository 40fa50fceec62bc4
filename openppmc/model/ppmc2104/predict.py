"""Prediction of one move of a PPMC-2104 axis (P2104-INI-02, P2104-OPR-07)."""

from __future__ import annotations

from ..common.timebase import Timebase
from ..motion.codes import PA_MAX, PA_MIN
from ..motion.ramp import BaseClock, Ramp
from ..single.predict import Limits, RampMove, run

_LIMITS = Limits(slower=2, least=1, shortest=PA_MIN, longest=PA_MAX)


def predict(
    init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
) -> RampMove:
    """See `single.predict.predict_move`."""
    ramp = Ramp(*_LIMITS.check(init, n, rate))
    return run(timebase or Timebase(), BaseClock.of_pins(csel, vsel), ramp, n, rate)
