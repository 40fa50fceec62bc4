"""Acceptance checks of the PPMC-312: limits, high-speed limits, origin search, zero return."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, rates, stopped
from openppmc.model.ppmc312.codes import Answer, Code

STOP = message(Code.STOP, "00")
START_30 = message(Code.RAMP, "00 0000 0000001E")


@directed("P312-CHK-34", "P312-CHK-35", "P312-BAD-12")
async def p312_limits(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.pins(fl_n=0)
    assert await host.ask(START_30) == message(Answer.LIMIT)
    assert await host.ask(message(Code.RAMP, "40 0000 00000002")) == message(Code.RAMP, "10")
    assert await host.response() == stopped(0x40, 0xFFFFFFFE)
    await host.pins(fl_n=1)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    await host.pulse(5)
    await host.pins(bl_n=0)
    edge = await host.pulse(10, 1595)
    await host.pins(fl_n=0)
    assert await host.response() == stopped(0x01, 8)
    assert edge == host.pulses()[-1]
    await host.pins(bl_n=0)
    assert (
        await host.ask(START_30)
        == await host.ask(START_30.replace("82 00", "82 40"))
        == message(Answer.LIMIT)
    )


@directed("P312-CHK-36", "P312-INP-12")
async def p312_high_speed_limit(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.SPEED_LIMIT, "00C8"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    await host.pulse(20)
    await host.pins(fhl_n=0)
    assert await host.response() == stopped(0x02, 32)
    assert host.gaps() == rates("100x20 100x5 200x4 400x2")
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 0064")) == message(Answer.LIMIT)
    assert await host.ask(message(Code.FOREVER_CONSTANT, "00 012C")) == message(Code.FOREVER_CONSTANT, "00")
    await host.pulse(10)
    await host.ask(STOP)
    assert await host.response() == stopped(0x04, 42)


@directed("P312-CHK-41", "P312-CHK-43", "P312-MOT-40", "P312-MOT-41")
async def p312_origin_search(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.ORIGIN_SEARCH, "10 00C8"))
    await host.pulse(50)
    await host.pins(org_n=0)
    await host.pulse(53)
    await host.pins(index_n=0)
    assert await host.response() == stopped(0x20, 53)
    assert await host.ask(message(Code.ORIGIN_SEARCH, "00 00C8")) == message(Code.ORIGIN_SEARCH, "00")
    assert await host.response() == stopped(0x20, 53) and not host.pulses()
    await host.pins(index_n=1)
    await host.ask(message(Code.ORIGIN_SEARCH, "10 00C8"))
    await host.pulse(20)
    await host.ask(STOP)
    assert await host.response() == stopped(0x04, 73)


@directed("P312-CHK-42", "P312-MOT-42")
async def p312_zero_return(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.ZERO_RETURN, "00 0000"))
    await host.pulse(15)
    await host.pins(org_n=0)
    await host.pulse(17)
    await host.pins(org_n=1)
    await host.pulse(27)
    await host.pulse(37, 4)
    assert host.bench.golden.position == 17
    await host.pulse(38)
    await host.pins(org_n=0)
    assert await host.response() == stopped(0x20, 16)
    assert len(host.pulses()) == 38
    turned = host.bench.rises("dir", host.mark)
    assert len(turned) == 1 and 6400 <= turned[0] - host.pulses()[26] <= 6464
    gaps = [
        round(gap / 16) for gap in (b - a for a, b in zip(host.pulses(), host.pulses()[1:], strict=False))
    ]
    assert gaps[:26] == rates("400x3 200x4 100x8 100x5 200x4 400x2") and gaps[27:] == [400] * 10
    assert await host.quiet()


@directed("P312-MOT-43")
async def p312_zero_return_ended_by_a_stop(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.ZERO_RETURN, "00 0000"))
    mark = host.mark
    await host.pulse(15)
    await host.pins(org_n=0)
    await host.pulse(18)
    assert await host.ask(message(Code.SLOW_STOP, "00")) == message(Code.SLOW_STOP)
    assert await host.response() == stopped(0x08, 27)
    host.mark = mark
    assert len(host.pulses()) == 27 and host.out("dir") == 0
