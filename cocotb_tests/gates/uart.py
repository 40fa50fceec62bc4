"""The PC's side of the UART line in a simulation: bytes out and frames in, at any rate."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import Event, FallingEdge, First, Timer

from openppmc.host.frames import REQUEST_LIMIT, Broken, Deframer, Frame, encode
from openppmc.host.script import Answer, Script, parse_answer

BITS = 8


class Uart:
    """8N1 on `uart_rxd` (to the board) and `uart_txd` (from it).

    `rate` in baud may be changed between frames. `frames` holds what came, oldest first.
    """

    def __init__(self, dut: Any, rate: int = 115_200) -> None:
        self.rate = rate
        self.frames: list[Frame | Broken] = []
        self._out, self._in = dut.uart_rxd, dut.uart_txd
        self._deframer = Deframer()
        self._came = Event()
        self._seq = 0
        self._out.value = 1

    def listen(self) -> None:
        """Begin to receive; after the reset, when uart_txd is idle."""
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
            assert int(self._in.value) == 1, f"uart_txd is low in the stop bit of {byte:#04x}"
            self.frames += self._deframer.feed(bytes([byte]))
            self._came.set()

    async def frame(self, limit_us: int = 200_000) -> Frame:
        """The next frame; AssertionError if it is broken or none comes within the limit."""
        limit = Timer(limit_us, "us")
        while not self.frames:
            self._came.clear()
            if await First(self._came.wait(), limit) is limit:
                raise AssertionError(f"no frame within {limit_us} us")
        frame = self.frames.pop(0)
        assert isinstance(frame, Frame), f"broken frame from the board: {frame}"
        return frame

    async def ask(self, script: Script) -> Answer:
        """Send a script and return its answer, which must be the next frame."""
        seq, self._seq = self._seq, self._seq % 127 + 1
        await self.send(encode(bytes([seq]) + bytes(script), REQUEST_LIMIT))
        frame = await self.frame()
        assert frame.seq == seq, f"answer to {frame.seq} instead of {seq}"
        return parse_answer(script, frame.payload[1:])
