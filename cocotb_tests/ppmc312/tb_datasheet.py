"""DATASHEET times of the PPMC-312 (P312-TIM)."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import D16, directed
from cocotb_tests.harness.bus import CSR, MREF
from cocotb_tests.ppmc312.blocks import T1, T2, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code

STOP = message(Code.STOP, "00")


@cocotb.parametrize(
    case=[
        (T1, 115),
        (message(Code.INITIAL, "11 03E8 01F4 00C8 0007D0 0005DC"), 200),
        (T2, 175),
        (message(Code.INITIAL, "19 03E8 01F4 00C8 0007D0 0005DC"), 260),
    ]
)
@directed("P312-CHK-65", "P312-TIM-02", "P312-TIM-03", "P312-TIM-04", "P312-TIM-05", builds=(D16,))
async def p312_datasheet_setting_times(dut: Any, case: Any) -> None:
    setting, ms = case
    host = await Host.start(
        dut,
    )
    await host.issue(setting)
    await host.go(host.header + ms * 16_000 - 16)
    assert await host.read(CSR) & MREF and host.condition == 0x01
    await host.go(host.header + ms * 16_000 + 16)
    assert not await host.read(CSR) & MREF and host.condition == 0x02


@directed("P312-INP-01", "P312-INP-20", "P312-TIM-14", "P312-CMD-27", builds=(D16,))
async def p312_datasheet_run_is_the_plain_pin(dut: Any) -> None:
    """RUN starts and holds an operation without the 200 us filter that the other pins have.

    Instruction 27 returns the unfiltered levels of these pins.
    """
    host = await Host.start(dut, *TF)
    for low in (1 + host.bench.slack, 2 + host.bench.slack, 100, 5000):
        await host.pins(run=0)
        await host.ask(message(Code.FOREVER_CONSTANT, "00 0190"))
        assert host.condition == 0x20
        mark = host.mark = host.t
        await host.pins(run=1)
        await host.pause(low - 1)
        await host.pins(run=0)  # RUN sampled high for one cycle is enough
        assert (
            await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
            and host.condition == 0x08
        )
        host.mark = mark
        assert await host.pulse(1) - mark in range(80, 80 + 8)
        await host.ask(STOP)
        await host.response()
    # RUN is low for 20 cycles. The level takes effect only if it is sampled directly before t0.
    host = await Host.start(dut, *TF)
    await host.issue(message(Code.STEP, "00"))
    delay = await host.pulse(1) - 80 - host.header
    for before, held in ((300, False), (40, False), (12, True), (-20, False)):
        host = await Host.start(dut, *TF)
        await host.issue(message(Code.STEP, "00"))
        await host.go(host.header + delay - before)
        await host.pins(run=0)
        await host.pause(19)
        await host.pins(run=1)
        assert await host.response() == message(Code.STEP)
        assert (await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)) == held, before
    host = await Host.start(dut, *TF)
    await host.pins(fl_n=0, alm_n=0, org_n=0)
    assert (
        await host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "6D E0") and host.condition == 0x02
    )
    await host.pins(fl_n=1, alm_n=1, org_n=1)


@directed("P312-TIM-13", "P312-TIM-20", builds=(D16,))
async def p312_datasheet_output_time_and_ready_time(dut: Any) -> None:
    host = await Host.start(
        dut,
    )
    assert host.bench.edges("out_oe")[0][0] - 25_600 in range(0, 8)
    await host.issue(message(Code.OUTPUT, "01"))
    await host.wait()
    (edge,) = host.bench.edges("auxo_n")
    assert abs(edge[0] - host.header - 4800) <= 16
    assert await host.response() == message(Code.OUTPUT)
    await host.issue(message(Code.INITIAL, "01 03E8 03E8 0007D0"))
    await host.pause(4096)
    assert (await host.response()).startswith("03 0B F0 03")


@cocotb.parametrize(
    case=[
        (message(Code.RAMP, "40 0000 0000001E"), 100),
        (message(Code.RAMP, "40 0000 00000007"), 700),
        (message(Code.RAMP, "40 0096 00000014"), 900),
        (message(Code.RAMP, "40 0096 00000007"), 1400),
        (message(Code.CONSTANT, "40 0190 00000003"), 400),
        (message(Code.FOREVER_CONSTANT, "40 0190"), 400),
        (message(Code.FOREVER_RAMP, "40 0000"), 60),
        (message(Code.FOREVER_RAMP, "40 0096"), 400),
        (message(Code.ZERO_RETURN, "40 0000"), 60),
        (message(Code.ZERO_RETURN, "40 0096"), 400),
        (message(Code.ORIGIN_SEARCH, "40 0190"), 500),
        (message(Code.STEP, "40"), 500),
    ]
)
@directed(
    "P312-CHK-68",
    "P312-TIM-06",
    "P312-TIM-07",
    "P312-TIM-08",
    "P312-TIM-09",
    "P312-TIM-10",
    "P312-TIM-11",
    builds=(D16,),
)
async def p312_datasheet_start_times(dut: Any, case: Any) -> None:
    block, us = case
    host = await Host.start(dut, *TF)
    await host.issue(block)
    header = host.header
    await host.pulse(1)
    assert abs(host.pulses()[0] - header - 16 * us) <= 16
    assert host.pulses()[0] - host.bench.rises("dir", host.mark)[0] in (80, 81, 82)


@directed("P312-TIM-12", "P312-TIM-14", builds=(D16,))
async def p312_datasheet_stop_and_pins(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    await host.pulse(5, 10)
    await host.issue(STOP)
    header = host.header
    assert await host.response() == message(Code.STOP)
    host.mark = mark
    assert header < host.pulses()[-1] <= header + 5616
    assert host.pulses()[-1] > header + 5600 - 1700
    await host.response()
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    await host.pulse(5, 10)
    await host.pins(fl_n=0)
    await host.pause(3000)
    await host.pins(fl_n=1)
    low = host.t
    await host.pins(fl_n=0)
    assert (await host.response()).startswith("23 06 E0 01")
    assert low + 3200 - 1700 < host.pulses()[-1] <= low + 3205


@directed("P312-TIM-12", "P312-BLK-01", builds=(D16,))
async def p312_datasheet_stop_of_what_ends_by_itself(dut: Any) -> None:
    """Instruction 80 is validated when it arrives.

    If a motion ends before the stop is executed, this is not an error. The status is RDY when the 350 us of
    the stop have passed.
    """
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.CONSTANT, "00 0064 00000008"))
    mark = host.mark
    await host.pulse(7, 10)
    await host.issue(STOP)
    header = host.header
    assert (
        await host.response() == message(Answer.STOPPED, "40 00 00 00 08", source=SPONTANEOUS)
        and host.condition == 0x02
    )
    assert host.t < header + 5600 - 2000
    assert await host.response() == message(Code.STOP) and host.t > header + 5600 - 16
    host.mark = mark
    assert len(host.pulses()) == 8 and await host.quiet()
