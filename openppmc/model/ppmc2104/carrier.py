"""Carrier model with a PPMC-2104."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..carrier import carrier
from ..carrier.carrier import SWITCHES, Plant
from ..clock import Timebase
from ..motion.codes import PA_MAX, PA_MIN
from ..motion.ramp import BaseClock, Ramp
from ..single.predict import Limits, RampMove, run
from .part import Ppmc2104

_PINS = dict(zip(SWITCHES, ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n"), strict=True))


class Carrier(carrier.Carrier[Ppmc2104]):
    """Carrier with the connections of ppmc2104_carrier.

    Bits 1..0 of the straps are csel, bits 3..2 are run, bit 4 is errint_n. Bit 7 selects the axis whose pins
    PINS returns: 1 = axis 1.
    """

    def __init__(
        self,
        plants: Sequence[Plant],
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        on_interrupt: Callable[[], None] = lambda: None,
    ) -> None:
        self._watched_register = 0
        super().__init__(Ppmc2104(clk_hz, xtal_hz, timing), plants, on_interrupt)

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        first, second = levels
        return {pin: first[name] | second[name] << 1 for name, pin in _PINS.items()}

    def straps(self, levels: int) -> None:
        self._watched_register = int(not levels & 0x80)
        self.set_pins(csel=levels & 3, run=levels >> 2 & 3, errint_n=levels >> 4 & 1)

    def watched_register(self) -> object:
        return self.part.status

    def pins(self) -> int:
        self._run_pending()
        return self.pin_byte(self.part.outputs["hold"] >> self._watched_register & 1, self._watched_register)


# Prediction of one move of a PPMC-2104 axis (P2104-INI-02, P2104-OPR-07).

_LIMITS = Limits(slower=2, least=1, shortest=PA_MIN, longest=PA_MAX)


def predict(
    init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
) -> RampMove:
    """Return the prediction of a move; see `single.predict.predict_move`."""
    ramp = Ramp(*_LIMITS.check(init, n, rate))
    return run(timebase or Timebase(), BaseClock.of_pins(csel, vsel), ramp, n, rate)
