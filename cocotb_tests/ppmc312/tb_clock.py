"""Base clocks of the PPMC-312: other crystals and clock frequencies, shortest interval, EXTCK."""

from __future__ import annotations

from math import ceil
from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.harness.checks import check_intervals
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.builds import F8V, F27
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, stopped
from openppmc.model.ppmc312.codes import Code

STOP = message(Code.STOP, "00")


def highs(host: Host) -> list[int]:
    """Return the high times of pout since `mark`."""
    changes = host.bench.edges("pout", host.mark)
    return [b - a for (a, level), (b, _) in zip(changes, changes[1:], strict=False) if level]


@directed("P312-CHK-63", "P312-MOT-02", builds=(F27,))
async def p312_other_clock(dut: Any) -> None:
    host = await Host.start(dut, "02 03 01 00 03", TF[1], TF[2])
    await host.ask(message(Code.CONSTANT, "00 0064 00000032"))
    await host.response()
    first = host.pulses()[0]
    assert [edge - first for edge in host.pulses()] == [ceil(27 * 100 * k / 8) for k in range(50)]


@directed("P312-MOT-04", builds=(F8V,))
async def p312_shortest_interval_is_4_clk(dut: Any) -> None:
    host = await Host.start(dut, "02 03 01 00 02", "00 04 0002 0064", "01 06 000005 000005")
    await host.ask(message(Code.CONSTANT, "00 0002 00000006"))
    await host.response()
    assert [b - a for a, b in zip(host.pulses(), host.pulses()[1:], strict=False)] == [4] * 5


@directed("P312-CHK-71", "P312-BAD-14")
async def p312_external_clock_that_stops(dut: Any) -> None:
    host = await Host.start(dut, "02 03 01 06 03", TF[1], TF[2])

    async def tick(count: int) -> None:
        for _ in range(count):
            await host.pins(extck=1)
            await host.pause(10)
            await host.pins(extck=0)
            await host.pause(10)

    await host.ask(message(Code.CONSTANT, "00 0064 00000005"))
    await host.pause(100)
    await tick(201)
    assert len(host.pulses()) == 3
    await host.pause(1000)
    assert highs(host) == [80] * 3 and host.condition == 0x08
    await host.ask(STOP)
    assert await host.response() == stopped(0x04, 3)
    await host.ask(message(Code.CONSTANT, "00 0064 00000005"))
    await host.pause(1000)
    await host.ask(STOP)
    assert await host.response() == stopped(0x04, 3) and not host.pulses()


@directed("P312-MOT-02", "P312-MOT-03")
async def p312_external_clock_counts(dut: Any) -> None:
    host = await Host.start(dut, "02 03 01 07 02", "00 04 0006 0064", "01 06 000005 000005")
    await host.ask(message(Code.CONSTANT, "00 0006 00000004"))
    await host.pause(100)
    falls: list[int] = []
    while len(host.pulses()) < 4:
        await host.pins(extck=1)
        await host.pause(4)
        await host.pins(extck=0)
        falls.append(host.t - 1)
        await host.pause(5)
    assert host.pulses()[0] - falls[0] in range(1, 5)
    gaps = [b - a for a, b in zip(host.pulses(), host.pulses()[1:], strict=False)]
    period = falls[1] - falls[0]
    check_intervals(host.bench, "P312-MOT-02", gaps, [6 * period] * 3)
    check_intervals(host.bench, "P312-MOT-03", highs(host)[:3], [3 * period] * 3)
