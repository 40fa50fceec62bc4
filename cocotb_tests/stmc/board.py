"""The board `j105_stmc` for the tests: its design, and an environment on an ISA bus."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import Config, IsaHost, RtlBench, start_bench
from cocotb_tests.harness.build import Design
from cocotb_tests.harness.isa import IsaMaster
from cocotb_tests.harness.project import include_dirs, part, sources

from .bench import J105_STMC
from .env import Env
from .expected_timing import Init

BASE = 0x3B0

# Every parameter differs from its default.
OTHER = Config(
    "other",
    clk_hz=25_000_000,
    xtal_hz=20_000_000,
    timing="DATASHEET",
    extra=(
        ("BASE_ADDR", 0x2A2),
        ("EXT_HZ", 1_000_000),
        ("READ_MAP", "SHEET"),
        ("HOLD_XT", 2_500),
        ("CHOP_ON_XT", 401),
        ("CHOP_OFF_XT", 611),
    ),
)


def design(config: Config) -> Design:
    """Return the design of the board with its core."""
    ports = ("clk", "rst_n", *J105_STMC.inputs, *J105_STMC.outputs)
    return Design(
        "j105_stmc", sources(part("j105_stmc")), include_dirs(), J105_STMC.params(config), ports=ports
    )


class BoardEnv(Env):
    """An `Env` with an ISA host; `master` is the master of the ISA bus."""

    def __init__(self, bench: RtlBench) -> None:
        self.master = IsaMaster(bench)
        self.base = int(dict(bench.config.extra).get("BASE_ADDR", BASE))
        super().__init__(bench, IsaHost(self.master, self.base))

    @classmethod
    async def start(cls, dut: Any, init: Init | None = None, clock: int = 0, **pins: int) -> BoardEnv:
        """Reset with the input levels `pins`; the board generates the clock of its core."""
        bench = await start_bench(dut, J105_STMC, **pins)
        assert isinstance(bench, RtlBench)
        return cls(bench)

    async def wait_end(self, timeout: int = 1_000_000) -> int:
        """Wait for the end of the last `go`; return the edge on which irq rises."""
        if rises := self.bench.rises("irq", self.since):
            await self.bench.align()
            return rises[0]
        return await self.bench.edge("irq", 1, timeout)
