"""Carrier model with a bank. The bridge accesses the window of one axis at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..carrier import carrier
from ..carrier.carrier import SWITCHES, Plant
from .part import PpmcBank

SELECT = 0x3
WINDOW_AXES = 64
ADDRESS_AHEAD = 2
"""Number of cycles from the change of the address to the start of the strobe (BANK-WIN-04)."""
_PINS = dict(zip(SWITCHES, ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n"), strict=True))


class Carrier(carrier.Carrier[PpmcBank]):
    """Carrier with the connections of ppmc_bank_carrier; each axis has a plant.

    Register 3 of the bridge holds the number of the selected axis (from 0; read and write). All other
    registers belong to the selected axis. PINS returns int_n, and the pin HOLD and the switches of the
    selected axis. The carrier has no straps, and no pulse counters, because the bank itself counts pulses.
    """

    ADDRESS_BITS = 10

    def __init__(
        self,
        plants: Sequence[Plant],
        clk_hz: int = 16_000_000,
        xtal_hz: int = 16_000_000,
        on_interrupt: Callable[[], None] = lambda: None,
    ) -> None:
        self._selected = 0
        super().__init__(PpmcBank(len(plants), clk_hz, xtal_hz), plants, on_interrupt)

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        return {pin: sum(of[name] << axis for axis, of in enumerate(levels)) for name, pin in _PINS.items()}

    def straps(self, levels: int) -> None:
        """Ignore the levels, because the carrier has no straps."""

    def watched_register(self) -> object:
        return self.part.status(self._selected) if self._selected < len(self.plants) else 0xFF

    def pins(self) -> int:
        self._run_pending()
        axis = self._selected % len(self.plants)
        return self.pin_byte(self.part.outputs["hold"] >> axis & 1, axis)

    # ------------------------------------------------------------------ window

    def read(self, a: int) -> int:
        if a == SELECT:
            return self._selected
        return super().read(self._address(a)) if self._selected < WINDOW_AXES else 0xFF

    def write(self, a: int, byte: int) -> None:
        if a == SELECT:
            self._selected = byte
        elif self._selected < WINDOW_AXES:
            super().write(self._address(a), byte)

    def _address(self, a: int) -> int:
        """Drive the address of register `a` of the selected axis before the strobe; return this address."""
        address = self._selected << 4 | a
        self.set_pins(a=address)
        self.t += ADDRESS_AHEAD - 1
        return address

    def reset(self) -> None:
        super().reset()
        self._selected = 0
