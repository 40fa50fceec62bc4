"""Origin searches and zero returns of the PPMC-312 in all forms, and the causes that end them."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.blocks import TF, TG
from cocotb_tests.ppmc312.directed_host import TICK
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, rates, stopped
from cocotb_tests.ppmc312.motion_tables import SLOW_STOP, STOP
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code


@directed(
    "P312-MOT-40", "P312-MOT-41", "P312-MOT-42", "P312-MOT-43", "P312-CMD-10", "P312-CMD-11", "P312-MON-03"
)
async def p312_searches_in_every_form(dut: Any) -> None:
    for ccw in (0, 1):
        sign = -1 if ccw else 1
        for index in (0, 1):
            flags = f"{ccw << 6 | index << 4:02X}"
            host = await Host.start(dut, *TG, message(Code.IN_POSITION, "07 FFFF"))
            await host.ask(message(Code.ORIGIN_SEARCH, f"{flags} 00C8"))
            assert host.out("dir") == ccw
            await host.pulse(2, 20)
            await host.pins(index_n=0)
            await host.pulse(4, 20)
            await host.pins(index_n=1)
            await host.pins(org_n=0)
            if index:
                await host.pulse(6, 20)
                await host.pins(index_n=0)
            count = 6 if index else 4
            assert await host.response() == stopped(0x20, count * sign)
            # Instruction 11 returns at the rate of the first stage of the acceleration. There is no
            # standstill between the two phases.
            await host.pins(org_n=1, index_n=1)
            await host.ask(message(Code.POSITION_SET, "00 00000000"))
            assert host.out("zclmp_n") == 0
            await host.ask(message(Code.ZERO_RETURN, f"{flags} 0000"))
            mark = host.mark
            await host.pulse(9, 20)
            await host.pins(org_n=0, index_n=1 - index)
            await host.pulse(10, 20)
            await host.pins(org_n=1, index_n=1)
            await host.pulse(22, 20)
            assert host.out("dir") == 1 - ccw and host.out("zclmp_n") == 1
            assert not host.bench.falls("zclmp_n", mark)
            await host.pins(org_n=0, index_n=1 - index)
            assert await host.response() == stopped(0x20, (19 - 3) * sign)
            edges = host.pulses()
            gaps = [(b - a) / TICK for a, b in zip(edges, edges[1:], strict=False)]
            assert gaps[:18] == rates("400x3 200x4 100x8 200x3") and gaps[19:] == [400] * 2
            assert host.condition == 0x02 and await host.quiet()


@directed("P312-MOT-42", "P312-MOT-43", "P312-MOT-34")
async def p312_zero_return_that_ends_otherwise(dut: Any) -> None:
    # The motor is at the origin before pulse 1, or the rate is too low for a deceleration: phase 2 follows
    # immediately.
    for rate, number in (("0000", 0), ("0190", 3)):
        host = await Host.start(dut, *TF)
        if not number:
            await host.pins(org_n=0)
        await host.ask(message(Code.ZERO_RETURN, f"00 {rate}"))
        if number:
            await host.pulse(number, 20)
            await host.pins(org_n=0)
        assert await host.response() == stopped(0x20, number)
        assert len(host.pulses()) == number and host.out("dir") == 1
    # Stops in phase 1 end the operation.
    for act, cause in (
        ({"fl_n": 0}, 0x01),
        ({"fhl_n": 0}, 0x02),
        ({"alm_n": 0}, 0x80),
        (STOP, 0x04),
        (SLOW_STOP, 0x08),
    ):
        host = await Host.start(dut, *TF)
        await host.ask(message(Code.ZERO_RETURN, "00 0000"))
        await host.pulse(9, 20)
        if isinstance(act, str):
            await host.ask(act)
        else:
            await host.pins(**act)
        while not (answer := await host.response()).startswith("23 06 E0"):
            assert answer == message(Answer.ALARM, "00", source=SPONTANEOUS)
        assert answer[9:11] == f"{cause:02X}" and host.out("dir") == 0
    # These causes occur in phase 2: limits of the other direction, and instructions 80 and 81.
    for act, cause in (({"bl_n": 0}, 0x01), ({"fl_n": 0, "fhl_n": 0}, 0x20), (STOP, 0x04), (SLOW_STOP, 0x10)):
        host = await Host.start(dut, *TF)
        await host.ask(message(Code.ZERO_RETURN, "00 0190"))
        await host.pulse(3, 20)
        await host.pins(org_n=0)
        await host.pulse(3, 100)
        await host.pins(org_n=1)
        await host.pulse(5, 20)
        assert host.out("dir") == 1
        if isinstance(act, str):
            await host.ask(act)
        else:
            await host.pins(**act)
        if cause == 0x20:
            await host.pins(org_n=0)
        assert await host.response() == stopped(cause, 1)


@directed("P312-MOT-42", "P312-MOT-43", "P312-MOT-30")
async def p312_zero_return_whose_origin_coincides_with_a_slow_stop(dut: Any) -> None:
    # The rate is too low for a deceleration. If stop and origin occur in the same interval, the stop has
    # priority, and there is no return.
    for origin_first in (False, True):
        host = await Host.start(dut, *TF)
        await host.ask(message(Code.ZERO_RETURN, "00 0190"))
        await host.pulse(3, 20)
        if origin_first:
            await host.pins(org_n=0)
        await host.ask(SLOW_STOP)
        await host.pins(org_n=0)
        assert await host.response() == stopped(0x10, 3)
        assert host.out("dir") == 0 and await host.quiet()
