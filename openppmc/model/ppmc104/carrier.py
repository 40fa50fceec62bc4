"""The modelled carrier with a PPMC-104."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..carrier import carrier
from ..carrier.plant import SWITCHES, Plant
from .part import Ppmc104

_PINS = dict(zip(SWITCHES, ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n"), strict=True))


class Carrier(carrier.Carrier[Ppmc104]):
    """Wired as ppmc104_carrier: straps bit 0 is csel, bit 1 vsel."""

    def __init__(
        self,
        plant: Plant,
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        timing: str = "FAST",
        on_interrupt: Callable[[], None] = lambda: None,
    ) -> None:
        super().__init__(Ppmc104(clk_hz, xtal_hz, timing), [plant], on_interrupt)

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        return {_PINS[name]: level for name, level in levels[0].items()}

    def straps(self, levels: int) -> None:
        self.set_pins(csel=levels & 1, vsel=levels >> 1 & 1)

    def shown(self) -> object:
        return self.part.status

    def pins(self) -> int:
        self._settle()
        return self.pin_byte(self.part.outputs["hold"], 0)
