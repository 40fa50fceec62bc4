"""Starts of the PPMC-312: legal rates, instruction forms, profiles, held starts, pulse 1."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.blocks import TF, TG, TH
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, rates, stopped
from cocotb_tests.ppmc312.motion_tables import ALWAYS, ODD, STOP, change, run_out
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source


@directed(
    "P312-CMD-82",
    "P312-CMD-83",
    "P312-CMD-84",
    "P312-CMD-85",
    "P312-CMD-86",
    "P312-CMD-10",
    "P312-CMD-11",
    "P312-CMD-87",
    "P312-CMD-88",
    "P312-GEN-06",
    "P312-CMD-8V",
)
async def p312_rates_that_may_be_requested(dut: Any) -> None:
    host = await Host.start(dut, *TG)
    for code, tail in (
        (0x82, "00000001"),
        (0x83, "00000001"),
        (0x85, ""),
        (0x86, ""),
        (0x10, ""),
        (0x11, ""),
    ):
        for rate, right in ((99, 0), (100, 1), (400, 1), (401, 0), (0, code != 0x10)):
            answer = await host.ask(message(code, f"00 {rate:04X} {tail}"))
            if not right:
                assert answer[6:14] == f"F0 20 {code:02X}", (code, rate)
                continue
            assert answer[6:8] == f"{code:02X}", (code, rate)
            if not tail:
                assert await host.ask(STOP) == message(Code.STOP)
            await host.response()
    await host.ask(f"{ALWAYS} 0190")
    for code in (0x87, 0x88):
        for rate, right in ((0, 0), (99, 0), (401, 0), (400, 1)):
            answer = await host.ask(change(code, rate))
            assert answer == message(code) if right else answer[6:14] == f"F0 20 {code:02X}"


@directed(
    "P312-CMD-84",
    "P312-CMD-82",
    "P312-CMD-83",
    "P312-CMD-85",
    "P312-CMD-86",
    "P312-MOT-13",
    "P312-MOT-01",
    "P312-MOT-05",
    "P312-GEN-10",
)
async def p312_forms_of_the_starts(dut: Any) -> None:
    # If instruction 84 makes its step at the rate of the first stage of the acceleration, the motion ends one
    # interval after its pulse.
    for table, rate in ((TF, 400), (TG, 400), (TH, 200), (ODD, 200)):
        host = await Host.start(dut, *table)
        await host.ask(message(Code.STEP, "40"))
        await run_out(host, host.mark, 0x40, f"{rate}x1", -1)
    cases = [
        (message(Code.RAMP, "40 00000007"), "10", "400x3 200x1 400x3", -1),
        (message(Code.CONSTANT, "00 0000 00000003"), "00", "100x3", 1),
        (message(Code.CONSTANT, "40 00FA 00000002"), "00", "250x2", -1),
    ]
    for block, kind, pulses, sign in cases:
        host = await Host.start(dut, *TF)
        assert await host.ask(block) == f"03 02 {block[6:8]} {kind}"
        await run_out(host, host.mark, 0x40, pulses, sign)
        assert host.out("dir") == (sign < 0)
    for block, begin in (
        (message(Code.FOREVER_RAMP, "40 0000"), "400x3 200x4 100x5"),
        (message(Code.FOREVER_RAMP, "00 0096"), "400x3 200x4 150x5"),
        (message(Code.FOREVER_RAMP, "00 00C9"), "201x6"),
        (message(Code.FOREVER_CONSTANT, "40 0000"), "100x6"),
        (message(Code.ZERO_RETURN, "00 00C8"), "400x3 200x6"),
    ):
        host = await Host.start(dut, *TG)
        assert await host.ask(block) == f"03 02 {block[6:8]} 00"
        mark, expected = host.mark, rates(begin)
        await host.pulse(len(expected) + 1)
        assert host.gaps() == expected
        assert await host.ask(STOP) == message(Code.STOP)
        host.mark = mark
        sign = -1 if block[9] == "4" else 1
        assert await host.response() == stopped(0x04, sign * len(host.pulses()))


@directed("P312-MOT-10", "P312-MOT-11", "P312-MOT-12", "P312-BAD-15", "P312-GEN-06")
async def p312_plans_on_an_odd_table(dut: Any) -> None:
    """t(x) is the last stage that is not faster than x, regardless of the stages before it."""
    host = await Host.start(dut, *ODD)
    for n, rate, kind, pulses in (
        (30, 0, "00", "200x3 300x4 100x16 300x7"),
        (10, 0, "10", "200x3 300x7"),
        (3, 0, "40", "200x3"),
        (6, 200, "20", "300x6"),
    ):
        await host.ask(message(Code.POSITION_SET, "00 00000000"))
        answer = await host.ask(message(Code.RAMP, f"00 {rate:04X} {n:08X}"))
        if rate == 200:
            # t(200) = 125 is above the first stage of the ramp. The deceleration has 3 intervals of 200 in
            # stage 124, then 3 of 300.
            kind, pulses = "10", None
        assert answer == message(Code.RAMP, kind)
        if pulses:
            await run_out(host, host.mark, 0x40, pulses)
        else:
            assert await host.response() == stopped(0x40, n)


@directed("P312-MOT-07", "P312-CMD-82", "P312-CMD-83")
async def p312_counts_have_32_bits(dut: Any) -> None:
    for n in (0x0001_0002, 0x0100_0002, 0x8000_0000, 0xFFFF_FFFF):
        host = await Host.start(dut, "02 03 01 00 02", "00 04 0004 0010", "01 06 000002 000002")
        for block in (message(Code.CONSTANT, f"00 0004 {n:08X}"), message(Code.RAMP, f"00 {n:08X}")):
            await host.ask(block)
            await host.pulse(12)
            await host.ask(STOP)
            assert (await host.response())[:11] == "23 06 E0 04"


@directed("P312-CMD-8L", "P312-CMD-80", "P312-CMD-81", "P312-CMD-87", "P312-CMD-88")
async def p312_positions_that_are_not_needed(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(f"{ALWAYS} 0064")
    assert await host.ask(message(Code.CHANGE, "03 00C8 00000001")) == message(Code.CHANGE)
    assert await host.ask(message(Code.RAMP_CHANGE, "02 0190 00000001")) == message(Code.RAMP_CHANGE)
    assert await host.ask(message(Code.CHANGE, "05 00C8 00000001")) == message(Answer.REGISTERED)
    assert await host.ask(message(Code.SLOW_STOP, "05 00000001")) == message(Answer.REGISTERED)
    assert await host.ask(message(Code.STOP, "07 00000001")) == message(Answer.REGISTERED)
    await host.blip("evt0_n")
    assert await host.response() == message(Code.CHANGE, source=Source.OVERRIDE)
    await host.blip("evt0_n")
    assert await host.response() == message(Code.SLOW_STOP, source=Source.OVERRIDE)
    assert (await host.response())[:11] == "23 06 E0 08"
    await host.ask(f"{ALWAYS} 00C8")
    await host.blip("evt1_n")
    assert await host.response() == message(Code.STOP, source=Source.OVERRIDE)
    assert (await host.response())[:11] == "23 06 E0 04"
    await host.ask(f"{ALWAYS} 00C8")
    assert await host.ask(message(Code.SLOW_STOP, "00 00000001")) == message(Code.SLOW_STOP)
    assert (await host.response())[:11] == "23 06 E0 08"
    await host.ask(f"{ALWAYS} 00C8")
    assert await host.ask(message(Code.STOP, "01 00000001")) == message(Code.STOP)
    assert (await host.response())[:11] == "23 06 E0 04"


@directed("P312-INP-20", "P312-CMD-45", "P312-CHK-32", "P312-CHK-33")
async def p312_every_start_is_held(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    for block, answer, cause in (
        (message(Code.RAMP, "40 0000 00000002"), message(Code.RAMP, "11"), 0x40),
        (message(Code.RAMP, "00 0000 0000001E"), message(Code.RAMP, "01"), 0x40),
        (message(Code.RAMP, "00 012C 0000000A"), message(Code.RAMP, "21"), 0x40),
        (message(Code.CONSTANT, "00 0190 00000002"), message(Code.CONSTANT, "01"), 0x40),
        (message(Code.STEP, "40"), message(Code.STEP), 0x40),
        (message(Code.FOREVER_RAMP, "00 0000"), message(Code.FOREVER_RAMP, "01"), 0x04),
        (message(Code.FOREVER_CONSTANT, "40 0000"), message(Code.FOREVER_CONSTANT, "01"), 0x04),
        (message(Code.ORIGIN_SEARCH, "00 0190"), message(Code.ORIGIN_SEARCH, "01"), 0x04),
        (message(Code.ZERO_RETURN, "40 0000"), message(Code.ZERO_RETURN, "01"), 0x04),
    ):
        await host.pins(run=0)
        assert await host.ask(block) == answer
        mark = host.mark
        await host.pause(2000)
        assert host.condition == 0x20 and not host.pulses()
        assert await host.ask(message(Code.FOREVER_CONSTANT, "00 0064")) == message(Answer.STATUS, "00 20")
        await host.pins(run=1)
        assert await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
        # From here on, RUN is ignored.
        await host.pins(run=0)
        host.mark = mark
        await host.pulse(1)
        if cause == 0x04:
            await host.ask(STOP)
        assert (await host.response())[:11] == f"23 06 E0 {cause:02X}"
    assert await host.ask(message(Code.RUN_MONITOR)) == message(Code.RUN_MONITOR, "01")
    assert await host.ask(message(Code.STEP, "00")) == message(Code.STEP)
    assert (await host.response())[:11] == "23 06 E0 40"
    assert await host.ask(message(Code.RUN_MONITOR)) == message(Code.RUN_MONITOR, "00")
    await host.ask(message(Code.STEP, "00"))
    assert host.condition == 0x20


@directed("P312-MOT-32", "P312-MOT-30", "P312-MOT-31", "P312-INP-12")
async def p312_changes_that_wait_for_pulse_1(dut: Any) -> None:
    """If several changes wait for pulse 1, the newest is used.

    The change starts from the rate of the operation, not from the rate of a change that it replaced.
    """
    setting = ("02 03 01 06 03", "00 06 0008 000C 0010", "01 09 000003 000002 000003")

    async def seen(host: Host) -> list[int]:
        for _ in range(80):
            await host.pins(extck=1)
            await host.pause(10)
            await host.pins(extck=0)
            await host.pause(10)
        host.mark = 0
        return [round(gap / 22) for gap in host.gaps(1)]

    for changes, expected in (
        ((change(0x88, 8), change(0x87, 8)), [12, 12, 8, 8, 8, 8, 8, 8]),
        ((change(0x88, 8), change(0x87, 12)), [12] * 6),
        ((change(0x87, 8), change(0x88, 12)), [12] * 6),
    ):
        host = await Host.start(dut, *setting)
        await host.ask(message(Code.FOREVER_CONSTANT, "00 0010"))
        for block in changes:
            await host.ask(block)
        assert (await seen(host))[: len(expected)] == expected, changes
    # A high-speed limit is compared with the rate that pulse 1 would have without the change.
    host = await Host.start(dut, *setting)
    await host.ask(message(Code.SPEED_LIMIT, "000C"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0010"))
    await host.ask(change(0x88, 8))
    await host.pins(fhl_n=0)
    await host.pause(300)
    assert host.condition == 0x08
