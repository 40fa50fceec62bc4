"""The PC's side of a UART line in a simulation, character by character, at any rate."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, Timer

BITS = 8


class Wire:
    """8N1: `rxd` is the pin that the board listens to, `txd` the one it speaks on.

    `rate` in baud may be changed between characters.
    """

    def __init__(self, rxd: Any, txd: Any, rate: float) -> None:
        self.rate = rate
        self._out, self._in = rxd, txd
        self._out.value = 1

    def listen(self) -> None:
        """Begin to receive; after the reset, when txd is idle."""
        cocotb.start_soon(self._receive())

    def _time(self, bits: float) -> Timer:
        return Timer(round(bits * 1e12 / self.rate), "ps")

    async def send(self, data: bytes) -> None:
        """Send bytes back to back."""
        for byte in data:
            # One word with start and stop bit, least significant bit first.
            word = 1 << BITS + 1 | byte << 1
            for bit in range(BITS + 2):
                self._out.value = word >> bit & 1
                await self._time(1)

    async def _receive(self) -> None:
        while True:
            await FallingEdge(self._in)
            await self._time(0.5)
            if self._in.value != 0:
                continue
            byte = 0
            for bit in range(BITS):
                await self._time(1)
                byte |= int(self._in.value) << bit
            await self._time(1)
            assert int(self._in.value) == 1, f"the line is low in the stop bit of {byte:#04x}"
            self.came(byte)

    def came(self, byte: int) -> None:
        """What to do with a character, in the middle of its stop bit."""
        raise NotImplementedError
