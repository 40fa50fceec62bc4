"""A host that is asynchronous to `clk`: accesses with the bus timing of the old chip in nanoseconds."""

from __future__ import annotations

from cocotb.triggers import Timer

from cocotb_tests.harness import BusStyle

from .env import Env

# Limits of the old chip in ns (P2104-BUS-20).
WIDTH, DATA_SETUP, DATA_HOLD, ADDRESS_SETUP, ADDRESS_HOLD = 120, 80, 10, 20, 5
ACCESS, RELEASE = 100, 90
# Times within a cycle at which an access starts, in sixteenths of a cycle.
PHASES = range(16)


def ps(ns: float) -> int:
    """Return a time in ns as an even number of ps, as the time steps of the simulator require."""
    return int(ns * 500) * 2


class SlowBus:
    """Accesses with adjustable times. In contrast to `HostBus`, each pin changes at a separate time."""

    def __init__(self, env: Env) -> None:
        self.env = env
        self.bench = env.bench

    @property
    def style(self) -> BusStyle:
        """Levels of the strobe pins in the present bus style."""
        return self.env.host.style

    async def wait(self, ns: float) -> None:
        """Wait for this number of ns."""
        if ps(ns) > 0:
            await Timer(ps(ns), "ps")

    async def phase(self, sixteenth: int) -> None:
        """Wait until this sixteenth of a cycle; a small offset avoids the edges of `clk`."""
        await self.bench.align()
        await Timer(self.bench.period * sixteenth // 32 * 2 + 2 * (self.bench.period // 128), "ps")

    async def _open(self, register: int, on: dict[str, int]) -> dict[str, int]:
        """Drive chip select, address and R/W*; return the level of the strobe pin, which the caller drives
        later.
        """
        strobe = {pin: 0 for pin in ("ds_wrs_n", "rw_rds_n") if on[pin] == 0}
        if self.bench.pins["busc"]:
            strobe = {"ds_wrs_n": 0}
        first = {pin: level for pin, level in on.items() if pin not in strobe}
        self.bench.set_between_edges(a0=register, **first)
        await self.wait(ADDRESS_SETUP)
        return strobe

    async def write(
        self, register: int, byte: int, width: float = WIDTH, setup: float = DATA_SETUP, rest: float = 0
    ) -> int:
        """Make one write with a strobe of `width`, then wait `rest`. d_i is valid from `setup` before the end
        of the strobe.

        Return the first edge that samples the end of the strobe.
        """
        bench = self.bench
        bench.set_between_edges(d_i=byte ^ 0xFF)
        strobe = await self._open(register, dict(self.style.write_on))
        bench.set_between_edges(**strobe)
        await self.wait(width - setup)
        bench.set_between_edges(d_i=byte)
        await self.wait(setup)
        end = bench.set_between_edges(**dict.fromkeys(strobe, 1))
        await self.wait(ADDRESS_HOLD)
        bench.set_between_edges(cs_n=1, a0=1 - register)
        await self.wait(DATA_HOLD - ADDRESS_HOLD)
        bench.set_between_edges(d_i=byte ^ 0xFF)
        await self.wait(rest)
        return end

    async def read(
        self,
        register: int,
        width: float = WIDTH,
        rest: float = 0,
        access: float = ACCESS,
        release: float = RELEASE,
    ) -> list[tuple[int, int]]:
        """Make one read; return (d_oe, d_o) after the access time and at the end of the strobe.

        Check that the bus is released within `release` after the strobe, then wait `rest`.
        """
        bench = self.bench
        strobe = await self._open(register, dict(self.style.read_on))
        bench.set_between_edges(**strobe)
        samples = []
        for until in (access, width - access):
            await self.wait(until)
            samples.append((bench.level("d_oe"), bench.level("d_o")))
        bench.set_between_edges(**dict.fromkeys(strobe, 1))
        await self.wait(ADDRESS_HOLD)
        bench.set_between_edges(cs_n=1, a0=1 - register)
        await self.wait(release - ADDRESS_HOLD)
        bench.check("P2104-BUS-20", f"d_oe {release} ns after the strobe", bench.level("d_oe"), 0)
        await self.wait(rest)
        return samples
