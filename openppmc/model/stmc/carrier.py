"""Carrier model with an STMC and the step clock of the J105 board."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..carrier import carrier
from ..carrier.carrier import SWITCHES, Plant
from ..clock import Edge, Timebase
from ..motion.excitation import ALL_PHASES, step_directions
from ..motion.ramp import BaseClock
from ..single.predict import Limits, RampMove, run
from .codes import BOARD_CLOCK_HZ, TICK_XT
from .commands import profile
from .part import Stmc

_PINS = dict(zip(SWITCHES, ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "mon"), strict=True))


class Carrier(carrier.Carrier[Stmc]):
    """Carrier with the connections of stmc_carrier: no straps, and MON instead of the alarm.

    The motor follows the phases. The step clock is modelled only while a motion counts its edges.
    """

    _directions_of = step_directions()

    def __init__(
        self,
        plant: Plant,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        on_interrupt: Callable[[], None] = lambda: None,
        read_map: str = "FAMILY",
    ) -> None:
        self._phases = 0
        self._tick = 0
        super().__init__(Stmc(clk_hz, xtal_hz, timing, read_map), [plant], on_interrupt)

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        return {_PINS[name]: level for name, level in levels[0].items()}

    def straps(self, levels: int) -> None:
        """Ignore the levels, because no straps are connected."""

    def watched_register(self) -> object:
        return self.part.status

    def pins(self) -> int:
        self._run_pending()
        return self.pin_byte(self.part.outputs["hold"], 0)

    def reset(self) -> None:
        super().reset()
        self._phases = self._tick = 0

    def _next_event(self) -> int | None:
        if self.part.counts_clock and self._tick <= self.part.now:
            # The rising edge n = 0, 1, .. of the square wave is (n + 1/2) periods after power-up.
            rise = (self.part.now * 2 * BOARD_CLOCK_HZ // self.clk_hz + 1) // 2
            self._tick = -(-(2 * rise + 1) * self.clk_hz // (2 * BOARD_CLOCK_HZ))
            self.part.clock_rise(self._tick)
        return super()._next_event()

    def _follow(self, edge: Edge) -> None:
        if edge.signal != "s":
            super()._follow(edge)
        elif edge.value not in (
            0,
            ALL_PHASES,
        ):  # off-time of the chopper, or no initialisation yet
            step = self._directions_of.get((self._phases, edge.value))
            self._phases = edge.value
            if step is not None:
                self._step(0, step)


# Prediction of one motion of an STMC (STMC-INI-02). Its rates are divisors of the internal step clock.

_LIMITS = Limits(slower=0, least=1, shortest=0, longest=65_535)


def predict(
    init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
) -> RampMove:
    """Return the prediction of a move; see `single.predict.predict_move`.

    csel and vsel are ignored, because the part has no such pins.
    """
    ramp = profile(*_LIMITS.check(init, n, rate))
    timebase = timebase or Timebase()
    # A divisor is the number of base clock periods of an interval; a rate is this number minus 1.
    return run(timebase, BaseClock(TICK_XT // timebase.quantum), ramp, n, rate, beyond=1)
