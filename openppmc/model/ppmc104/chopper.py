"""Switching times of the PPMC-104 (P104-SW-04, -05, P104-AUX-03)."""

from __future__ import annotations

from ..common.blocks import Context

DEFAULT_QUANTA = (260, 435)


class Switching:
    """Default times until the first 0x84, then its two values, stretched by vsel = L."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._parameters: tuple[int, int] | None = None

    def set(self, p_on: int, p_off: int) -> None:
        """0x84: both values, 0..255, used from the next phase boundary on (P104-AUX-03)."""
        self._parameters = (p_on, p_off)

    def quanta(self, on: bool) -> int:
        """Length of a phase that begins now (P104-SW-04, -05)."""
        if self._parameters is None:
            return DEFAULT_QUANTA[0 if on else 1]
        plain = self._context.levels["vsel"]
        p_on, p_off = self._parameters
        if on:
            return 12 * p_on + (108 if plain else 100)
        return 12 * p_off + (132 if plain else 115)
