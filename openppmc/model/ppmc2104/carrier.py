"""The modelled carrier with a PPMC-2104."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..carrier import carrier
from ..carrier.plant import SWITCHES, Plant
from .part import Ppmc2104

_PINS = dict(zip(SWITCHES, ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n"), strict=True))


class Carrier(carrier.Carrier[Ppmc2104]):
    """Wired as ppmc2104_carrier: straps bits 1..0 are csel, 3..2 run, 4 errint_n; bit 7 chooses the pins in
    PINS, 1 for those of axis 1."""

    def __init__(
        self,
        plants: Sequence[Plant],
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        on_interrupt: Callable[[], None] = lambda: None,
    ) -> None:
        self._shown = 0
        super().__init__(Ppmc2104(clk_hz, xtal_hz, timing), plants, on_interrupt)

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        first, second = levels
        return {pin: first[name] | second[name] << 1 for name, pin in _PINS.items()}

    def straps(self, levels: int) -> None:
        self._shown = int(not levels & 0x80)
        self.set_pins(csel=levels & 3, run=levels >> 2 & 3, errint_n=levels >> 4 & 1)

    def shown(self) -> object:
        return self.part.status

    def pins(self) -> int:
        self._settle()
        return self.pin_byte(self.part.outputs["hold"] >> self._shown & 1, self._shown)
