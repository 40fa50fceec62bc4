"""Constrained-random hosts, which are compared with the golden model edge by edge, and noise on all pins."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, IBF, OBF, HostBus, RtlBench, random_test, start_bench
from cocotb_tests.harness.player import SinglePlayer, describe
from cocotb_tests.harness.random_host import UNCOMPARED, PinNoise
from cocotb_tests.harness.run_context import note

from .bench import STMC
from .expected_timing import gaps, internal_offsets
from .random_host import scenario

STROBES = ("wr_n", "wr_n", "wr_n", "rd_n", "cs_n")
CODES = (
    0x0A, 0x1A, 0x2A, 0x1E, 0x40, 0x41, 0x42, 0x43, 0x44, 0x4D, 0x46, 0x47, 0x80, 0x82, 0x83, 0x84, 0x81,
)  # fmt: skip


@random_test(
    "STMC-BUS-01",
    "STMC-BUS-12",
    "STMC-BUS-13",
    "STMC-BUS-14",
    "STMC-ST-03",
    "STMC-CMD-01",
    "STMC-FSM-01",
    "STMC-CLK-01",
    "STMC-CLK-02",
    "STMC-MOV-02",
    "STMC-DEC-04",
    "STMC-IN-04",
    "STMC-FIN-02",
    "STMC-CHP-01",
    least=10,
)
async def stmc_random_host(dut: Any, seed: int) -> None:
    """During the transactions of a random host, all outputs change as in the golden model."""
    plan = scenario(seed)
    bench = await start_bench(dut, STMC, **plan.pins)
    note(bench, describe(plan.actions))
    await SinglePlayer(bench, plan, "STMC-STP-01").run()


@random_test("STMC-BAD-13", "STMC-BAD-14", "STMC-BAD-15", "STMC-CLK-04", "STMC-INI-04", uncompared=UNCOMPARED)
async def stmc_random_noise(dut: Any, seed: int) -> None:
    """After noise on all input pins, code 40 and an initialisation make the core work again."""
    bench = await RtlBench.start(dut, STMC, seed=seed)
    noise = PinNoise(bench, STROBES, CODES)
    await noise.make(bench.rng.choice((2_000, 10_000, 40_000)))
    await noise.stop()
    host = HostBus(bench, timeout=bench.config.cyc(264_000 + 209 * 65_536))
    for _ in range(4):
        await host.poll(IBF, 0)
        # In DATASHEET, BUSY of a motion that was just accepted rises up to 112 us later.
        await bench.clocks(bench.config.us(300))
        if not await host.poll(IBF, 0) & BUSY:
            break
        await host.command(0x40)
        await bench.clocks(bench.config.us(300))
    bench.check("STMC-BAD-14", "BUSY after stop commands", await host.poll(IBF, 0) & BUSY, 0)
    await host.init(0x0A, 5, 2, 4)
    bench.check("STMC-INI-04", "status after recovery", await host.command(0x80) & 0xFE, 0)
    while await host.status() & OBF:
        await host.read_data()
        await bench.clocks(8)
    start = bench.now
    await host.move(0x43, 7)
    await bench.edge("int_n", 0)
    steps = [t for t, _ in bench.edges("s", start)]
    if len({level for _, level in bench.edges("s", start)}) > 2:
        steps = steps[-7:]
    expected = internal_offsets(bench.config, gaps(7, (5, 2, 4)))
    got = [t - steps[-7] for t in steps[-7:]]
    bench.check("STMC-INI-04", "steps after recovery", got, expected)
    bench.check("STMC-INI-04", "finish status", await host.fetch(0x80), [0x83])
