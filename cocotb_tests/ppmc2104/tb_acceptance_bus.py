"""Acceptance checks AC-64 to AC-66 and AC-77 to AC-85 at the pins: clocks, bus, reset, stops in a data
wait.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import F8, F11, F16, F48, F100, OBF, directed, rtl_only
from cocotb_tests.harness.axis_driver import differences
from cocotb_tests.harness.config import F16X8

from .env import Env
from .expected_timing import CMND2, INIT_B
from .tb_acceptance_errors import EX_03, clk
from .tb_acceptance_moves import AC_09


@directed("AC-64", "P2104-BCK-03", "P2104-EX-12", "P2104-GEN-04", builds=(F11,))
async def p2104_ac_64_no_drift(dut: Any) -> None:
    """With CLK_HZ = 11 059 200 and rate 1, fall number t + 1 occurs ceil(44.2368 t) cycles after the first
    fall (AC-64).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    pulses = await axis.move(0x44, 1001, 1)
    # 442 368 = 44.2368 · 10^4.
    expected = [-(-442_368 * t // 10_000) for t in range(1001)]
    env.check("AC-64", "falls", [t - pulses[0] for t in pulses], expected)
    env.check("AC-64", "EX-12", [expected[t] for t in (1, 2, 3, 1000)], [45, 89, 133, 44_237])
    env.check("AC-64", "last low time: W", axis.low_times[-1], 56)


@directed("AC-65", "P2104-GEN-03", "P2104-GEN-04", builds=(F16X8,))
async def p2104_ac_65_crystal_of_8_mhz(dut: Any) -> None:
    """With XTAL_HZ = 8 MHz, all times of AC-09 and of a step are twice as long (AC-65)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.move(0x43, 25)
    env.check("AC-65", "intervals", axis.intervals, [2 * clk for clk in AC_09])
    env.check("AC-65", "low times", axis.low_times, [160] * 25)
    await axis.move(0x42)
    hold = await env.bench.edge("hold[1]", 1)
    rise = env.bench.rises("pout_n[1]", axis.since)[-1]
    env.window("AC-65", "pout_n to hold", hold - rise, 102_400, 102_424)


@rtl_only("clk_o is not in the model: it never stops and depends on nothing")
@directed("AC-66", "P2104-PORT-06", builds=(F16, F48, F11, F8, F100, F16X8))
async def p2104_ac_66_clk_o(dut: Any) -> None:
    """For each clock, toggle number t of clk_o occurs CYC(2 t) after reset (AC-66)."""
    env = await Env.start(dut)
    bench = env.bench
    await bench.reset(settle=0)
    release = bench.now
    bench.watch("clk_o")
    await bench.clocks(4_000)
    edges = [t - release for t, _ in bench.edges("clk_o")]
    expected = [env.cfg.cyc(2 * t) for t in range(1, len(edges) + 1)]
    env.check("AC-66", "first level", bench.edges("clk_o")[0][1], 1)
    offsets = {got - want for got, want in zip(edges, expected, strict=True)}
    env.check("AC-66", "offset is constant", len(offsets), 1)
    env.window("AC-66", "offset", offsets.pop(), -2, 2)
    env.window("AC-66", "last toggle", edges[-1], 4_000 - 20, 4_002)
    spans = {F16: {2}, F48: {6}, F11: {1, 2}}.get(env.cfg)
    if spans:
        env.check("AC-66", "half periods", set(differences(edges)), spans)


@directed("AC-77", "P2104-BUS-02", "P2104-BAD-11", "P2104-BAD-13")
async def p2104_ac_77_strobes_together(dut: Any) -> None:
    """If both strobes are low, there is no access; if cs_n rises before the write strobe, the byte is stored
    (AC-77).
    """
    env = await Env.start(dut)
    bench = env.bench
    bench.set(a0=1, d_i=0xF1, cs_n=0, ds_wrs_n=0, rw_rds_n=0)
    await bench.clocks(10)
    bench.set(cs_n=1, ds_wrs_n=1, rw_rds_n=1)
    await bench.clocks(14)
    env.check("AC-77", "edges of d_oe", bench.edges("d_oe"), [])
    env.check("AC-77", "status", await env.host.status(), 0x00)
    env.check("AC-77", "auxo", bench.level("auxo"), 0b11)
    bench.set(a0=1, d_i=0xF1, cs_n=0, ds_wrs_n=0)
    await bench.clocks(4)
    bench.set(cs_n=1)
    await bench.clocks(1)
    bench.set(ds_wrs_n=1, d_i=0x00)
    await bench.clocks(12)
    env.check("AC-77", "auxo after the byte", bench.level("auxo"), 0b00)


@directed("AC-78", "P2104-BAD-23", "P2104-PORT-03", "P2104-AUX-06", "P2104-HLD-01")
async def p2104_ac_78_reset_in_motion(dut: Any) -> None:
    """If rst_n falls between two edges while both axes move, the state after this reset is the state after
    power-on (AC-78).
    """
    env = await Env.start(dut)
    bench = env.bench
    axes = await env.both(INIT_B)
    for axis in axes:
        await axis.send(0x85, [0])
        await axis.send(0x84, [0x40, 0x40])
    await env.run("c D1 c 87 c 83")
    for axis in axes:
        await axis.running(0x31, code=0x4D)
    await bench.set_between(rst_n=0)
    levels, reset = {name: bench.level(name) for name in bench.outputs}, bench.part.reset_levels()
    env.check("AC-78", "outputs at once", levels, {name: reset[name] for name in bench.outputs})
    await bench.clocks(4)
    bench.set(rst_n=1)
    await bench.clocks(8)
    env.check("AC-78", "status", await env.host.status(), 0x00)
    env.check("AC-78", "42, e1, 80, e2", await env.run("c 42 e1 c 80 r e2"), [4, 0, 0])
    for axis in axes:
        await axis.init(0x12, *INIT_B[1:])
        await axis.go(0x42)
        await axis.idle()
        await bench.clocks(52_000)
        (down, _), (up, _) = axis.edges("hold")
        rise = bench.rises(axis.pout, axis.since)[-1]
        env.window("AC-78", "pout_n rise to hold, n = 18h", up - rise, 51_200, 51_224)
        spans = {(0b11001, 664), (0b11111, 1328)}
        env.check("AC-78", "switching", set(axis.stretches(rise)[1:]), spans)
        await axis.send(0xC0)


@directed("AC-79", "P2104-BUS-08", "P2104-BUS-09", "P2104-HSK-06", "P2104-BAD-09", "P2104-STA-02")
async def p2104_ac_79_three_bytes(dut: Any) -> None:
    """After code 83 for a stopped move, 2-cycle strobes read the low, middle and high byte, then the last
    byte again (AC-79).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x43, 0x0A0B0C + 5)
    await axis.pulse(4, 50)
    await axis.halt()
    for gap in (2, 3, 8):
        await env.host.command(0x83)
        got = []
        for place in range(3):
            env.check("AC-79", f"OBF before byte {place}", await env.host.status() & OBF, OBF)
            got.append(await env.host.read(0, strobe=2, gap=gap))
            seen = [await env.host.status() & OBF for _ in range(3)]
            env.check("AC-79", f"OBF after byte {place}", seen[-1], int(place < 2))
            env.check("AC-79", f"OBF never falls again after byte {place}", seen, sorted(seen))
        env.check("AC-79", "bytes", got, [0x0C, 0x0B, 0x0A])
        env.check("AC-79", "fourth read", await env.host.read(0, strobe=2), 0x0A)
        env.check("AC-79", "status", await env.host.status(), 0x00)


@directed("AC-80", "P2104-OPR-06", "P2104-EX-10")
async def p2104_ac_80_thousand_pulses(dut: Any) -> None:
    """At constant speed, FL after 1000 pulses results in end status 95 and 16 776 215 remaining pulses
    (AC-80).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x45, rate=0x31)
    await env.bench.clocks(999 * 1600)
    await axis.pulse(1000, 400)
    axis.set(fl_n=0)
    await axis.result("AC-80", 1000, 0x95)
    env.check("AC-80", "83", await env.run("c 83 rrr"), [0x17, 0xFC, 0xFF])


@directed("AC-81", "P2104-RD-04", "P2104-LIM-10")
async def p2104_ac_81_control_input(dut: Any) -> None:
    """Code 81 returns 0 in the bit of an active input of its axis, regardless of the other axis (AC-81)."""
    env = await Env.start(dut)
    answers = {"org_n": 0x4F, "alm_n": 0x8F, "fl_n": 0xC7, "fhl_n": 0xCB, "bl_n": 0xCD, "bhl_n": 0xCE}
    for axis in env.axes:
        for pin, answer in answers.items():
            axis.set(**{pin: 0})
            await env.bench.clocks(4)
            env.check("AC-81", f"{pin}[{axis.n}]", await axis.fetch(0x81), [answer])
            axis.set(**{pin: 1})
    await env.bench.clocks(4)
    env.x2.set(**dict.fromkeys(answers, 0))
    await env.bench.clocks(4)
    env.check("AC-81", "81, A1", await env.run("c 81 r c A1 r"), [0xCF, 0x00])


@directed("AC-82", "P2104-STP-07", "P2104-ERR-02")
async def p2104_ac_82_stop_in_a_data_wait(dut: Any) -> None:
    """While axis 2 waits for data, code 40 stops the moving axis 1 and sets error 3 (AC-82)."""
    env = await Env.start(dut)
    first, second = await env.both(INIT_B)
    await first.go(0x45, rate=0x31)
    await first.pulse(20, 400)
    env.check("AC-82", "CMND2", (await env.host.status()) & CMND2, 0)
    await env.run("c 63 d 05")
    env.check("AC-82", "CMND2", (await env.host.status()) & CMND2, CMND2)
    await env.run("c 40")
    await first.idle()
    env.check("AC-82", "status", await env.host.status(), 0x80)
    env.check("AC-82", "80, e2, e1", await env.run("c 80 r e2 e1"), [0xC5, 0, 3])
    env.check("AC-82", "d 00, e1", await env.run("d 00 e1"), [2])
    await env.bench.clocks(4000)
    pulses = len(first.pulses), len(env.bench.pulses(0, second.pout))
    env.check("AC-82", "pulses of both axes", pulses, (20, 0))


@directed("AC-83", "P2104-STP-07", "P2104-EX-03")
async def p2104_ac_83_deceleration_stop_in_a_data_wait(dut: Any) -> None:
    """While axis 2 waits for data, code 41 decelerates axis 1 on its ramp (AC-83)."""
    env = await Env.start(dut)
    first, _ = await env.both(INIT_B)
    await first.go(0x43, 1000)
    await first.pulse(5, 100)
    await env.run("c 63 c 41")
    env.check("AC-83", "e1", await env.run("e1"), [3])
    await first.result("AC-83", 10, 0xC3, 0x3DD)
    env.check("AC-83", "intervals", first.intervals, clk(EX_03[5]))


@directed("AC-84", "P2104-ERR-02", "P2104-FSM-05")
async def p2104_ac_84_refused_stop_in_a_data_wait(dut: Any) -> None:
    """During constant speed and a data wait, code 41 sets error 8; code 40 at standstill then sets error 3,
    not error 6 (AC-84).
    """
    env = await Env.start(dut)
    first, _ = await env.both(INIT_B)
    await first.running(0x31)
    env.check("AC-84", "status, e1", await env.run("c 64 d 31 c 41 s e1"), [0x84, 8])
    await first.pulse(8)
    env.check("AC-84", "intervals", first.intervals, [1600] * 7)
    await first.halt()
    env.check("AC-84", "e1", await env.run("c 43 c 40 e1"), [3])


@directed("AC-85", "P2104-HSK-04", "P2104-STP-04")
async def p2104_ac_85_stops_do_not_wait(dut: Any) -> None:
    """While the table of axis 1 is built, stops are accepted immediately (AC-85)."""
    env = await Env.start(dut)
    first, second = env.axes
    await env.ready(2, INIT_B)
    await second.running(0x31)
    await env.run("c 02 d FF d 01 d 04")
    await env.host.data(0x00, poll=False)
    for code in (0x40, 0x60):
        edge0 = await env.host.command(code, poll=False)
        await env.bench.until(edge0 + 10)
        status = await env.host.status()
        env.check("AC-85", f"IBF, CMND1 after {code:#x}", status & 0x12, 0x10)
    taken = edge0 + 10
    env.check("AC-85", "e1", await env.run("e1"), [6])
    await first.ready()
    env.check("AC-85", "pulses of axis 2 after 60", env.bench.pulses(taken, second.pout), [])
