"""Delays from input pins of the PPMC-312 to their effects."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import F16, directed
from cocotb_tests.harness.checks import check_delays
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.builds import F27
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Code

EXTERNAL = ("02 03 01 06 02", "00 04 0006 0064", "01 06 000005 000005")
"""Set-up with the rising edges of EXTCK as base clock."""
FOREVER = message(Code.FOREVER_CONSTANT, "00 0064")
LIMIT_DELAY = 2
"""Edges from the first edge that samples a limit to the first edge on which no pulse begins."""


@directed("P312-INP-01", "P312-MOT-01", builds=(F16, F27))
async def p312_inp_01_delays(dut: Any) -> None:
    """Alarm, RUN and EXTCK take effect after the same number of cycles each time; with JITTER=1, also one
    cycle later.
    """
    host = await Host.start(dut, *TF)
    bench, alarms, runs, clocks = host.bench, [], [], []
    for _ in range(8):
        await host.pause(bench.rng.randrange(40))
        alarm = bench.set(alm_n=0)
        await host.pause(9)
        alarms.append(bench.falls("cd_n", alarm)[0] - alarm)
        bench.set(alm_n=1)
        await bench.reset(40, settle=8)
        await host.ready(100)
        for block in TF:
            await host.ask(block)
        bench.set(run=0)
        await host.ask(message(Code.STEP, "00"))
        await host.pause(100 + bench.rng.randrange(40))
        run = bench.set(run=1)
        await host.pause(2 * bench.config.w)
        runs.append(host.pulses()[0] - run - bench.config.w)
    check_delays(bench, "P312-INP-01", "from alm_n to cd_n", alarms, 2, 4)
    check_delays(bench, "P312-INP-20", "from run to pulse 1, less TW", runs, 2, 4)
    host = await Host.start(dut, *EXTERNAL)
    await host.ask(message(Code.CONSTANT, "00 0006 00000010"))
    await host.pause(2 * bench.config.w)
    rises = []
    while len(host.pulses()) < 16:
        rises.append(host.t)
        await host.pins(extck=1)
        await host.pause(7)
        await host.pins(extck=0)
        await host.pause(7)
    clocks = [pulse - max(edge for edge in rises if edge < pulse) for pulse in host.pulses()]
    check_delays(host.bench, "P312-MOT-01", "from extck to pout", clocks, 2, 3)


@directed("P312-INP-01", "P312-INP-12")
async def p312_inp_12_limit_around_a_pulse(dut: Any) -> None:
    """A limit that is sampled LIMIT_DELAY cycles before a pulse prevents it; a later limit does not. With
    JITTER=1, both occur at that edge.
    """
    host = await Host.start(dut, *TF)
    bench, seen = host.bench, {}
    for early in (LIMIT_DELAY - 1, LIMIT_DELAY, LIMIT_DELAY + 1) * 8:
        await host.ask(FOREVER)
        second = await host.pulse(2)
        pulse = second + host.pulses()[1] - host.pulses()[0]
        await host.go(pulse - early)
        bench.set(fl_n=0)
        await host.pause(2 * bench.config.w)
        seen.setdefault(early, set()).add(len(host.pulses()) == 2)
        bench.set(fl_n=1)
        await host.response()
    expected = {LIMIT_DELAY - 1: {False}, LIMIT_DELAY: {True}, LIMIT_DELAY + 1: {True}}
    if bench.slack:
        expected[LIMIT_DELAY] = {False, True}
    bench.check("P312-INP-12", "pulses prevented, by the lead of the limit", seen, expected)
