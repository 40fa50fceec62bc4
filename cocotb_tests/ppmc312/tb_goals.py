"""Goals of a replacement: 2 Mpps, pulse 1 within 20 us of the instruction, tables within 5 ms.

The tests run at 50 MHz, where a period of the base clock is not a whole number of cycles. The measured values
are printed.
"""

from __future__ import annotations

from math import ceil
from typing import Any

from cocotb_tests.harness import F50, directed
from cocotb_tests.ppmc312.blocks import T1
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code
from openppmc.model.ppmc312.stages import build

MHZ = 50
CLK = MHZ * 1_000_000
SIGMOID = message(Code.INITIAL, "18 2000 2000 0040 00EA60 00EA60")
STARTS = ("82 00 0000 00001388", "82 00 0000 00000065", "83 00 00C8 00000003", "84 00")
STARTS += ("86 40 0000", "85 00 0000", "11 00 0000", "10 00 00C8")
FAST = ("02 03 01 00 03", "00 06 0004 0008 0010", "01 09 000032 000014 00000A")


@directed("P312-MOT-01", "P312-MOT-02", "P312-MOT-05", "P312-MOT-07", "P312-CHK-63", builds=(F50,))
async def p312_two_million_pulses_a_second(dut: Any) -> None:
    """With F = 8 MHz and rate 4, each of 3000 pulses is output in its exact cycle."""
    host = await Host.start(dut, *FAST)
    await host.ask(message(Code.RAMP, "00 0000 00000BB8"))
    assert await host.response() == message(Answer.STOPPED, "40 00 00 0B B8", source=SPONTANEOUS)
    pulses = host.pulses()
    rates = [16] * 10 + [8] * 20 + [4] * 50 + [4] * 2840 + [4] * 50 + [8] * 20 + [16] * 10
    ticks = [sum(rates[:k]) for k in range(3000)]
    assert [pulse - pulses[0] for pulse in pulses] == [ceil(tick * MHZ / 8) for tick in ticks]
    fast = pulses[2950] - pulses[30]
    assert fast == ceil(ticks[2950] * MHZ / 8) - ceil(ticks[30] * MHZ / 8)
    print(f"{2920 * CLK / fast / 1e6:.4f} Mpps over 2920 pulses, jitter at most 1 clk")


@directed("P312-PRT-04", "P312-MOT-01", "P312-CMD-00", builds=(F50,))
async def p312_tables_and_starts_at_50_mhz(dut: Any) -> None:
    """Tables of all kinds are built within 5 ms, and motions start within 20 us."""
    longest = 0.0
    for setting in (
        T1,
        T1.replace("00 01", "00 09"),
        message(Code.INITIAL, "11 03E8 01F4 00C8 0007D0 0005DC"),
        SIGMOID,
    ):
        host = await Host.start(dut)
        await host.issue(setting)
        await host.wait()
        ms = (host.t - host.header) / CLK * 1e3
        assert await host.response() == message(Code.INITIAL) and ms < 5
        print(f"{setting}: {ms:.2f} ms to the answer")
        for block in STARTS:
            data = bytes.fromhex(block)
            await host.issue(f"03 {len(data):02X} {block}")
            start = host.header
            await host.pulse(1)
            longest = max(longest, (host.pulses()[0] - start) / MHZ)
            await host.response()
            if data[0] not in (0x82, 0x83, 0x84) or len(data) > 2:
                await host.ask(message(Code.STOP, "00"))
            await host.response()
    print(f"{longest:.1f} us from the header to pulse 1 at most, 5 us of it direction set-up")
    assert longest <= 20


@directed("P312-PRT-04", "P312-MOT-01", builds=(F50,))
async def p312_the_longest_plan(dut: Any) -> None:
    """With two different ramps, a triangular profile is planned in time: pulse 1 follows within 20 us."""
    table = build(1000, 328, 200, 3000, 3000)
    assert table.sa == 0 and table.sd > 0
    host = await Host.start(dut, message(Code.INITIAL, "10 03E8 0148 00C8 000BB8 000BB8"))
    await host.issue(message(Code.RAMP, f"00 0000 {table.na + table.nd - 1:08X}"))
    start = host.header
    await host.pulse(1)
    us = (host.pulses()[0] - start) / MHZ
    print(f"{us:.1f} us from the header of a triangle with two different sides to pulse 1")
    assert us <= 20
