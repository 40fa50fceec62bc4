"""`BlockHost`: a host on the block registers of the PPMC-312, on a bench.

Blocks and answers are texts of hexadecimal bytes in logical order: header, length, code, parameters.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from .bench import Bench
from .bus import HostBus

CSR, RCR, WCR, RAR, WAR, DWR, DRR = 0, 2, 2, 3, 3, 5, 7
MWEF, MREF = 0x08, 0x04
ARMED, WINDOW = 0x20, 0x20

_WRITES = {CSR: "CSR :=", WCR: "WCR :=", WAR: "WAR :=", DWR: "DWR :="}
_READS = {CSR: "CSR read", RCR: "RCR read", RAR: "RAR read", DRR: "DRR read"}
NAMES = {("write", reg): name for reg, name in _WRITES.items()}
NAMES |= {("read", reg): name for reg, name in _READS.items()}
"""What a list of accesses calls them."""


def clean(text: str) -> str:
    """Bytes as answers show them: upper case, one blank between two."""
    return bytes.fromhex(text).hex(" ").upper()


class BlockHost(HostBus):
    """strobe, read_strobe, gap, pause, timeout: as of `HostBus` (P312-PAR-10 needs strobes of 3 clk).

    `header` is the edge that ended the header strobe of the last block.
    """

    names: Mapping[tuple[str, int], str] = NAMES

    def __init__(
        self,
        bench: Bench,
        strobe: int = 3,
        read_strobe: int = 5,
        gap: int = 3,
        pause: Callable[[], int] | None = None,
        timeout: int = 4_000_000,
    ) -> None:
        super().__init__(bench, strobe, read_strobe, gap, pause, timeout)
        self.header = 0

    async def status(self) -> int:
        """CSR."""
        return await self.read(CSR)

    async def put(self, text: str, war: int | None = None) -> int:
        """Write a block, whatever MWEF says; returns the edge that ends the header strobe.

        war: what WAR gets instead of the address that fits.
        """
        block = bytes.fromhex(text)[::-1]
        await self.write(WCR, ARMED)
        await self.write(WAR, WINDOW - len(block) if war is None else war)
        for byte in block:
            self.header = await self.write(DWR, byte)
        return self.header

    async def issue(self, text: str) -> int:
        """Wait for MWEF = 0 and write a block; returns the edge that ends the header strobe."""
        await self.poll(MWEF, 0)
        return await self.put(text)

    async def response(self, timeout: int | None = None) -> str:
        """Wait for MREF = 0 and read the next block. Raises TimeoutError."""
        await self.poll(MREF, 0, timeout)
        count = 0x40 - await self.read(RAR)
        data = [await self.read(DRR) for _ in range(count)]
        return clean(bytes(data[::-1]).hex())

    async def ask(self, text: str) -> str:
        """Write a block and read one response."""
        await self.issue(text)
        return await self.response()
