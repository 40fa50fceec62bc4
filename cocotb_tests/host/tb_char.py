"""Contract of ppmc_char_host (docs/char_host.md)."""

from __future__ import annotations

from typing import Any

import cocotb

from ..harness import Block, BlockDriver, rng, same

GROUPS = ("common", "host", "char_host")
CLK_HZ, XTAL_HZ, BAUD, PART = 4_000_000, 16_000_000, 100_000, 0x1234
BIT = CLK_HZ // BAUD
BLOCKS = {
    "char": Block(
        "ppmc_char_host",
        "rxd_i txd_o cs_no rd_no wr_no a_o:4 d_o:8 d_i:8 part_rst_no straps_o:7 pins_i:8 active_o",
        {"ClkHz": CLK_HZ, "XtalHz": XTAL_HZ, "Baud": BAUD, "Part": PART, "Datasheet": 1},
    ),
}
FIRST, WRITE, OWN = 0x80, 0x40, 0x20
STROBE = 8
INFO = b"C\x01" + PART.to_bytes(2, "little") + b"\x01" + XTAL_HZ.to_bytes(4, "little")
INFO += CLK_HZ.to_bytes(4, "little") + bytes(2)
OUTPUTS = ("cs_no", "rd_no", "wr_no", "a_o", "d_o")


class Line:
    """The PC at the line, and the device at the bus of the block.

    `accesses` contains (kind, address, byte) of each strobe. A read strobe returns a random byte, which the
    device holds until the next read strobe.
    """

    def __init__(self, dut: Any) -> None:
        self.unit = BlockDriver(dut, "char", BLOCKS)
        self.rand = rng()
        self.accesses: list[tuple[str, int, int]] = []
        self.answers: list[int] = []
        self._before = (1, 1, 1, 0, 0)
        self._low = 0
        self._held = 0
        self._bits: list[int] = []
        self._wait = 0

    async def reset(self) -> None:
        """Reset the block, and keep the line idle for 4 bit times."""
        await self.unit.reset(rxd_i=1, d_i=0, pins_i=0xFF)
        await self.clk(4 * BIT)

    async def clk(self, cycles: int) -> None:
        """Run cycles, and record strobes and characters."""
        for _ in range(cycles):
            await self.unit.clk()
            self._bus()
            self._receive()

    def _bus(self) -> None:
        now = tuple(self.unit.get(name) for name in OUTPUTS)
        cs_n, rd_n, wr_n, address, data = now
        assert cs_n == (rd_n and wr_n) and (rd_n or wr_n), f"pins {now}: cs_n and one strobe"
        if not cs_n:
            # The pins are also stable in the cycle before the strobe and in the cycle after it.
            assert self._before[3:] == now[3:], f"address or data changed: {self._before}, {now}"
            if self._low == 0 and not rd_n:
                self._held = self.rand.getrandbits(8)
                self.unit.put(d_i=self._held)
            self._low += 1
        elif self._low:
            same("cycles of the strobe", self._low, STROBE)
            assert self._before[3:] == now[3:], f"address or data changed: {self._before}, {now}"
            kind = "w" if not self._before[2] else "r"
            self.accesses.append((kind, address, data if kind == "w" else self._held))
            self._low = 0
        self._before = now

    def _receive(self) -> None:
        """Sample txd in the middle of each bit."""
        level = self.unit.get("txd_o")
        if not self._bits and not self._wait:
            self._wait = 0 if level else BIT // 2
            return
        self._wait -= 1
        if self._wait:
            return
        self._bits.append(level)
        self._wait = BIT
        if len(self._bits) == 10:
            same("start and stop bit", (self._bits[0], self._bits[9]), (0, 1))
            self.answers.append(sum(bit << n for n, bit in enumerate(self._bits[1:9])))
            self._bits, self._wait = [], 0

    async def send(self, byte: int, stop: int = 1, rate: float = 1.0) -> None:
        """Send one character; `rate` is the rate of the PC relative to BAUD."""
        done = 0
        for n, bit in enumerate([0, *(byte >> n & 1 for n in range(8)), stop], 1):
            self.unit.put(rxd_i=bit)
            end = round(n * BIT / rate)
            await self.clk(end - done)
            done = end
        self.unit.put(rxd_i=1)

    async def ask(self, *request: int, rate: float = 1.0) -> int:
        """Send a request and return its answer, which must be a single character."""
        for byte in request:
            await self.send(byte, rate=rate)
        await self.clk(11 * BIT)
        (answer,) = self.answers
        self.answers.clear()
        return answer

    async def quiet(self, why: str) -> None:
        """Check that there is no access and no answer."""
        await self.clk(12 * BIT)
        same(why, (self.accesses, self.answers), ([], []))


async def start(dut: Any) -> Line:
    """Return the line of a block that was reset."""
    line = Line(dut)
    await line.reset()
    return line


def write_request(head: int, byte: int) -> tuple[int, int]:
    """Return the characters of a write."""
    return FIRST | WRITE | head | byte >> 7, byte & 0x7F


@cocotb.test()
async def char_accesses(dut):
    """Each read or write causes one strobe with its address and data. The answer to a read is the byte of the
    device; the answer to a write is the written byte. Characters that are sent 2 % too slow or too fast are
    received correctly.
    """
    line = await start(dut)
    for n in range(60):
        address, byte = line.rand.randrange(16), line.rand.getrandbits(8)
        rate = (1.0, 0.98, 1.02)[n % 3]
        if line.rand.random() < 0.5:
            got = await line.ask(*write_request(address << 1, byte), rate=rate)
            same("echo", got, byte)
            same("access", line.accesses, [("w", address, byte)])
        else:
            got = await line.ask(FIRST | address << 1 | n & 1, rate=rate)
            same("access", line.accesses, [("r", address, got)])
        line.accesses.clear()
    same("the block is idle", line.unit.get("active_o"), 0)


@cocotb.test()
async def char_own_bytes(dut):
    """The info bytes state the parameters of the block, byte 15 returns the pins, and a write to the block
    itself sets the straps and the reset of the device. None of these requests causes a strobe.
    """
    line = await start(dut)
    same("info", bytes([await line.ask(FIRST | OWN | n << 1) for n in range(15)]), INFO)
    for level in (0x00, 0xA5, 0x5A, 0xFF):
        line.unit.put(pins_i=level)
        same("pins", await line.ask(FIRST | OWN | 15 << 1), level)
    same("after reset", (line.unit.get("part_rst_no"), line.unit.get("straps_o")), (1, 0x7F))
    for byte in (0x80, 0x55, 0x2A, 0xFF, 0x00, 0xAA):
        same("echo", await line.ask(*write_request(OWN, byte)), byte)
        control = (line.unit.get("part_rst_no"), line.unit.get("straps_o"))
        same("control byte", control, (byte >> 7, byte & 0x7F))
    same("strobes", line.accesses, [])


@cocotb.test()
async def char_damaged(dut):
    """A second character without a first one is ignored. A first character replaces an incomplete write. A
    character with a low stop bit is ignored, and an incomplete write before it is discarded.
    """
    line = await start(dut)
    await line.send(0x12)
    await line.quiet("second character alone")
    head, low = write_request(3 << 1, 0xC5)
    await line.send(head)
    same("the read replaces the write", await line.ask(FIRST | 2 << 1), line.accesses[0][2])
    same("access", line.accesses[0][:2], ("r", 2))
    line.accesses.clear()
    await line.send(low)
    await line.quiet("the write was replaced")
    await line.send(head)
    await line.send(low, stop=0)
    await line.clk(2 * BIT)
    await line.send(low)
    await line.quiet("the damaged character ended the write")
    await line.send(FIRST, stop=0)
    await line.quiet("damaged first character")
    same("echo", await line.ask(head, low), 0xC5)
    same("access", line.accesses, [("w", 3, 0xC5)])


@cocotb.test()
async def char_active(dut):
    """active_o is high from the end of an access to the end of its answer."""
    line = await start(dut)
    same("idle", line.unit.get("active_o"), 0)
    await line.send(FIRST | OWN)
    # The block answers in the middle of the stop bit of the request, so half of its start bit has been sent.
    for _ in range(9 * BIT + BIT // 2 - 4):
        same("during the answer", line.unit.get("active_o"), 1)
        await line.clk(1)
    await line.clk(12)
    same("after the answer", line.unit.get("active_o"), 0)
