"""Wishbone B4 master for classic cycles; it checks in each cycle that no response occurs without a
request.
"""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import RisingEdge


class WishboneMaster:
    """Master at the pins `<prefix>_*`. `clk` counts rising edges; `latency` is that of the last response.

    The latency is the number of cycles from the first edge that samples STB to the edge that samples the
    response.
    """

    TIMEOUT = 200

    def __init__(self, dut: Any, prefix: str) -> None:
        names = ("cyc", "stb", "we", "adr", "sel", "datwr", "datrd", "ack", "err")
        self._pins = {name: getattr(dut, f"{prefix}_{name}") for name in names}
        self._edge = RisingEdge(dut.clk)
        self.clk, self.latency = 0, 0
        self.idle()
        self._task = cocotb.start_soon(self._watch())

    async def _watch(self) -> None:
        before = 0
        while True:
            await self._edge
            self.clk += 1
            ack, err, stb = (int(self._pins[name].value) for name in ("ack", "err", "stb"))
            stb &= int(self._pins["cyc"].value)
            assert not (ack and err), f"cycle {self.clk}: ACK and ERR"
            assert stb or not (ack or err), f"cycle {self.clk}: answer without CYC and STB"
            assert not (before and (ack or err)), f"cycle {self.clk}: answer longer than one cycle"
            before = ack or err

    def _put(self, **levels: int) -> None:
        for name, level in levels.items():
            self._pins[name].value = level

    def idle(self) -> None:
        """End the bus cycle."""
        self._put(cyc=0, stb=0, we=0, adr=0, sel=0, datwr=0)

    async def clocks(self, n: int) -> None:
        """Wait n rising edges."""
        for _ in range(n):
            await self._edge

    def _offer(self, address: int, value: int | None, sel: int) -> None:
        self._put(cyc=1, stb=1, we=int(value is not None), adr=address >> 2, sel=sel, datwr=value or 0)

    async def access(
        self, address: int, value: int | None = None, sel: int = 0xF, keep: bool = False
    ) -> tuple[bool, int]:
        """Make one bus cycle at a byte address: a read, or a write of `value`; return (ok, data).

        Raises AssertionError if no response occurs.

        Args:
            keep: leave CYC and STB high for another access directly after this one.
        """
        self._offer(address, value, sel)
        for waited in range(self.TIMEOUT):
            await self._edge
            if self._task.done():
                self._task.result()
            ack, err = int(self._pins["ack"].value), int(self._pins["err"].value)
            if ack or err:
                self.latency = waited
                data = int(self._pins["datrd"].value)
                if not keep:
                    self.idle()
                return bool(ack), data
        raise AssertionError(f"no answer for {self.TIMEOUT} cycles at address {address:#x}")

    async def give_up(self, address: int, value: int | None, after: int) -> bool:
        """Request an access and withdraw the request after `after` cycles (at least 1).

        Return True if a response occurred before.
        """
        self._offer(address, value, 0xF)
        for _ in range(after):
            await self._edge
            if int(self._pins["ack"].value) or int(self._pins["err"].value):
                self.idle()
                return True
        self.idle()
        return False
