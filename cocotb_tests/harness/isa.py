"""`IsaMaster` drives an 8-bit ISA bus: the address selects the register, and there is no chip select."""

from __future__ import annotations

from dataclasses import dataclass

from cocotb.triggers import Lock, Timer

from openppmc.check.records import Access

from .bus import HostBus
from .part import BusStyle
from .rtl_bench import RtlBench

NANOSECONDS = "the hold times of the ISA bus are shorter than the extra cycle"
"""Reason why tests with an ISA bus do not run with JITTER=1."""
STROBES_ISA = BusStyle(
    write_on={"iow_n": 0},
    write_off={"iow_n": 1},
    read_on={"ior_n": 0},
    read_off={"ior_n": 1},
    address="sa",
)


@dataclass(frozen=True)
class Times:
    """Times of an 8-bit I/O access in ns.

    The defaults are the shortest times at a bus clock of 8.33 MHz with the usual wait states.

    Attributes:
        setup: time from the address to the command.
        command: time for which IOR or IOW is low.
        late: delay of the write data after the fall of IOW.
        hold: time for which address and write data are valid after the rise of IOW.
        gap: time to the next access.
    """

    setup: int = 91
    command: int = 530
    late: int = 40
    hold: int = 27
    gap: int = 163


class IsaMaster:
    """Driver of the bus. An access waits until the previous access has ended."""

    def __init__(self, bench: RtlBench, times: Times | None = None) -> None:
        self.bench = bench
        self.times = times or Times()
        self._lock = Lock()

    async def wait(self, ns: float) -> None:
        """Wait `ns` nanoseconds, slightly longer if the end would coincide with a rising edge of `clk`."""
        if ns > 0:
            await Timer(round(ns * 500) * 2, "ps")
        if (self.bench.sim_time() - self.bench.edge_time(0)) % self.bench.period == 0:
            await Timer(2, "ps")

    async def write(self, address: int, byte: int, aen: int = 0, command: float | None = None) -> int:
        """Perform one write access; return the first edge that samples IOW high again."""
        async with self._lock:
            bench, t = self.bench, self.times
            length = t.command if command is None else command
            await self.wait(0)
            bench.set_between_edges(sa=address, aen=aen)
            await self.wait(t.setup)
            bench.set_between_edges(iow_n=0, sd_i=byte ^ 0xFF)
            late = min(t.late, length)
            await self.wait(late)
            bench.set_between_edges(sd_i=byte)
            await self.wait(length - late)
            edge0 = bench.set_between_edges(iow_n=1)
            await self._release(byte ^ 0xFF)
            return edge0

    async def read(self, address: int, aen: int = 0, command: float | None = None) -> tuple[int, int, int]:
        """Perform one read access; return (sd_oe, sd_o) when IOR rises, and the first edge with IOR low.

        Checks that the module does not drive the data bus before IOR falls and releases it as soon as IOR has
        risen.
        """
        async with self._lock:
            bench, t = self.bench, self.times
            await self.wait(0)
            bench.set_between_edges(sa=address, aen=aen)
            await self.wait(t.setup)
            bench.check("ISA-05", "sd_oe before the command", bench.level("sd_oe"), 0)
            edge0 = bench.set_between_edges(ior_n=0)
            await self.wait(t.command if command is None else command)
            sample = bench.level("sd_oe"), bench.level("sd_o")
            bench.set_between_edges(ior_n=1)
            await Timer(2, "ps")
            bench.check("ISA-05", "sd_oe after the command", bench.level("sd_oe"), 0)
            await self._release(bench.pins["sd_i"])
            return *sample, edge0

    async def _release(self, data: int) -> None:
        """Remove address and data, then leave the bus idle."""
        await self.wait(self.times.hold)
        self.bench.set_between_edges(sa=(self.bench.pins["sa"] + 0x155) & 0x3FF, aen=0, sd_i=data)
        await self.wait(self.times.gap)


class IsaHost(HostBus):
    """`HostBus` on the ISA bus, for a device whose data register has the address `base`."""

    def __init__(self, master: IsaMaster, base: int) -> None:
        super().__init__(master.bench)
        self.master = master
        self.base = base

    async def write(self, reg: int, byte: int, strobe: int | None = None, gap: int | None = None) -> int:
        """Perform one write access with the times of the ISA bus."""
        edge0 = await self.master.write(self.base + reg, byte)
        self.bench.accesses.append(Access(edge0, "write", reg, byte))
        return edge0

    async def read(self, reg: int, strobe: int | None = None, gap: int | None = None) -> int:
        """Perform one read access; raise AssertionError if the module does not drive the bus."""
        driven, byte, edge0 = await self.master.read(self.base + reg)
        self.bench.check("ISA-05", f"sd_oe at the end of a read of {self.base + reg:#x}", driven, 1)
        self.bench.accesses.append(Access(edge0, "read", reg, byte))
        return byte
