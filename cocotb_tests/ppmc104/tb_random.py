"""Constrained-random hosts, which are compared with the golden model edge by edge, and noise on all pins."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, IBF, HostBus, RtlBench, random_test, start_bench
from cocotb_tests.harness.player import describe
from cocotb_tests.harness.random_host import UNCOMPARED
from cocotb_tests.harness.run_context import note
from cocotb_tests.ppmc104.random_host import scenario
from cocotb_tests.ppmc104.random_noise import noise as make_noise
from cocotb_tests.ppmc104.random_player import HostPlayer

from .bench import PPMC104


@random_test(
    "P104-GEN-07",
    "P104-BUS-01",
    "P104-BUS-07",
    "P104-STA-06",
    "P104-ERR-01",
    "P104-HSK-02",
    "P104-CMD-04",
    "P104-FSM-01",
    "P104-BCK-03",
    "P104-PRO-04",
    "P104-TIM-04",
    "P104-LIM-09",
    "P104-BAD-19",
    "P104-BAD-23",
    least=10,
)
async def random_host(dut: Any, seed: int) -> None:
    """During the transactions of a random host, all outputs change as in the golden model."""
    plan = scenario(seed)
    bench = await start_bench(dut, PPMC104, **plan.pins)
    note(bench, describe(plan.actions))
    await HostPlayer(bench, plan).run()


@random_test(
    "P104-BAD-09",
    "P104-BAD-14",
    "P104-BAD-20",
    "P104-BAD-23",
    "P104-BCK-05",
    "P104-TIM-06",
    uncompared=UNCOMPARED,
)
async def random_noise(dut: Any, seed: int) -> None:
    """After noise on all inputs, commands 0x40 and 0xC0 and an initialisation make the core work again."""
    bench = await RtlBench.start(dut, PPMC104, seed=seed)
    noise = make_noise(bench)
    await noise.make(bench.rng.choice((2_000, 10_000, 40_000)))
    await noise.stop()
    host = HostBus(bench, timeout=bench.config.us(200_000))
    for _ in range(4):
        await host.poll(IBF, 0)
        # In DATASHEET, BUSY of an operation that was just accepted rises up to 112 us later.
        await bench.clocks(bench.config.us(300))
        if not await host.poll(IBF, 0) & BUSY:
            break
        await host.command(0x40)
    bench.check("P104-BAD-23", "BUSY after stop commands", await host.status() & BUSY, 0)
    await host.command(0xC0)
    await host.init(0x0A, 9, 4, 4)
    await host.command(0x80)
    bench.check("P104-BAD-23", "status after recovery", await host.status() & 0xFE, 0)
    start = bench.now
    await host.move(0x43, 14)
    await bench.nth_fall(14, start)
    await host.wait_idle()
    rates = (9, 7, 5, 5, 4, 4, 4, 4, 4, 5, 5, 7, 9)
    quanta = [sum(8 * (rate + 1) for rate in rates[:n]) for n in range(14)]
    pulses = bench.pulses(start)
    expected = [bench.config.quanta(q) for q in quanta]
    bench.check("P104-BAD-23", "pulses after recovery", [t - pulses[0] for t in pulses], expected)
    bench.check("P104-BAD-23", "finish status", await host.fetch(0x80), [0x83])
    for t, _ in bench.edges("dir"):
        bench.check("P104-TIM-06", f"hold when dir changed at {t}", bench.level_at("hold", t), 0)
