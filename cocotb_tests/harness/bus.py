"""Hosts of directed tests: `HostBus` drives the A0/CS/RD/WR bus, `BlockHost` the registers of blocks.

Their base class `DutHost` works on a bench: it sets pins of the device and returns levels of outputs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from openppmc.check.records import Access

from .dut_bench import DutBench
from .part import BusStyle
from .rtl_bench import RtlBench


class DutHost:
    """A host that works on `bench`: the RTL or the golden model.

    Methods that count pulses or edges begin at edge `mark`.
    """

    def __init__(self, bench: DutBench) -> None:
        self.bench = bench
        self.mark = 0

    @property
    def t(self) -> int:
        """The next rising edge, which is the first to sample pins that change now."""
        return self.bench.now

    async def go(self, t: int) -> None:
        """Wait until just before edge t; raise ValueError if that edge has passed."""
        await self.bench.until(t)

    async def pause(self, clk: int) -> None:
        """Wait for a number of cycles."""
        await self.bench.clocks(clk)

    async def pins(self, **levels: int) -> None:
        """Set pin levels from the next edge on and return one cycle later."""
        self.bench.set(**levels)
        await self.bench.clocks(1)

    async def blip(self, pin: str, clk: int = 20, gap: int = 2000) -> None:
        """Drive a pin low for some cycles, then wait `gap` cycles for the processing of the pulse."""
        await self.pins(**{pin: 0})
        await self.pause(clk)
        await self.pins(**{pin: 1})
        await self.pause(gap)

    async def step(self) -> None:
        """Wait until the next event of the golden model is over: a useful moment for the next poll."""
        edge = self.bench.next_event
        assert edge is not None, f"the golden model has no further event\n{self.bench.context()}"
        await self.bench.until(max(self.t, edge + 1))

    def out(self, signal: str) -> int:
        """Return the present level of an output."""
        return self.bench.level(signal)


DATA = 0
STATUS = 1
COMMAND = 1

OBF, IBF, BUSY, ERR = 0x01, 0x02, 0x04, 0x80


class HostBus:
    """A bus host. `bench.accesses` contains all its accesses.

    Args:
        strobe, read_strobe, gap: lengths of write strobe, read strobe and pause after an access, in cycles
            (P104-BUS-03: at least 2, 4 and 2 in a synchronous bench).
        lead: number of cycles for which the address is valid before a strobe.
        base: number that is added to every register number.
        pause: function that is called before each access; it returns the number of extra idle cycles.
        timeout: limit of every poll in cycles.

    Attributes:
        names: (kind, register) -> name of the access in `bench.accesses`, for buses with more than two
            registers.
    """

    names: Mapping[tuple[str, int], str] = {}  # noqa: RUF012, never written

    def __init__(
        self,
        bench: DutBench,
        strobe: int = 2,
        read_strobe: int = 4,
        gap: int = 2,
        pause: Callable[[], int] | None = None,
        timeout: int = 1_000_000,
        lead: int = 0,
        base: int = 0,
    ) -> None:
        self.bench = bench
        self.strobe = strobe
        self.read_strobe = read_strobe
        self.gap = gap
        self.pause = pause
        self.timeout = timeout
        self.lead = lead
        self.base = base
        self._owner: str | None = None

    @property
    def style(self) -> BusStyle:
        """Levels of the strobe pins in the present bus style."""
        return self.bench.part.style(self.bench.pins)

    # ---------------------------------------------------------------- single accesses

    async def _begin(self, what: str) -> None:
        if self._owner:
            raise RuntimeError(f"HostBus: {what} started while {self._owner} is on the bus")
        self._owner = what
        await self.bench.align()
        if self.pause and (extra := self.pause()):
            await self.bench.clocks(extra)

    async def _address(self, reg: int) -> int:
        """Drive the address, if it must be valid before the strobe; return the address."""
        address = self.base + reg
        if self.lead:
            self.bench.set(**{self.style.address: address})
            await self.bench.clocks(self.lead)
        return address

    async def write(self, reg: int, byte: int, strobe: int | None = None, gap: int | None = None) -> int:
        """Perform one write access; return its edge 0, the first edge that samples WS false (P104-BUS-06).

        The write event is two edges after edge 0. The method returns after `gap` idle cycles.
        """
        await self._begin(f"write({reg}, {byte:#04x})")
        bench = self.bench
        style = self.style
        reg = await self._address(reg)
        bench.set(**{style.address: reg, "d_i": byte, **style.write_on})
        await bench.clocks(self.strobe if strobe is None else strobe)
        edge0 = bench.set(**style.write_off)
        bench.accesses.append(Access(edge0, self.names.get(("write", reg), "write"), reg, byte))
        await bench.clocks(self.gap if gap is None else gap)
        self._owner = None
        return edge0

    async def read(self, reg: int, strobe: int | None = None, gap: int | None = None) -> int:
        """Perform one read access; return d_o as it is at the end of the strobe.

        For strobes of 3 cycles and more, raises AssertionError if d_oe is not 1 at the end of the strobe.
        """
        await self._begin(f"read({reg})")
        bench = self.bench
        length = self.read_strobe if strobe is None else strobe
        style = self.style
        reg = await self._address(reg)
        edge0 = bench.set(**{style.address: reg, **style.read_on})
        await bench.clocks(length)
        byte = bench.level("d_o")
        assert length < 3 or bench.level("d_oe") == 1, (
            f"d_oe = 0 at the end of a read strobe of {length} cycles\n{bench.context()}"
        )
        bench.set(**style.read_off)
        bench.accesses.append(Access(edge0, self.names.get(("read", reg), "read"), reg, byte))
        await bench.clocks(self.gap if gap is None else gap)
        self._owner = None
        return byte

    async def raw(self, clocks: int, **levels: int) -> int:
        """Set any pin levels on the bus for some cycles (illegal accesses); return the stamp of the change.

        The levels remain until another call restores the idle levels.
        """
        stamp = self.bench.set(**levels)
        await self.bench.clocks(clocks)
        return stamp

    async def idle(self) -> None:
        """Deassert all strobes."""
        await self.bench.align()
        self.bench.set(**self.style.off)

    # ---------------------------------------------------------------- polled accesses

    async def status(self) -> int:
        """Read the status register once."""
        return await self.read(STATUS)

    async def poll(self, mask: int, value: int, timeout: int | None = None, dense: int = 16) -> int:
        """Read the status until (status & mask) == value; return the status that was read last.

        The first `dense` polls follow each other without a pause, later polls with increasing pauses (up to
        256 cycles). Raises TimeoutError.
        """
        bench = self.bench
        limit = self.timeout if timeout is None else timeout
        end, count, wait = bench.now + limit, 0, 4
        while True:
            status = await self.status()
            if status & mask == value:
                return status
            if bench.now > end:
                raise TimeoutError(
                    f"status {status:#04x}: bits {mask:#04x} did not become {value:#04x} "
                    f"within {limit} cycles\n{bench.context()}"
                )
            count += 1
            if count >= dense:
                wait = min(256, wait * 5 // 4 + 1)
                await bench.clocks(wait)

    async def command(self, code: int, poll: bool = True) -> int:
        """Write a command byte, poll until IBF = 0, and return the status that was read last.

        Without `poll`, return edge 0 of the write.
        """
        edge0 = await self.write(COMMAND, code)
        return await self.poll(IBF, 0) if poll else edge0

    async def data(self, byte: int, poll: bool = True) -> int:
        """Write a data byte, poll until IBF = 0, and return the status that was read last.

        Without `poll`, return edge 0 of the write.
        """
        edge0 = await self.write(DATA, byte)
        return await self.poll(IBF, 0) if poll else edge0

    async def read_data(self) -> int:
        """Wait for OBF = 1, then read the data register."""
        await self.poll(OBF, OBF)
        return await self.read(DATA)

    async def send(self, code: int | str, data: Iterable[int] = (), poll: bool = True) -> int:
        """Send a command (int, or hex text such as "0A") and its data; return the result of the last byte."""
        result = await self.command(int(code, 16) if isinstance(code, str) else code, poll)
        for byte in data:
            result = await self.data(byte, poll)
        return result

    async def fetch(self, code: int | str, count: int = 1) -> list[int]:
        """Send a read command, then read `count` data bytes, polling OBF = 1 before each."""
        await self.send(code)
        return [await self.read_data() for _ in range(count)]

    async def run(self, script: str) -> list[int]:
        """Run a script of the acceptance tables, such as "c 0A d 09 d 04 d 04 d 00" or "c 83 rrr".

        c XX and d XX are polled writes, r is a data read after OBF = 1, s is a status read. Returns the bytes
        of all r and s in order. Raises ValueError for any other word.
        """
        words, got, place = script.replace(";", " ").split(), [], 0
        while place < len(words):
            word = words[place]
            if word in ("c", "d"):
                byte = int(words[place + 1], 16)
                await (self.command(byte) if word == "c" else self.data(byte))
                place += 2
                continue
            if set(word) - {"r", "s"}:
                raise ValueError(f"script word {word!r} is none of c XX, d XX, r, s")
            for letter in word:
                got.append(await (self.read_data() if letter == "r" else self.status()))
            place += 1
        return got

    async def init(self, code: int, rl: int, rh: int, pa: int) -> int:
        """Send an initialisation command with its four data bytes; return the status after the last byte."""
        return await self.send(code, [rl, rh, pa & 0xFF, pa >> 8])

    async def move(self, code: int, n: int, rate: int | None = None) -> int:
        """Start operation 011 (`rate` None) or 100 (with `rate`) with n pulses, 1..2^24.

        Return the status after the last byte.
        """
        d = n - 1
        head = [] if rate is None else [rate]
        return await self.send(code, [*head, d & 0xFF, d >> 8 & 0xFF, d >> 16 & 0xFF])

    async def wait_idle(self, timeout: int | None = None, busy: int = BUSY) -> int:
        """Poll the status until all bits of the mask `busy` are 0 in it; return this last status."""
        return await self.poll(busy, 0, timeout)


CSR, RCR, WCR, RAR, WAR, DWR, DRR = 0, 2, 2, 3, 3, 5, 7
MWEF, MREF = 0x08, 0x04
ARMED, WINDOW = 0x20, 0x20

_WRITES = {CSR: "CSR :=", WCR: "WCR :=", WAR: "WAR :=", DWR: "DWR :="}
_READS = {CSR: "CSR read", RCR: "RCR read", RAR: "RAR read", DRR: "DRR read"}
NAMES = {("write", reg): name for reg, name in _WRITES.items()}
NAMES |= {("read", reg): name for reg, name in _READS.items()}
"""(kind of access, register) -> name of the access in a list of accesses."""


def clean(text: str) -> str:
    """Return bytes in the format of the responses: upper case, separated by single spaces."""
    return bytes.fromhex(text).hex(" ").upper()


class BlockHost(HostBus):
    """A host of the block registers (CSR, RCR, WCR, …).

    `header` is the edge at which the header strobe of the last block ended.

    Args:
        strobe, read_strobe, gap, pause, timeout: see `HostBus` (P312-PAR-10 needs strobes of 3 cycles).
    """

    names: Mapping[tuple[str, int], str] = NAMES

    def __init__(
        self,
        bench: RtlBench,
        strobe: int = 3,
        read_strobe: int = 5,
        gap: int = 3,
        pause: Callable[[], int] | None = None,
        timeout: int = 4_000_000,
    ) -> None:
        super().__init__(bench, strobe, read_strobe, gap, pause, timeout)
        self.header = 0

    async def status(self) -> int:
        """Read CSR."""
        return await self.read(CSR)

    async def put(self, text: str, war: int | None = None) -> int:
        """Write a block, regardless of MWEF; return the edge at which the header strobe ends.

        Args:
            war: value for WAR instead of the address that matches the block.
        """
        block = bytes.fromhex(text)[::-1]
        await self.write(WCR, ARMED)
        await self.write(WAR, WINDOW - len(block) if war is None else war)
        for byte in block:
            self.header = await self.write(DWR, byte)
        return self.header

    async def issue(self, text: str) -> int:
        """Wait for MWEF = 0 and write a block; return the edge at which the header strobe ends."""
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
