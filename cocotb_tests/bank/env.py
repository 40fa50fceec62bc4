"""`Env`: a bank on the test bench with its host and its axes.

@directed("BANK-MOT-01", builds=(B8, F100))
async def bank_mot_01_exact(dut):
    "The intervals of a move are exact to the cycle (BANK-MOT-01)."
    env = await Env.start(dut)
    axis = await env.ready(3)
    await axis.move(0x43, 14)
    axis.check_train("BANK-MOT-01", rates(INIT_A[1:], indices(14, 4)))
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from cocotb_tests.harness import IBF, AxisDriver, Config, DutBench, HostBus, start_bench

from .bench import BANK, axes_of, round_of

Init = tuple[int, int, int, int]
INIT_A: Init = (0x0A, 9, 4, 4)
"""Initialisation for a four-phase motor: positive logic, 2-phase excitation, and a ramp table that is built
quickly.
"""

DATA, STATUS, CONFIG, POSITION, MASK, MAP, GO, STOP, INFO = 0, 1, 2, 4, 8, 9, 10, 11, 12
WORDS = {
    DATA: ("read", "data"),
    STATUS: ("status", "command"),
    CONFIG: ("CONFIG", "CONFIG :="),
    **{POSITION + n: (f"position {n}", f"position {n} :=") for n in range(4)},
    MASK: ("MASK", "MASK :="),
    MAP: ("map", "map :="),
    GO: ("GO", "GO"),
    STOP: ("STOP", "STOP"),
    INFO: ("INFO", "INFO :="),
}
NAMES = {
    (kind, axis << 4 | register): f"axis {axis} {words[place]}" + (" read" if kind == "read" else "")
    for place, kind in enumerate(("read", "write"))
    for register, words in WORDS.items()
    for axis in range(64)
}
"""(kind of access, address) -> name of the register in reports."""
WRITE_EVENT = 2
"""Number of edges from edge 0 of a write to its write event (BANK-WIN-06)."""
SNAPSHOT = 2
"""Number of edges from edge 0 of a read to the edge whose state the read returns (BANK-WIN-05)."""
SYNC = 2
"""Number of edges from the first edge that samples a level of a pin to the edge on which this level takes
effect (BANK-MOT-02).
"""


class WindowBus(HostBus):
    """Host that accesses the window of the bank; its registers 0 and 1 are those of the axis `axis`.

    Strobes and pauses have the minimum lengths of BANK-WIN-04.
    """

    names = NAMES

    def __init__(self, bench: DutBench, axis: int = 0, pause: Callable[[], int] | None = None) -> None:
        super().__init__(bench, 2, 6, 3, pause=pause, lead=1 + bench.slack, base=axis << 4)

    async def write(self, reg: int, byte: int, strobe: int | None = None, gap: int | None = None) -> int:
        """Do the same as the base class; with JITTER=1, return the edge that first samples the end."""
        edge0 = await super().write(reg, byte, strobe, gap)
        if self.bench.slack:
            edge0 = min(self.bench.pin_edges(pin, 1, edge0)[0] for pin in ("cs_n", "wr_n"))
        return edge0


class Axis(AxisDriver):
    """Axis number `n` of a bank: its codes, pins and status.

    A visit is an edge on which the bank serves the axis, once in each round of R cycles. The edges of the
    visits are calculated from R and from `released`, the edge on which the reset was released.
    """

    def __init__(self, bench: DutBench, n: int) -> None:
        super().__init__(bench, WindowBus(bench, n), f"pout_n[{n}]")
        self.n = n
        self.round = round_of(bench.config)
        self.released = 0

    # ---------------------------------------------------------------- pins

    def pin(self, name: str) -> str:
        """Return the name of the bit of a port that belongs to this axis."""
        return f"{name}[{self.n}]"

    def set(self, **levels: int) -> int:
        """Drive input pins of this axis; return the stamp of the change, the first edge that samples it."""
        return self.bench.set(**{self.pin(name): level for name, level in levels.items()})

    def at(self, edge: int, **levels: int) -> Any:
        """Schedule levels of input pins of this axis for an edge."""
        return self.bench.at(edge, **{self.pin(name): level for name, level in levels.items()})

    def level(self, name: str) -> int:
        """Return the present level of pout_n, dir or hold."""
        return self.bench.level(self.pin(name))

    def edges(self, name: str, since: int | None = None) -> list[tuple[int, int]]:
        """Return the edges of pout_n, dir or hold since an edge (default: since the last `go`)."""
        return self.bench.edges(self.pin(name), self.since if since is None else since)

    def patterns(self, since: int | None = None) -> list[tuple[int, int]]:
        """Return the changes (edge, S5..S1) of the phases of this axis."""
        place, start = 5 * self.n, self.since if since is None else since
        level, found = self.bench.initial["s"] >> place & 31, []
        for t, value in self.bench.edges("s"):
            if value >> place & 31 != level:
                level = value >> place & 31
                found.append((t, level))
        return [(t, value) for t, value in found if t >= start]

    def stretches(self, since: int) -> list[tuple[int, int]]:
        """Return (S5..S1, duration in cycles) of each phase pattern since an edge, except the pattern that is
        still active.
        """
        edges = self.patterns(since)
        return [(value, b - a) for (a, value), (b, _) in zip(edges, edges[1:], strict=False)]

    @property
    def phases_now(self) -> int:
        """The present levels of S5..S1."""
        return self.bench.level("s") >> 5 * self.n & 31

    # ---------------------------------------------------------------- visits

    def visit(self, edge: int) -> int:
        """Return the first visit at or after an edge (BANK-GEN-01)."""
        start = self.released + self.n + 8 + self.round
        return start + max(0, -(-(edge - start) // self.round)) * self.round

    def accepting_visit(self, edge0: int) -> int:
        """Return the visit that accepts a byte if the axis then accepts bytes (BANK-HSK-01).

        `edge0` is edge 0 of the write of the byte.
        """
        return self.visit(edge0 + WRITE_EVENT + 7)

    # ---------------------------------------------------------------- instructions and registers

    async def init(self, code: int, rl: int, rh: int, pa: int, opened: bool = True) -> None:
        """Initialise the axis; if `opened` is true, wait until its ramp table is built."""
        await self.host.init(code, rl, rh, pa)
        if opened:
            await self.opened()

    async def opened(self) -> None:
        """Send a read command and wait until the axis has executed it, so that the axis accepts bytes.

        The answer is discarded.
        """
        await self.host.command(0x81)
        await self.host.read(DATA)

    async def position(self) -> int:
        """Return the position register (BANK-WIN-07)."""
        data = [await self.host.read(POSITION + n) for n in range(4)]
        return int.from_bytes(bytes(data), "little", signed=True)

    async def set_config(self, csel: int, vsel: int) -> int:
        """Write CONFIG and return edge 0 of the write."""
        return await self.host.write(CONFIG, csel | vsel << 1)

    async def halt(self) -> None:
        """Send an Immediate Stop, wait for the end of the motion and clear its interrupt."""
        await self.command(0x40)
        await self.idle()
        await self.finish()

    async def status(self) -> int:
        """Return the status register."""
        return await self.host.status()

    async def refused(self, rule: str, what: str, error: int, code: int, *data: int) -> None:
        """Send an instruction; check that it sets ERR to the error number `error` (-1: no error)."""
        status = await self.host.send(code, data)
        got = status >> 4 & 7 if status & 0x80 else -1
        self.check(rule, f"error of {what}", got, error)

    async def outcome(
        self,
        rule: str,
        pulses: int,
        finish: int,
        remaining: int | None = None,
        rates: Sequence[int] | None = None,
    ) -> None:
        """Check the result of a motion; if `rates` are passed, check its pulse train as well."""
        await self.result(rule, pulses, finish, remaining)
        if rates is not None:
            self.check_train(rule, rates)


class Env:
    """The test bench, the window and the axes of a bank; create it with `await Env.start(dut)`."""

    def __init__(self, bench: DutBench) -> None:
        self.bench = bench
        self.cfg: Config = bench.config
        self.axes = [Axis(bench, n) for n in range(axes_of(bench.config))]
        self.host = WindowBus(bench)
        self.round = round_of(bench.config)
        self.size = len(self.axes)
        self.check = bench.check

    @classmethod
    async def start(cls, dut: Any, **pins: int) -> Env:
        """Reset the bank with the input levels `pins` and wait until it is ready (BANK-GEN-05)."""
        bench = await start_bench(dut, BANK, settle=0, **pins)
        await bench.until(round_of(bench.config) + 8)
        return cls(bench)

    async def ready(self, n: int, init: Init = INIT_A) -> Axis:
        """Initialise axis n and return the axis."""
        axis = self.axes[n]
        await axis.init(*init)
        return axis

    async def all_ready(self, *numbers: int, init: Init = INIT_A) -> list[Axis]:
        """Initialise some axes (default: all), one after the other, and return them.

        While the table of one axis is built, the bytes of the next axis are written.
        """
        chosen = [self.axes[n] for n in numbers or range(self.size)]
        for axis in chosen:
            await axis.init(*init, opened=False)
        for axis in chosen:
            await axis.opened()
        return chosen

    async def reset(self, clocks: int = 4) -> int:
        """Reset the bank, wait until it is ready, and return the stamp of the release."""
        released = await self.bench.reset(clocks, settle=self.round + 8)
        for axis in self.axes:
            axis.released = released
        return released

    # ---------------------------------------------------------------- registers of the bank

    async def mask(self, *numbers: int) -> None:
        """Set the MASK bits of these axes and clear all others."""
        bits = sum(1 << n for n in numbers)
        for k in range(max(1, self.size // 8)):
            await self.host.write(k << 4 | MASK, bits >> 8 * k & 0xFF)

    async def map(self) -> int:
        """Return the interrupt map of all axes."""
        bytes_ = [await self.host.read(k << 4 | MAP) for k in range(max(1, self.size // 8))]
        return int.from_bytes(bytes(bytes_), "little")

    async def go(self) -> int:
        """Write GO and return its write event g."""
        return await self.host.write(GO, 0) + WRITE_EVENT

    async def stop(self) -> int:
        """Write STOP and return its write event g."""
        return await self.host.write(STOP, 0) + WRITE_EVENT

    # ---------------------------------------------------------------- exact to the cycle

    def at_event(self, edge: int, address: int, byte: int) -> Any:
        """Schedule a write whose write event occurs on edge `edge`, and return immediately.

        The host must make no other access until the write has ended.
        """
        edge0 = edge - WRITE_EVENT
        return self.bench.drive(
            [
                (edge0 - 2 - self.host.lead, {"a": address}),
                (edge0 - 2, {"cs_n": 0, "wr_n": 0, "d_i": byte}),
                (edge0, {"cs_n": 1, "wr_n": 1}),
            ]
        )

    async def write_at(self, edge: int, address: int, byte: int) -> int:
        """Write a byte with its write event on edge `edge`; return when the next access may begin.

        The result is the edge of the write event: with JITTER=1, `edge` or one cycle later.
        """
        await self.bench.until(edge - WRITE_EVENT - 2 - self.host.lead)
        return await self.host.write(address, byte) + WRITE_EVENT

    async def as_of(self, edge: int, address: int) -> int:
        """Read a register; return the value that it has just after edge `edge` (BANK-WIN-05)."""
        await self.bench.until(edge - SNAPSHOT - self.host.lead)
        return await self.host.read(address)

    async def quiet(self, axes: Iterable[Axis]) -> None:
        """Stop all running motions, wait for their ends and clear the interrupts."""
        for axis in axes:
            if await axis.status() & 4:
                await axis.command(0x40)
        for axis in axes:
            await axis.idle()
            await axis.finish()
            await axis.host.poll(IBF, 0)
