"""The modelled carrier with a PPMC-312 and a motor with an encoder."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..carrier import carrier
from ..carrier.plant import SWITCHES, Plant
from ..common.edges import Edge
from .part import Ppmc312

_PINS = dict(zip(SWITCHES, ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n"), strict=True))


class Carrier(carrier.Carrier[Ppmc312]):
    """Wired as ppmc312_carrier: straps bit 0 is RUN, bits 1 and 2 are the event inputs 1 and 2.

    The encoder gives a pulse for each one that the axle follows; the drive says END at once. `positions` is
    the axle's, the part itself counts pulses.
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
        """part: one that has been made already, instead of these figures."""
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
        self._settle()
        resting = not self._moved or not self.part.outputs["cd_n"]
        return self.pin_byte(int(resting), 0)

    def reset(self) -> None:
        super().reset()
        self._moved = False

    def shown(self) -> object:
        return self.part.csr

    def _watch(self) -> None:
        super()._watch()
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
