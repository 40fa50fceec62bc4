"""`Env`: a PPMC-2104AFP on the test bench with its host and its two axes.

@directed("AC-09", "P2104-EX-01", builds=(F16, F11))
async def p2104_ac_09_trapezoid(dut):
    "With ramp B, 25 pulses have the trapezoidal profile of EX-01 (AC-09)."
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.move(0x43, 25)
    axis.check_train("AC-09", rates(INIT_B[1:], indices(25, 10)))
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cocotb_tests.harness import IBF, AxisDriver, Config, DutBench, HostBus, start_bench

from .bench import PPMC2104
from .expected_timing import ALL, BUSY1, CMND1, INIT_A, Init

# Limits of the rules in cycles, counted from edge 0 of a host write (P2104-BUS-05, P2104-HSK-03).
WRITE_EVENT = 2
C_EVENT_LATEST = 10
PINS_LATEST = 12
# Maximum number of cycles from a decision, or from the last rise of pout_n, to the fall of BUSY
# (P2104-END-01/02).
END_LATEST = 4


class Axis(AxisDriver):
    """One of the two axes with its codes, pins and status bits."""

    def __init__(self, bench: DutBench, host: HostBus, n: int) -> None:
        super().__init__(bench, host, f"pout_n[{n}]", f"s{n}_n", f"extck[{n}]", BUSY1 << n - 1, (n - 1) << 5)
        self.n = n
        self.cmnd = CMND1 << n - 1

    def pin(self, name: str) -> str:
        """Return the name of the bit of a port that belongs to this axis."""
        return f"{name}[{self.n}]"

    def set(self, **levels: int) -> int:
        """Drive input pins of this axis; return the stamp of the change, the first edge that samples it."""
        return self.bench.set(**{self.pin(name): level for name, level in levels.items()})

    def at(self, edge: int, **levels: int) -> Any:
        """Schedule levels of input pins of this axis for an edge."""
        return self.bench.at(edge, **{self.pin(name): level for name, level in levels.items()})

    async def blip(self, name: str, clocks: int, level: int = 0) -> int:
        """Hold an input of this axis at `level` for some cycles; return the first edge that samples it."""
        return await self.bench.pulse_pin(self.pin(name), level, clocks)

    def level(self, name: str) -> int:
        """Return the present level of pout_n, dir or hold."""
        return self.bench.level(self.pin(name))

    @property
    def phases_now(self) -> int:
        """The present levels of the five phase pins."""
        return self.bench.level(self.phases)

    def edges(self, name: str, since: int | None = None) -> list[tuple[int, int]]:
        """Return the edges of pout_n, dir or hold since an edge (default: since the last `go`)."""
        return self.bench.edges(self.pin(name), self.since if since is None else since)

    # ---------------------------------------------------------------- instructions

    async def init(self, code: int, rl: int, rh: int, pa: int) -> None:
        """Send the initial setting and wait until the ramp table is complete."""
        await self.host.init(code | self.axis_bit, rl, rh, pa)
        if self.cfg.datasheet:
            # In DATASHEET the setting takes 71 ms (P2104-DS-01), during which continuous polling would be
            # slow.
            await self.bench.clocks(self.cfg.us(70_990))
        await self.ready()

    async def ready(self) -> int:
        """Wait for CMND = 0 and an open input buffer."""
        return await self.host.poll(self.cmnd | IBF, 0)

    async def send(self, code: int, data: Sequence[int] = (), poll: bool = True) -> int:
        """Send a code to this axis with its data bytes."""
        return await self.host.send(code | self.axis_bit, data, poll)

    async def error(self) -> int:
        """Return the error code of this axis."""
        return (await self.fetch(0x86))[0]

    async def refused(self, rule: str, what: str, error: int, code: int, *data: int) -> None:
        """Send an instruction and check that it sets `error` on this axis (0: no error)."""
        await self.send(code, data)
        self.check(rule, f"error of {what}", await self.error(), error)

    async def halt(self) -> None:
        """Send an Immediate Stop, wait for the end of the motion and clear its interrupt."""
        await self.command(0x40)
        await self.idle()
        await self.finish()

    async def running(self, rate: int = 49, code: int = 0x45) -> None:
        """Start a continuous constant-speed operation and wait for its first pulse."""
        await self.go(code, rate=rate)
        await self.pulse(1, 4)

    async def outcome(
        self, rule: str, pulses: int, finish: int, total: int = ALL, rates: Sequence[int] | None = None
    ) -> None:
        """Check the result of an operation of `total` pulses; if `rates` are passed, check its pulse train as
        well.
        """
        await self.result(rule, pulses, finish, max(total - pulses - 1, 0))
        if rates is not None:
            self.check_train(rule, rates)


class Env:
    """The test bench, the host, and the axes `x1` and `x2`; create it with `await Env.start(dut)`."""

    def __init__(self, bench: DutBench) -> None:
        self.bench = bench
        self.host = HostBus(bench)
        self.x1, self.x2 = (Axis(bench, self.host, n) for n in (1, 2))
        self.axes = (self.x1, self.x2)
        self.cfg: Config = bench.config
        self.check = bench.check
        self.window = bench.check_window
        self.outputs = self.x1.outputs
        self.reaction = self.x1.reaction
        self.statuses = self.x1.statuses

    @classmethod
    async def start(cls, dut: Any, **pins: int) -> Env:
        """Reset with these input levels; no axis has a setting."""
        return cls(await start_bench(dut, PPMC2104, **pins))

    async def ready(self, n: int, init: Init = INIT_A) -> Axis:
        """Send the initial setting to axis n and return the axis."""
        axis = self.axes[n - 1]
        await axis.init(*init)
        return axis

    async def both(self, first: Init = INIT_A, second: Init | None = None) -> tuple[Axis, Axis]:
        """Send initial settings to both axes."""
        await self.ready(1, first)
        await self.ready(2, second or first)
        return self.axes

    async def style(self, busc: int) -> None:
        """Select the bus style while the strobes are inactive, and wait until it takes effect
        (P2104-BUS-04).
        """
        await self.host.idle()
        self.bench.set(busc=busc)
        await self.host.idle()
        await self.bench.clocks(4)

    async def run(self, script: str) -> list[int]:
        """Run a script of the acceptance table as `HostBus.run` does; e1 and e2 read the Error code of axis 1
        or 2.
        """
        words = {"e1": "c 86 r", "e2": "c A6 r"}
        return await self.host.run(" ".join(words.get(w, w) for w in script.replace(";", " ").split()))

    async def errors(self) -> tuple[int, int]:
        """Read both error registers, which clears them."""
        return await self.x1.error(), await self.x2.error()

    async def reset(self) -> None:
        """Reset and wait until bytes are accepted."""
        await self.bench.reset()
        await self.bench.clocks(6)

    def all_reset(self, rule: str) -> None:
        """Check that every output has the level that it has in reset."""
        reset = self.bench.part.reset_levels()
        names = self.bench.outputs
        levels = {name: self.bench.level(name) for name in names}
        self.check(rule, "outputs in reset", levels, {name: reset[name] for name in names})

    def quiet(self, rule: str, since: int, *others: str) -> None:
        """Check that no motor pin, int_n or output in `others` has changed since edge `since`."""
        names = ("pout_n", "dir", "hold", "s1_n", "s2_n", "int_n", *others)
        moved = {name: edges for name in names if (edges := self.bench.edges(name, since))}
        self.check(rule, f"edges of outputs since {since}", moved, {})
