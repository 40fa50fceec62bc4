"""Carrier model with a PPMC-312 and a motor that has an encoder."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import accumulate

from ..carrier import carrier
from ..carrier.carrier import SWITCHES, Plant
from ..clock import Edge, Timebase
from ..single.predict import Move
from .codes import FO, LE
from .part import Ppmc312
from .stages import DIVIDERS, SettingError, Table, build, constant, ramped

_PINS = dict(zip(SWITCHES, ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n"), strict=True))


class Carrier(carrier.Carrier[Ppmc312]):
    """Carrier with the connections of ppmc312_carrier.

    Bit 0 of the straps is RUN; bits 1 and 2 are event inputs 1 and 2.

    The shaft may lose pulses; the encoder outputs one pulse for each pulse that the shaft follows.
    `positions` holds the position of the shaft, but the part counts all pulses. The drive always asserts END.
    """

    ADDRESS_BITS = 3
    INTERRUPT = "irq_n"

    def __init__(
        self,
        plant: Plant,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        on_interrupt: Callable[[], None] = lambda: None,
        part: Ppmc312 | None = None,
    ) -> None:
        """Create the carrier.

        Args:
            part: existing part to use instead of a new one with these frequencies and this timing.
        """
        self._moved, self._plant = False, plant
        super().__init__(part or Ppmc312(clk_hz, xtal_hz, timing), [plant], on_interrupt)
        self.part.pins(self.t - 3, end_n=0, auxi=0xFF)

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        return {
            **{_PINS[name]: level for name, level in levels[0].items()},
            "index_n": self._plant.index_level(self.positions[0]),
        }

    def straps(self, levels: int) -> None:
        self.set_pins(run=levels & 1, evt0_n=levels >> 1 & 1, evt1_n=levels >> 2 & 1)

    def pins(self) -> int:
        self._run_pending()
        resting = not self._moved or not self.part.outputs["cd_n"]
        return self.pin_byte(int(resting), 0)

    def reset(self) -> None:
        super().reset()
        self._moved = False

    def watched_register(self) -> object:
        return self.part.csr

    def _follow_outputs(self) -> None:
        super()._follow_outputs()
        index = self._plant.index_level(self.positions[0])
        if index != self.part.inputs["index_n"]:
            self.part.pins(self.part.now + 1, index_n=index)

    def _follow(self, edge: Edge) -> None:
        if edge.signal != "pout":
            super()._follow(edge)
            return
        ccw = self._directions[0]
        if not edge.value:
            self.part.pins(self.part.now + 1, epin=0)
        elif self._plant.steps(self.positions[0], ccw):
            self.counts[0] += -1 if ccw else 1
            self.positions[0] += -1 if ccw else 1
            self._moved = True
            self.part.pins(self.part.now + 1, epin=1, epdir=ccw)
        else:
            self.counts[0] += -1 if ccw else 1


# Prediction of one move of a PPMC-312 from its table: pulse times and speeds (P312-MOT-01, -10..12).


@dataclass(frozen=True)
class TableMove(Move):
    """Predicted move.

    A rate is the number of base clock periods of an interval; a base clock period is `divider` crystal
    periods. An index is a stage of the table, `None` at constant speed.

    Attributes:
        kind: status bits in the response to the start instruction.
    """

    divider: int
    kind: int

    @property
    def speeds(self) -> list[float]:
        return [self.timebase.xtal_hz / (self.divider * rate) for rate in self.rates]


def predict_table(
    table: Table, n: int, rate: int = 0, flat: bool = False, timebase: Timebase | None = None
) -> TableMove:
    """Return the prediction of an undisturbed move of n pulses with an internal base clock.

    Args:
        rate: target speed, 0 for the high speed.
        flat: True for a move at constant speed (instruction 83).

    Raises:
        ValueError: the base clock is external, the rate is outside the table, or n is outside 1..2^32-1.
    """
    timebase = timebase or Timebase()
    if table.clk not in DIVIDERS:
        raise ValueError("the base clock comes from outside")
    rate = rate or table.high
    if not table.contains(rate):
        raise ValueError(f"rate {rate} is outside {table.high} to {table.slowest}")
    if not 1 <= n < 1 << 32:
        raise ValueError(f"{n} pulses")
    plan = constant(table, rate, n) if flat else ramped(table, rate, n)
    steps = plan.steps()
    divider = DIVIDERS[table.clk]
    ticks = accumulate((step.rate for step in steps[:-1]), initial=0)
    return TableMove(
        timebase,
        tuple(timebase.cyc(divider * t) for t in ticks),
        tuple(step.stage for step in steps[:-1]),
        tuple(step.rate for step in steps[:-1]),
        divider,
        plan.kind,
    )


def predict_setting(
    parameters: bytes, n: int, rate: int | None = None, timebase: Timebase | None = None
) -> TableMove:
    """Return the prediction of a move for an initial setting.

    Args:
        parameters: 8 or 13 bytes after the code of the setting.
        rate: rate of a move at constant speed, `None` for a move with ramps.

    Raises:
        ValueError: the part would reject the setting or the move.
    """
    if len(parameters) not in (8, 13):
        raise ValueError(f"an initial setting has 8 or 13 parameters, not {len(parameters)}")
    flags, separate = parameters[0], bool(parameters[0] & LE)
    widths = (2, 2, 2, 3, 3) if len(parameters) == 13 else (2, 2, 3)
    values, at = [], 1
    for width in widths:
        values.append(int.from_bytes(parameters[at : at + width], "big"))
        at += width
    if len(values) == 3:
        if separate:
            raise ValueError("a separate deceleration needs 13 parameters")
        start, high, na = values
        stop, nd = start, na
    else:
        start, stop, high, na, nd = values
    try:
        table = build(start, stop, high, na, nd, flags & 7, bool(flags & FO), separate)
    except SettingError as error:
        raise ValueError(f"refused setting: {error}") from None
    return predict_table(table, n, rate or 0, rate is not None, timebase)


def predict(
    init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
) -> TableMove:
    """Return the prediction of a move; see `single.predict.predict_move`.

    csel and vsel are ignored, because the part has no such pins.
    """
    return predict_setting(init, n, rate, timebase)
