"""Prediction of one motion of an STMC (STMC-INI-02); its rates are divisors of the internal step clock."""

from __future__ import annotations

from ..common.timebase import Timebase
from ..motion.ramp import BaseClock
from ..single.predict import Limits, RampMove, run
from .codes import TICK_XT
from .commands import profile

_LIMITS = Limits(slower=0, least=1, shortest=0, longest=65_535)


def predict(
    init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
) -> RampMove:
    """See `single.predict.predict_move`; csel and vsel, which the part has not, are not looked at."""
    ramp = profile(*_LIMITS.check(init, n, rate))
    timebase = timebase or Timebase()
    # A divisor counts its base clocks, a rate those beyond the first.
    return run(timebase, BaseClock(TICK_XT // timebase.quantum), ramp, n, rate, beyond=1)
