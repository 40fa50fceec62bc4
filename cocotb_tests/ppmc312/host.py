"""A polling host on the parallel pins of the PPMC-312: scripts for the golden model, taped for the RTL."""

from __future__ import annotations

from cocotb_tests.harness.block_host import CSR, DRR, DWR, MREF, MWEF, NAMES, RAR, RCR, WAR, WCR, clean
from cocotb_tests.harness.stimulus import Access
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import Code

from .script_host import TICK, Script

__all__ = [
    "CSR",
    "DRR",
    "DWR",
    "MREF",
    "MWEF",
    "RAR",
    "RATES",
    "RCR",
    "T1",
    "T2",
    "T3",
    "T4",
    "TF",
    "TG",
    "TH",
    "TICK",
    "WAR",
    "WCR",
    "Host",
    "clean",
]

T1 = message(Code.INITIAL, "01 03E8 00C8 0007D0")
T2 = message(Code.INITIAL, "09 03E8 00C8 0007D0")
T3 = message(Code.INITIAL, "11 03E8 01F4 00C8 0007D0 0005DC")
T4 = message(Code.INITIAL, "11 01F4 03E8 00C8 0005DC 0007D0")
RATES = "00 06 0064 00C8 0190"
TF = ("02 03 01 01 03", RATES, "01 09 000005 000004 000003")
TG = ("02 04 01 11 03 02", RATES, "00 09 000005 000004 000003", "01 06 000006 000004")
TH = ("02 04 01 11 02 03", RATES, "00 06 000006 000004", "01 09 000005 000004 000003")


class Host(Script):
    """The host on the parallel bus. Blocks and answers are texts of hexadecimal bytes in logical order."""

    def __init__(self, *setting: str, **parameters: object) -> None:
        super().__init__(**parameters)
        self.t = 8
        self.header = 0
        while self.read(CSR) & MWEF:
            self.t += 100
        for block in setting:
            self.ask(block)

    @classmethod
    def on(cls, other: Script) -> Host:
        """The bus of a part that another host has had so far."""
        host = cls.__new__(cls)
        host.model, host.tape, host.t, host.mark, host.header = other.model, other.tape, other.t, other.t, 0
        return host

    # ------------------------------------------------------------------ bus

    def write(self, reg: int, byte: int) -> None:
        """One write cycle of 3 clk."""
        edge = self.model.write(self.t, reg, byte, 3)
        self.tape.accesses.append(Access(edge, NAMES.get(("write", reg), "write"), reg, byte))
        self.t = edge + 3

    def read(self, reg: int) -> int:
        """One read cycle."""
        value = self.model.read(self.t, reg, 5)
        self.tape.accesses.append(Access(self.t, NAMES.get(("read", reg), "read"), reg, value))
        self.t += 8
        return value

    def put(self, text: str, war: int | None = None) -> None:
        """Write a block and no more; `header` is the edge that ends the last strobe."""
        block = bytes.fromhex(text)[::-1]
        self.write(WCR, 0x20)
        self.write(WAR, 0x20 - len(block) if war is None else war)
        for byte in block:
            self.write(DWR, byte)
        self.header = self.t - 3

    def issue(self, text: str) -> None:
        """Write a block when MWEF allows it; pulses and edges count from here."""
        while self.read(CSR) & MWEF:
            self.t += 20
        self.mark = self.t
        self.put(text)

    def response(self, limit: int = 100_000_000) -> str:
        """The next response block; time passes until there is one."""
        self.wait(limit)
        count = 0x40 - self.read(RAR)
        assert count > 0
        block = bytes(self.read(DRR) for _ in range(count))[::-1]
        self.sync()
        return clean(block.hex())

    def wait(self, limit: int = 100_000_000) -> None:
        """Until MREF = 0."""
        end = self.t + limit
        while self.read(CSR) & MREF:
            self.sync()
            while not self.model.core.responses.any_waiting:
                assert self.t < end, "no response comes any more"
                self.step()

    def ask(self, text: str) -> str:
        """Issue a block and read one response."""
        self.issue(text)
        return self.response()

    def quiet(self, clk: int = 5000) -> bool:
        """Whether no response comes for so long."""
        self.pause(clk)
        return bool(self.read(CSR) & MREF)
