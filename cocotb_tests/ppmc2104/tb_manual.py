"""Runs the sessions of docs/ppmc2104/examples.md on the core: every byte must equal the printed byte.

The values in the text of the page (pulses, cycles, levels) are checked, too.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import DutBench, HostBus, directed, start_bench
from cocotb_tests.harness.sessions import Sessions

from .bench import PPMC2104

SESSIONS = Sessions("ppmc2104", brief=(0x42, 0x62))  # single steps last 10 µs
blocks, play = SESSIONS.blocks, SESSIONS.play
BUSY = 0x0C


async def begin(dut: Any, ready: bool = True, **pins: int) -> tuple[DutBench, HostBus]:
    """Return a test bench after reset; if `ready` is set, example 1 has already run."""
    bench = await start_bench(dut, PPMC2104, **pins)
    host = HostBus(bench)
    if ready:
        await play(bench, host, blocks(1)[0], "example 1")
    return bench, host


def axis(bench: DutBench, name: str, n: int, since: int) -> list[int]:
    """Return the pulses of an axis; `name` is the example for the message."""
    pulses = bench.pulses(since, f"pout_n[{n}]")
    assert pulses, f"{name}: axis {n} made no pulse"
    return pulses


@directed()
async def manual_2104_examples_2(dut: Any) -> None:
    bench, host = await begin(dut)
    start = bench.now
    a, b = blocks(2)
    await play(bench, host, a, "example 2")
    await host.wait_idle(3_000_000, BUSY)
    pulses = axis(bench, "example 2", 1, start)
    gaps = bench.intervals(start, "pout_n[1]")
    bench.check("example 2", "pulses", len(pulses), 1000)
    bench.check("example 2", "intervals", gaps[:4], [4096, 4000, 3904, 3840])
    bench.check("example 2", "plateau", gaps.count(1280), 609)
    bench.check("example 2", "clk", sum(gaps), 1_549_696)
    bench.check("example 2", "int_n", bench.level("int_n"), 0)
    await play(bench, host, b, "example 2b")
    bench.check("example 2", "int_n", bench.level("int_n"), 1)


@directed()
async def manual_2104_examples_3(dut: Any) -> None:
    bench, host = await begin(dut, run=0b00)
    start = bench.now
    a, b = blocks(3)
    await play(bench, host, a, "example 3")
    bench.check("example 3", "pulses before RUN", bench.pulses(start, "pout_n[1]"), [])
    await bench.align()
    bench.set(run=0b11)
    await play(bench, host, b, "example 3b")
    first, second = axis(bench, "example 3", 1, start), axis(bench, "example 3", 2, start)
    bench.check("example 3", "first falls", first[0], second[0])
    bench.check("example 3", "clk", (first[-1] - first[0], second[-1] - second[0]), (1_549_696, 1_551_360))
    bench.check("example 3", "pulses", (len(first), len(second)), (1000, 500))
    bench.check("example 3", "dir", bench.level("dir"), 0b10)


@directed()
async def manual_2104_examples_4(dut: Any) -> None:
    bench, host = await begin(dut)
    start = bench.now
    a, b = blocks(4)
    await play(bench, host, a, "example 4")
    await bench.until(await bench.nth_fall(10, start, "pout_n[1]") + 400)
    await play(bench, host, b, "example 4b")
    await host.wait_idle(4_000_000, BUSY)
    bench.check("example 4", "pulses", len(axis(bench, "example 4", 1, start)), 1000)


@directed()
async def manual_2104_examples_5(dut: Any) -> None:
    bench, host = await begin(dut)
    start = bench.now
    a, b = blocks(5)
    await play(bench, host, a, "example 5")
    await bench.until(await bench.nth_fall(5, start, "pout_n[1]") + 100)
    await play(bench, host, b, "example 5b")
    table = [3200, 1728, 1344, 1120, 992, 1120, 1344, 1728, 3200]
    bench.check("example 5", "intervals", bench.intervals(start, "pout_n[1]"), table)
    start = bench.now
    await play(bench, host, a[6:], "example 5, at start-up speed")
    await bench.until(await bench.nth_fall(1, start, "pout_n[1]") + 400)
    await host.command(0x41)
    await host.wait_idle(busy=BUSY)
    bench.check("example 5", "pulses", len(axis(bench, "example 5", 1, start)), 1)


@directed()
async def manual_2104_examples_6(dut: Any) -> None:
    bench, host = await begin(dut, csel=0b01)
    a, b = blocks(6)
    start = bench.now
    await play(bench, host, a, "example 6")
    await bench.until(await bench.nth_fall(7, start, "pout_n[2]") + 400)
    bench.check("example 6", "intervals", set(bench.intervals(start, "pout_n[2]")), {12_800})
    bench.set(**{"org_n[2]": 0})
    await bench.clocks(20)
    await play(bench, host, b, "example 6b")


@directed()
async def manual_2104_examples_7(dut: Any) -> None:
    bench, host = await begin(dut)
    a, b = blocks(7)
    start = bench.now
    await play(bench, host, a, "example 7")
    await bench.until(await bench.nth_fall(5, start, "pout_n[1]") + 400)
    bench.set(**{"fl_n[1]": 0})
    await bench.clocks(20)
    await play(bench, host, b, "example 7b")
    await bench.nth_fall(6, start, "pout_n[1]")
    bench.check("example 7", "dir", bench.level("dir[1]"), 1)


@directed()
async def manual_2104_examples_8(dut: Any) -> None:
    bench, host = await begin(dut, errint_n=0)
    a, b = blocks(8)
    await play(bench, host, a, "example 8")
    await host.wait_idle(busy=BUSY)
    await bench.clocks(4)
    bench.check("example 8", "int_n", bench.level("int_n"), 0)
    start = bench.now
    await play(bench, host, b[:2], "example 8b")
    bench.check("example 8", "int_n", bench.level("int_n"), 1)
    await play(bench, host, b[2:], "example 8b")
    bench.check("example 8", "last int_n", bench.edges("int_n", start)[-1][1], 1)
    await bench.clocks(200)
    bench.check("example 8", "int_n for good", bench.edges("int_n", start)[-1][1], 1)


@directed()
async def manual_2104_examples_9(dut: Any) -> None:
    bench, host = await begin(dut, ready=False)
    await play(bench, host, blocks(9)[0], "example 9")
    start = bench.now
    await bench.clocks(12_000)
    times = [t for t, _ in bench.edges("s1_n", start)][2:]
    gaps = sorted({b - a for a, b in zip(times, times[1:], strict=False)})
    bench.check("example 9", "phases", gaps, [768, 2040])
    await host.command(0x42)
    await host.wait_idle(busy=BUSY)
    end = bench.rises("pout_n[1]")[-1]
    delay = await bench.edge("hold", 0b11) - end
    bench.check_window("example 9", "HOLD delay", delay, 159_744, 159_744 + 16)


@directed()
async def manual_2104_examples_10_11(dut: Any) -> None:
    bench, host = await begin(dut)
    await play(bench, host, blocks(10)[0], "example 10")
    await host.wait_idle(busy=BUSY)
    bench.check("example 10", "s1_n", bench.level("s1_n"), 0b11101)
    bench, host = await begin(dut)
    start = bench.now
    await play(bench, host, blocks(11)[0], "example 11")
    bench.check("example 11", "dir", bench.level("dir[2]"), 1)
    await bench.nth_fall(4, start, "pout_n[2]")
    bench.check("example 11", "s2_n", bench.edges("s2_n", start), [])


@directed()
async def manual_2104_examples_12(dut: Any) -> None:
    bench, host = await begin(dut, ready=False, auxi=0b10)
    block = blocks(12)[0]
    for step, level in zip(block[:4], (0b10, 0b01, 0b11, 0b00), strict=True):
        await play(bench, host, [step], "example 12")
        bench.check("example 12", "auxo", bench.level("auxo"), level)
    await play(bench, host, block[4:], "example 12")


@directed()
async def manual_2104_examples_13(dut: Any) -> None:
    bench, host = await begin(dut, ready=False)
    a, b = blocks(13)
    await play(bench, host, a, "example 13")
    bench, host = await begin(dut)
    start = bench.now
    await play(bench, host, blocks(2)[0], "example 2")
    await bench.until(await bench.nth_fall(20, start, "pout_n[1]") + 400)
    await play(bench, host, b, "example 13b")


@directed()
async def manual_2104_examples_14(dut: Any) -> None:
    bench, host = await begin(dut)
    start = bench.now
    a, b = blocks(14)
    await play(bench, host, a[:-1], "example 14")
    bench.check("example 14", "pulses of axis 1", bench.pulses(start, "pout_n[1]"), [])
    await play(bench, host, a[-1:], "example 14, sent again")
    await bench.clocks(200)
    await play(bench, host, b, "example 14b")
    await bench.clocks(200)
    bench.check("example 14", "pulses of axis 1", len(bench.pulses(start, "pout_n[1]")), 1)


@directed()
async def manual_2104_examples_15(dut: Any) -> None:
    bench, host = await begin(dut)
    start = bench.now
    a, b, c = blocks(15)
    await play(bench, host, a[:1], "example 15")
    await bench.clocks(200)
    await play(bench, host, a[1:], "example 15")
    await bench.clocks(200)
    bench.check("example 15", "int_n before the handler", [v for _, v in bench.edges("int_n", start)], [0])
    await play(bench, host, b, "example 15b")
    await bench.clocks(200)
    edges = bench.edges("int_n", start)[1:]
    bench.check("example 15", "int_n by A0", [v for _, v in edges], [1, 0])
    bench.check_window("example 15", "int_n H", edges[1][0] - edges[0][0], 80, 82)
    await play(bench, host, c, "example 15c")
    await bench.clocks(200)
    bench.check("example 15", "int_n for good", [v for _, v in bench.edges("int_n", start)], [0, 1, 0, 1])
