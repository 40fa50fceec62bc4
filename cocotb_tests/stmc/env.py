"""`Env`: an STMC core on the test bench with its host.

@directed("AC-05", "STMC-MOV-02")
async def stmc_ac_05_trapezoid(dut):
    "A move of 20 steps has the gaps of W1 (AC-05)."
    env = await Env.start(dut, STANDARD, clock=16)
    await env.move(0x43, 20)
    env.train("AC-05", gaps(20))
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import repeat
from typing import Any

from cocotb_tests.harness import BUSY, IBF, AxisDriver, DutBench, HostBus, start_bench
from cocotb_tests.harness.axis_driver import differences
from cocotb_tests.harness.checks import check_intervals
from cocotb_tests.harness.dut_bench import TIMEOUT

from .bench import STMC
from .expected_timing import EXT, STANDARD, TICK, Init, internal_offsets

# Limits of the rules in cycles, counted from edge 0 of a host write (STMC-BUS-12, -13).
WRITE_EVENT = 2
C_EVENT_LATEST = 12
PINS_LATEST = 14
# Maximum number of cycles from the last step, or from the deciding cause, to the fall of BUSY (STMC-MOT-08).
END_LATEST = 8
# Duration of the longest motion for which a test waits, in crystal periods.
LONGEST = 200 * TICK
# Maximum number of cycles of a table build (STMC-INI-07).
BUILD_LATEST = 40_000


class Env(AxisDriver):
    """The test bench and its host.

    `pulses` are the steps, as edges of `s`. `period` is the period of `ext_clk` in cycles, 0 if it is
    stopped.
    """

    def __init__(self, bench: DutBench, host: HostBus | None = None, clock: str = "ext_clk") -> None:
        limit = max(TIMEOUT, bench.config.cyc(LONGEST))
        super().__init__(bench, host or HostBus(bench, timeout=limit), pout="s", clock=clock)
        self.period = 0
        self.sheet = dict(self.cfg.extra).get("READ_MAP") == "SHEET"

    @classmethod
    async def start(cls, dut: Any, init: Init | None = STANDARD, clock: int = EXT, **pins: int) -> Env:
        """Reset with the input levels `pins`, then initialise (None: the core stays in its reset state).

        Args:
            clock: period of `ext_clk` in cycles from the reset on, 0 = stopped.
        """
        env = cls(await start_bench(dut, STMC, **pins))
        if clock:
            env.run_clock(clock)
        if init:
            await env.init(*init)
        return env

    def run_clock(self, period: int) -> Any:
        """Start `ext_clk` with a constant period; return the task."""
        self.period = period
        return self.bench.external_clock(repeat(period), high=period // 2)

    # ---------------------------------------------------------------- codes

    @property
    def inputs_code(self) -> int:
        """Code that reads the inputs."""
        return 0x82 if self.sheet else 0x81

    @property
    def outputs_code(self) -> int:
        """Code that reads the outputs."""
        return 0x83 if self.sheet else 0x82

    @property
    def remaining_code(self) -> int:
        """Code that reads the remaining steps."""
        return 0x84 if self.sheet else 0x83

    async def init(self, code: int, d1: int, d2: int, pa: int) -> None:
        """Initialise and wait until the ramp table is complete."""
        await self.host.init(code, d1, d2, pa)
        await self.ready()

    async def ready(self) -> int:
        """Wait until bytes are accepted again: read the finish status, and return it."""
        limit = 1_300_000 if self.cfg.datasheet else BUILD_LATEST + 200
        if self.cfg.datasheet:
            limit = self.cfg.cyc(264_000 + 209 * 65_535) + 1_000
        await self.host.write(1, 0x80)
        await self.host.poll(IBF, 0, limit)
        return await self.host.read_data()

    async def halt(self) -> None:
        """Send command 0, wait for the end of the motion and clear its interrupt."""
        await self.command(0x40)
        await self.idle()
        await self.finish()

    async def inputs(self) -> int:
        """Read the inputs."""
        return (await self.fetch(self.inputs_code))[0]

    async def out(self) -> int:
        """Read the outputs."""
        return (await self.fetch(self.outputs_code))[0]

    async def remaining(self) -> int:
        """Read the remaining steps."""
        low, middle, high = await self.fetch(self.remaining_code, 3)
        return low | middle << 8 | high << 16

    async def move(self, code: int, n: int | None = None, rate: int | None = None) -> list[int]:
        """Call `go`, wait for the end and return the steps. `rate` is the divisor."""
        await self.go(code, n, rate)
        if self.cfg.datasheet:
            # In DATASHEET, BUSY rises long after IBF has fallen (STMC-DS-01), but no byte is accepted in
            # between.
            await self.host.poll(BUSY, BUSY, self.cfg.us(150), dense=1000)
        await self.idle()
        return self.pulses

    # ---------------------------------------------------------------- steps

    @property
    def pulses(self) -> list[int]:
        """Edges of the steps since the last `go`; valid without chopping."""
        return [t for t, _ in self.bench.edges("s", self.since)]

    @property
    def patterns(self) -> list[int]:
        """Levels of `s` since the last `go`."""
        return [level for _, level in self.bench.edges("s", self.since)]

    async def pulse(self, n: int, plus: int = 0) -> int:
        """Wait for the n-th step of the last `go`, then `plus` cycles; return the edge of the step."""
        while len(self.pulses) < n:
            await self.bench.edge("s", timeout=TIMEOUT)
        await self.bench.align()
        step = self.pulses[n - 1]
        if plus:
            await self.bench.until(step + plus)
        return step

    async def in_gap(self, i: int, plus: int = 30) -> int:
        """Wait until `plus` cycles after step i, which begins gap i; return the edge of step i."""
        return await self.pulse(i + 1, plus)

    def train(self, rule: str, ticks: Sequence[int]) -> None:
        """Check that the gaps between the steps of the last `go` are exactly `ticks` (STMC-CLK-03)."""
        steps = self.pulses
        self.check(rule, "number of steps", len(steps), len(ticks) + 1)
        if self.period:
            expected = [gap * self.period for gap in ticks]
            check_intervals(self.bench, rule, differences(steps), expected)
        else:
            got = [t - steps[0] for t in steps]
            self.check(rule, "cycles from step 0", got, internal_offsets(self.cfg, list(ticks)))

    async def outcome(
        self, rule: str, steps: int, finish: int, remaining: int, ticks: Sequence[int] | None = None
    ) -> None:
        """Wait for the end; check the number of steps, FIN, REM, and the gaps."""
        await self.result(rule, steps, finish, remaining)
        if ticks is not None:
            self.train(rule, ticks)

    async def tick_until(self, pulses: int, limit: int = 2000) -> None:
        """Drive single clock edges until the last `go` has made this number of steps."""
        for _ in range(limit):
            if len(self.pulses) >= pulses:
                break
            await self.ticks(1)
        self.check("STMC-CLK-02", "steps made by external clock edges", len(self.pulses), pulses)

    # ---------------------------------------------------------------- pins

    def set(self, **levels: int) -> int:
        """Drive input pins; return the stamp of the change, the first edge that samples it."""
        return self.bench.set(**levels)

    async def pins(self, **levels: int) -> None:
        """Drive input pins and wait until they take effect."""
        await self.bench.align()
        self.bench.set(**levels)
        await self.bench.clocks(4)

    async def blip(self, pin: str, clocks: int = 4) -> int:
        """Hold a switch at its other level for some cycles; return the first edge that samples it."""
        return await self.bench.pulse_pin(pin, 1 - self.bench.pin(pin), clocks)

    def quiet(self, rule: str, since: int) -> None:
        """Check that no step, no change of hold and no interrupt occurred since that edge."""
        moved = {name: edges for name in ("s", "hold", "int_n") if (edges := self.bench.edges(name, since))}
        self.check(rule, f"edges of outputs since {since}", moved, {})

    async def reset(self) -> None:
        """Reset and wait until bytes are accepted."""
        await self.bench.reset()
        await self.bench.clocks(6)
