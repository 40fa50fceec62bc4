"""UART host that sends scripts to a board top in a simulation and receives answers."""

from __future__ import annotations

from typing import Any

from cocotb.triggers import Event, First, Timer

from cocotb_tests.harness.line import UartBfm
from openppmc.host.frames import REQUEST_LIMIT, Broken, Deframer, Frame, encode
from openppmc.host.script import Answer, Script, parse_answer


class Uart(UartBfm):
    """Serial line on `uart_rxd` (to the board) and `uart_txd`.

    `frames` contains the received frames, oldest first.
    """

    def __init__(self, dut: Any, rate: int = 115_200) -> None:
        super().__init__(dut.uart_rxd, dut.uart_txd, rate)
        self.frames: list[Frame | Broken] = []
        self._deframer = Deframer()
        self._received = Event()
        self._seq = 0

    def on_char(self, byte: int) -> None:
        """Add a received byte and collect the complete frames."""
        self.frames += self._deframer.feed(bytes([byte]))
        self._received.set()

    async def frame(self, limit_us: int = 200_000) -> Frame:
        """Return the next frame.

        Raise AssertionError if the frame is invalid or does not arrive within the time limit.
        """
        limit = Timer(limit_us, "us")
        while not self.frames:
            self._received.clear()
            if await First(self._received.wait(), limit) is limit:
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
