"""Ports, synchronisers, reset, parameters (P2104-PORT-02…04, P2104-PAR-01)."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import Timer, ValueChange
from cocotb.utils import get_sim_time

from cocotb_tests.harness import COMMAND, D16, DATA, F16, F48, F100, STATUS, directed, rtl_only
from cocotb_tests.harness.checks import check_delays, clock_delays
from cocotb_tests.harness.config import F16X8

from .env import Env
from .expected_timing import INIT_A


@rtl_only("glitches between two clk edges, which the model never sees")
@directed("P2104-PORT-02", "P2104-GEN-08", builds=(F16, F48))
async def p2104_port_02_registers_only(dut: Any) -> None:
    """During glitches between edges of `clk`, outputs change only on rising edges (P2104-PORT-02)."""
    env = await Env.start(dut)
    first, _ = await env.both(INIT_A)
    bench = env.bench
    rising = (int(get_sim_time("ps")) + bench.half) % bench.period
    wrong = []

    async def watch(name: str) -> None:
        while True:
            await ValueChange(getattr(bench.dut, name))
            if int(get_sim_time("ps")) % bench.period != rising:
                wrong.append((name, bench.now))

    for name in bench.part.outputs:
        cocotb.start_soon(watch(name))
    bench.set(run=0)
    await first.go(0x43, 9)
    bench.set(run=3)
    await first.pulse(3)
    before = [t for name in ("int_n", "d_oe", "auxo") for t in bench.edges(name)]
    away = {"alm_n": 0, "fl_n": 0, "fhl_n": 0, "org_n": 0, "cs_n": 0, "ds_wrs_n": 0, "rw_rds_n": 0}
    away |= {"auxi": 3, "a0": 1, "errint_n": 0, "extck": 3, "csel": 0, "run": 0, "d_i": 0xFF}
    for pin, level in away.items():
        back = bench.pins[pin]
        await bench.align()
        await Timer(bench.half // 4, "ps")
        bench.set_between_edges(**{pin: level})
        await Timer(bench.half // 4, "ps")
        bench.set_between_edges(**{pin: back})
        await bench.clocks(6)
    after = [t for name in ("int_n", "d_oe", "auxo") for t in bench.edges(name)]
    env.check("P2104-PORT-02", "edges of int_n, d_oe, auxo from glitches", after, before)
    await first.result("P2104-PORT-02", 9, 0x83, 0)
    await env.run("c D1 c C1 c 81 r c A0 r")
    env.check("P2104-PORT-02", "output changes off the rising edge", wrong, [])


@directed("P2104-PORT-02", "P2104-LIM-01", "P2104-BCK-04", builds=(F16, F100))
async def p2104_port_02_all_inputs_alike_late(dut: Any) -> None:
    """Limit, alarm, run and clock pins of both axes take effect with the same delay of two stages; with
    JITTER=1, also one cycle later (P2104-PORT-02).
    """
    env = await Env.start(dut)
    ends, runs = [], []
    for axis in await env.both(INIT_A):
        for pin, code in (("fl_n", 0x45), ("bl_n", 0x4D), ("alm_n", 0x45), ("org_n", 0x47)):
            await axis.go(code, rate=99)
            await axis.pulse(1, env.cfg.w + 20)
            stamp = axis.set(**{pin: 0})
            ends.append(await axis.wait_end() - stamp)
            axis.set(**{pin: 1})
            await axis.finish()
        for _ in range(8):
            axis.set(run=0)
            await axis.go(0x42)
            stamp = axis.set(run=1)
            runs.append(await axis.pulse(1) - stamp - env.cfg.w)
            await axis.idle()
            await axis.finish()
        check_delays(axis.bench, "P2104-END-02", "from pin to int_n", ends, 2, 7)
        check_delays(axis.bench, "P2104-TIM-02", "from run to pulse 1, less W", runs, 0, 5)
    env = await Env.start(dut)
    for axis in await env.both((0x0A, 9, 4, 4)):
        check_delays(axis.bench, "P2104-BCK-04", "from extck to pout_n", await clock_delays(axis), 2, 4)


@directed("P2104-PORT-03", "P2104-PORT-01", "P2104-PHS-02", "P2104-PAR-01", builds=(F16, F16X8, F48, D16))
async def p2104_port_03_reset(dut: Any) -> None:
    """Bytes written during reset are not stored; a write that is sampled on edge 4 after the release is
    accepted (P2104-PORT-03).
    """
    env = await Env.start(dut)
    bench = env.bench
    if not env.cfg.datasheet:
        for axis in await env.both(INIT_A):
            await axis.move(0x4A)
    await env.run("c F1 c 87 c 81")
    await env.host.poll(0x01, 0x01)
    bench.set(rst_n=0)
    await bench.clocks(3)
    env.all_reset("P2104-PORT-03")
    await env.host.write(COMMAND, 0xD1)
    bench.set(a0=STATUS, **env.host.style.read_on)
    await bench.clocks(4)
    env.all_reset("P2104-PORT-03")
    bench.set(**env.host.style.read_off)
    await bench.clocks(3)
    release = bench.set(rst_n=1)
    await bench.until(release + 4)
    await env.host.write(COMMAND, 0x84, strobe=2)
    await bench.clocks(10)
    env.check("P2104-PORT-03", "status after a write at edge 4", await env.host.status(), 0x10)
    env.check("P2104-PORT-03", "the write in reset is lost", bench.level("auxo"), 0b11)
    env.check("P2104-PORT-03", "the output byte is gone", await env.host.read(DATA), 0x00)
    await bench.reset(2)
    env.check("P2104-PORT-03", "status after reset", await env.host.status(), 0x00)


@directed("P2104-PORT-04", "P2104-BAD-20", "P2104-LIM-08")
async def p2104_port_04_tied_inputs(dut: Any) -> None:
    """With extck and auxi tied to 0 or 1, motions of both axes on the crystal clock are not affected
    (P2104-PORT-04).
    """
    env = await Env.start(dut)
    axes = await env.both(INIT_A)
    for level in (0, 3):
        env.bench.set(extck=level, auxi=level)
        for code in (0x43, 0x4B, 0xC3):
            for axis in axes:
                await axis.go(code, 12)
            for axis in axes:
                await axis.result("P2104-PORT-04", 12, 0x83, 0)
        env.check("P2104-PORT-04", "81, A1", await env.run("c 81 r c A1 r"), [0xCF, 0xCF])
