"""Stops of the PPMC-312: coinciding causes, immediate stops, limits, high-speed limits."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, rates, stopped
from cocotb_tests.ppmc312.motion_tables import ALWAYS, SLOW_STOP, STOP, change
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code


@directed(
    "P312-MOT-34",
    "P312-MOT-06",
    "P312-MOT-03",
    "P312-INP-12",
    exact="the switches must be sampled at the same edge",
)
async def p312_causes_in_the_same_cycle(dut: Any) -> None:
    for start, levels, cause in (
        (f"{ALWAYS} 0190", {"alm_n": 0, "fl_n": 0, "org_n": 0}, 0x80),
        (message(Code.ORIGIN_SEARCH, "00 0190"), {"fl_n": 0, "org_n": 0, "fhl_n": 0}, 0x01),
        (message(Code.ORIGIN_SEARCH, "00 0064"), {"org_n": 0, "fhl_n": 0}, 0x20),
        (f"{ALWAYS} 0190", {"bl_n": 0, "fl_n": 0}, 0x01),
    ):
        host = await Host.start(dut, *TF, message(Code.SPEED_LIMIT, "FFFF"))
        await host.ask(start)
        await host.pulse(3, 20)  # pout is high and stays high for the pulse width
        low = host.t
        await host.pins(**levels)
        if cause == 0x80:
            assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
        assert await host.response() == stopped(cause, 3)
        assert host.bench.falls("pout", low)[0] - host.pulses()[2] == 80
    # Instruction 81 and a high-speed limit take effect at the same boundary.
    host = await Host.start(dut, *TF, message(Code.SPEED_LIMIT, "FFFF"))
    await host.ask(f"{ALWAYS} 0064")
    await host.pulse(3, 20)
    await host.issue(SLOW_STOP)
    await host.pins(fhl_n=0)
    assert await host.response() == message(Code.SLOW_STOP)
    assert await host.response() == stopped(0x02, 15)


@directed("P312-MOT-34", "P312-MOT-06", "P312-MOT-35", "P312-PRT-04")
async def p312_immediate_stops_cut_the_interval_short(dut: Any) -> None:
    for pin in ("fl_n", "alm_n", "org_n"):
        host = await Host.start(dut, *TF, message(Code.END_TERMINAL, "01"))
        await host.pins(end_n=0)
        await host.ask(message(Code.ORIGIN_SEARCH, "00 0190"))
        edge = await host.pulse(2, 2000)
        await host.pins(**{pin: 0})
        await host.pause(70)
        assert host.condition == (0x10 if pin == "alm_n" else 0x02)
        assert host.pulses()[-1] == edge
    # After the last pulse the cause is NOS, and the interval still ends immediately.
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.CONSTANT, "00 0190 00000002"))
    await host.pulse(2, 2000)
    await host.pins(fl_n=0)
    await host.pause(70)
    assert host.condition == 0x02 and await host.response() == stopped(0x40, 2)
    await host.pins(fl_n=1)
    await host.ask(message(Code.CONSTANT, "00 0190 00000002"))
    await host.pulse(2, 2000)
    assert await host.ask(STOP) == message(Code.STOP)
    assert host.condition == 0x02 and await host.response() == stopped(0x40, 4)


@directed("P312-INP-10", "P312-INP-11", "P312-INP-12", "P312-CHK-34", "P312-CHK-35", "P312-BAD-12")
async def p312_limits_of_both_directions(dut: Any) -> None:
    own = {0: ("fl_n", "fhl_n"), 1: ("bl_n", "bhl_n")}
    for ccw in (0, 1):
        sign = -1 if ccw else 1
        host = await Host.start(dut, *TF, message(Code.SPEED_LIMIT, "00C8"))
        away = dict.fromkeys(own[1 - ccw], 0)
        await host.pins(**away)
        # The motion starts and continues with the limits of the other direction asserted.
        await host.ask(message(Code.CONSTANT, f"{ccw << 6:02X} 0064 00000003"))
        assert await host.response() == stopped(0x40, 3 * sign)
        limit, slow = own[ccw]
        await host.pins(**{slow: 0})
        for block, right in (
            (message(Code.CONSTANT, f"{ccw << 6:02X} 00C8 00000001"), 0),
            (message(Code.CONSTANT, f"{ccw << 6:02X} 00C9 00000001"), 1),
            (message(Code.RAMP, f"{ccw << 6:02X} 0000 00000001"), 0),
            (message(Code.RAMP, f"{ccw << 6:02X} 00C9 00000001"), 1),
            (message(Code.STEP, f"{ccw << 6:02X}"), 1),
            (message(Code.ORIGIN_SEARCH, f"{ccw << 6:02X} 00C8"), 0),
            (message(Code.ZERO_RETURN, f"{ccw << 6:02X} 0064"), 0),
            (message(Code.FOREVER_RAMP, f"{ccw << 6:02X} 0000"), 0),
        ):
            answer = await host.ask(block)
            assert (answer == message(Answer.LIMIT)) == (not right), block
            if right:
                await host.response()
            assert host.condition == 0x02
        await host.pins(**{slow: 1, limit: 0})
        for block in ("83 {} 0190 00000001", "82 {} 0190 00000001", "10 {} 0190", "11 {} 0190", "85 {} 0190"):
            text = block.format(f"{ccw << 6:02X}")
            assert await host.ask(f"03 {len(bytes.fromhex(text)):02X} {text}") == message(Answer.LIMIT)
        assert await host.ask(message(Code.STEP, f"{ccw << 6:02X}")) == message(Answer.LIMIT)
        await host.pins(**{limit: 1})
        await host.ask(message(Code.FOREVER_CONSTANT, f"{ccw << 6:02X} 00C9"))
        await host.pins(**{slow: 0})
        await host.pulse(4, 20)
        await host.ask(change(0x88, 200))
        # The rate now equals HSL, so the deceleration begins with the interval after the next boundary.
        assert (await host.response())[:11] == "23 06 E0 02"
        assert host.gaps()[-7:] == rates("200x5 400x2")


@directed("P312-MOT-31", "P312-INP-12", "P312-MOT-30")
async def p312_high_speed_limit_and_88(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.SPEED_LIMIT, "0096"))
    await host.ask(f"{ALWAYS} 0064")
    mark = host.mark
    await host.pulse(3, 20)
    await host.pins(fhl_n=0)
    await host.pulse(5, 20)
    # The motor is now slower than HSL: the deceleration is cancelled and does not continue later.
    assert await host.ask(change(0x88, 300)) == message(Code.CHANGE)
    host.mark = mark
    await host.pulse(12, 20)
    assert host.gaps() == rates("100x5 300x6")
    # The motor is fast enough again: another deceleration begins, from the stage with this rate.
    assert await host.ask(change(0x88, 150)) == message(Code.CHANGE)
    await host.response()
    host.mark = mark
    assert host.gaps() == rates("100x5 300x7 150x1 200x4 400x2")


@directed("P312-STA-04", "P312-INP-20", "P312-INP-12")
async def p312_limits_act_from_the_first_clk_of_a_held_motion(dut: Any) -> None:
    for levels, cause in (({"fl_n": 0}, 0x01), ({"fhl_n": 0}, 0x10), ({"bl_n": 0, "bhl_n": 0}, 0x40)):
        host = await Host.start(dut, *TF)
        await host.pins(run=0)
        assert await host.ask(message(Code.CONSTANT, "00 0064 00000002")) == message(Code.CONSTANT, "01")
        await host.pins(**levels)
        # If a motion waits for RUN, no new table is accepted: its profile is fixed.
        assert await host.ask(message(Code.SPEED_LIMIT, "FFFF")) == message(Answer.STATUS, "00 20")
        await host.pins(run=1)
        assert await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
        assert await host.response() == stopped(cause, 2 if cause == 0x40 else 0)
