"""Runs the sessions of docs/ppmc104/examples.md on the core: every byte must equal the printed byte."""

from __future__ import annotations

from cocotb_tests.harness import DutBench, HostBus, directed, start_bench
from cocotb_tests.harness.sessions import Sessions

from .bench import PPMC104

SESSIONS = Sessions("ppmc104", brief=(0x42, 0x52, 0x5A))  # single steps last 10 µs
blocks, play = SESSIONS.blocks, SESSIONS.play


async def begin(dut, first: bool = True) -> tuple[DutBench, HostBus]:
    bench = await start_bench(dut, PPMC104)
    host = HostBus(bench)
    if first:
        await play(bench, host, blocks(1)[0], "example 1")
    return bench, host


@directed()
async def manual_examples(dut):
    """The examples of the manual, each group after a reset, produce the printed bytes."""
    bench, host = await begin(dut)  # 1
    start = bench.now
    two = blocks(2)
    await play(bench, host, two[0], "example 2")
    await host.wait_idle(timeout=3_000_000)
    pulses = bench.pulses(start)
    bench.check("example 2", "pulses", len(pulses), 1000)
    bench.check("example 2", "clk", pulses[-1] - pulses[0], 1_795_008)
    bench.check("example 2", "int_n", bench.level("int_n"), 0)
    await play(bench, host, two[1], "example 2b")
    bench.check("example 2", "int_n", bench.level("int_n"), 1)


@directed()
async def manual_examples_3(dut):
    bench, host = await begin(dut)
    start = bench.now
    a, b = blocks(3)
    await play(bench, host, a, "example 3")
    tenth = await bench.nth_fall(10, since=start)
    await bench.until(tenth + 400)
    await play(bench, host, b, "example 3b")


@directed()
async def manual_examples_5(dut):
    bench, host = await begin(dut)
    bench.set(csel=0)
    a, b = blocks(5)
    start = bench.now
    await play(bench, host, a, "example 5")
    await bench.until(await bench.nth_fall(7, since=start) + 400)
    pulses = bench.pulses(start)
    bench.check("example 5", "interval", pulses[1] - pulses[0], 12_800)
    bench.set(cnp_n=0)
    await bench.clocks(20)
    await play(bench, host, b, "example 5b")


@directed()
async def manual_examples_6(dut):
    bench, host = await begin(dut)
    a, b = blocks(6)
    start = bench.now
    await play(bench, host, a, "example 6")
    await bench.until(await bench.nth_fall(5, since=start) + 400)
    bench.set(l1_n=0)
    await bench.clocks(20)
    await play(bench, host, b, "example 6b")


@directed()
async def manual_examples_7(dut):
    bench, host = await begin(dut)
    a, b = blocks(7)
    await play(bench, host, a, "example 7")
    await host.wait_idle()
    await play(bench, host, b, "example 7b")
    await host.wait_idle()
    bench.check("example 7", "s", bench.level("s"), 0b00011)
    bench.check("example 7", "int_n", bench.level("int_n"), 1)


@directed()
async def manual_examples_8(dut):
    bench, host = await begin(dut, first=False)
    await play(bench, host, blocks(8)[0], "example 8")
    start = bench.now
    await bench.clocks(12_000)
    times = [t for t, _ in bench.edges("s", start)][3:]
    gaps = sorted({b - a for a, b in zip(times, times[1:], strict=False)})
    bench.check("example 8", "phases", gaps, [1200, 2064])


@directed()
async def manual_examples_9_10(dut):
    bench, host = await begin(dut)
    await play(bench, host, blocks(9)[0], "example 9")
    await host.wait_idle()
    bench.check("example 9", "s", bench.level("s"), 0b00010)
    bench, host = await begin(dut)
    await play(bench, host, blocks(10)[0], "example 10")
    bench.check("example 10", "dir", bench.level("dir"), 1)
    await bench.clocks(20_000)
    bench.check("example 10", "s", bench.level("s"), 0b00011)


@directed()
async def manual_examples_11_12(dut):
    bench, host = await begin(dut, first=False)
    bench.set(auxi=0b1001)
    await bench.clocks(4)
    await play(bench, host, blocks(11)[0], "example 11")
    bench.check("example 11", "auxo", bench.level("auxo"), 0b1010)
    bench, host = await begin(dut, first=False)
    a, b = blocks(12)
    await play(bench, host, a, "example 12")
    bench, host = await begin(dut)
    start = bench.now
    await play(bench, host, blocks(2)[0], "example 2")
    await bench.nth_fall(20, since=start)
    await play(bench, host, b, "example 12b")
