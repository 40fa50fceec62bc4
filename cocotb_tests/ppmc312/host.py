"""Host of directed tests on the parallel pins of the PPMC-312. Its next accesses depend on the values that it
has read.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import DutBench, start_bench
from cocotb_tests.harness.bus import CSR, DRR, DWR, MREF, MWEF, NAMES, RAR, WAR, WCR, clean
from openppmc.check.records import Access

from .bench import PPMC312
from .directed_host import DirectedHost

LATE = 10_000
"""Maximum number of cycles by which a response may follow that of the golden model."""


class Host(DirectedHost):
    """Host on the bus. Blocks and answers are texts of hexadecimal bytes in logical order.

    `header` is the edge at which the last strobe of the last block ended.
    """

    def __init__(self, bench: DutBench) -> None:
        super().__init__(bench)
        self.mark = self.t
        self.header = 0

    @classmethod
    async def start(cls, dut: Any, *setting: str, **pins: int) -> Host:
        """Reset a part with these pin levels, wait until it accepts blocks, and send each block of
        `setting`.
        """
        host = cls(await start_bench(dut, PPMC312, settle=8, **pins))
        host.mark = 0
        await host.ready(100)
        for block in setting:
            await host.ask(block)
        return host

    # ------------------------------------------------------------------ bus

    async def write(self, reg: int, byte: int, gap: int = 3) -> int:
        """Write one byte with a strobe of 3 cycles, then wait `gap` cycles; return the edge at the end of the
        strobe.
        """
        bench = self.bench
        bench.set(cs_n=0, we_n=0, rs=reg, d_i=byte)
        await bench.clocks(3)
        edge = bench.set(cs_n=1, we_n=1)
        bench.accesses.append(Access(edge, NAMES.get(("write", reg), "write"), reg, byte))
        await bench.clocks(gap)
        return edge

    async def read(self, reg: int) -> int:
        """Read one byte: return d_o at the end of a strobe of 5 cycles, then wait 3 cycles."""
        bench = self.bench
        edge = bench.set(cs_n=0, oe_n=0, rs=reg)
        await bench.clocks(5)
        value = bench.level("d_o")
        bench.accesses.append(Access(edge, NAMES.get(("read", reg), "read"), reg, value))
        bench.set(cs_n=1, oe_n=1)
        await bench.clocks(3 + bench.slack)
        return value

    async def strobe(self, length: int, gap: int = 3, **levels: int) -> None:
        """Drive any levels on the bus pins for `length` cycles, then deassert the strobes for `gap`
        cycles.
        """
        self.bench.set(**levels)
        await self.bench.clocks(length)
        self.bench.set(cs_n=1, we_n=1, oe_n=1)
        await self.bench.clocks(gap)

    async def put(self, text: str, war: int | None = None, gap: int = 3) -> None:
        """Write a block without polling, then wait `gap` cycles after its last strobe."""
        block = bytes.fromhex(text)[::-1]
        await self.write(WCR, 0x20)
        await self.write(WAR, 0x20 - len(block) if war is None else war)
        for byte in block[:-1]:
            await self.write(DWR, byte)
        self.header = await self.write(DWR, block[-1], gap)

    async def ready(self, every: int = 20, limit: int = 10_000_000) -> None:
        """Wait until MWEF = 0; poll every `every` cycles."""
        end = self.t + limit
        while await self.read(CSR) & MWEF:
            assert self.t < end, f"no block is taken any more\n{self.bench.context()}"
            await self.pause(every)

    async def issue(self, text: str) -> None:
        """Write a block when MWEF allows it; pulses and edges are counted from this write on."""
        await self.ready()
        self.mark = self.t
        await self.put(text)

    async def response(self, limit: int = 100_000_000) -> str:
        """Wait for the next response block and return it."""
        await self.wait(limit)
        count = 0x40 - await self.read(RAR)
        assert count > 0, f"a response without a byte\n{self.bench.context()}"
        block = bytes([await self.read(DRR) for _ in range(count)])[::-1]
        return clean(block.hex())

    async def wait(self, limit: int = 100_000_000) -> None:
        """Wait until MREF = 0, for at most `limit` cycles.

        The host polls CSR only after the golden model has a response.
        """
        end = self.t + limit
        late = self.t + LATE
        while await self.read(CSR) & MREF:
            assert self.t < late, (
                f"no response comes, though the golden model has one\n{self.bench.context()}"
            )
            if not self.bench.golden.core.responses.any_waiting:
                await self.arrival(end)
                late = self.t + LATE

    async def arrival(self, end: int | None = None) -> None:
        """Wait until the golden model has a response, at the latest until edge `end`, without polling the
        device.
        """
        while not self.bench.golden.core.responses.any_waiting:
            assert end is None or self.t < end, f"no response comes any more\n{self.bench.context()}"
            await self.step()

    async def ask(self, text: str) -> str:
        """Issue a block and read one response."""
        await self.issue(text)
        return await self.response()

    async def quiet(self, clk: int = 5000) -> bool:
        """Return whether no response arrives within this number of cycles."""
        await self.pause(clk)
        return bool(await self.read(CSR) & MREF)
