"""Operations of the PPMC-312 on tables with two sides: rates, forms, walks, changes, causes, limits."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness.directed import directed
from cocotb_tests.ppmc312.host import TF, TG, TH, TICK
from cocotb_tests.ppmc312.parallel_host import Host
from cocotb_tests.ppmc312.words import message, rates, stopped
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code, Source

STOP, SLOW_STOP = message(Code.STOP, "00"), message(Code.SLOW_STOP, "00")
ALWAYS = "03 04 86 00"
# Not monotonic, sides of their own: R[124..126] = 200 300 100, pa 3 4 5, pd - 7 6.
ODD = ("02 04 01 11 03 02", "00 06 0064 012C 00C8", "00 09 000005 000004 000003", "01 06 000006 000007")

# Equal neighbours: R[122..126] = 400 400 200 200 100, pa = pd = 2 2 3 4 5.
EQUAL = (
    "02 03 01 01 05",
    "00 0A 0064 00C8 00C8 0190 0190",
    "01 0F 000005 000004 000003 000002 000002",
)
# R[122..126] = 500 400 400 200 100, pa = 3 3 3 4 5, pd = - - - 30 6: the equal ones are slower than R[sd].
SLOW_EQUAL = (
    "02 04 01 11 05 02",
    "00 0A 0064 00C8 0190 0190 01F4",
    "00 0F 000005 000004 000003 000003 000003",
    "01 06 000006 00001E",
)
# R[122..126] = 400 400 400 200 100, pa = pd = 3 3 3 4 5.
LAST_EQUAL = (
    "02 03 01 01 05",
    "00 0A 0064 00C8 0190 0190 0190",
    "01 0F 000005 000004 000003 000003 000003",
)
# R[122..126] = 500 400 200 450 100, pa = 3 3 3 4 5, pd = - - 4 2 30.
UNEVEN = (
    "02 04 01 11 05 03",
    "00 0A 0064 01C2 00C8 0190 01F4",
    "00 0F 000005 000004 000003 000003 000003",
    "01 09 00001E 000002 000004",
)


def change(code: int, rate: int) -> str:
    return message(code, f"00 {rate:04X}")


async def run_out(host: Host, mark: int, cause: int, pulses: str, sign: int = 1) -> None:
    """The stop report, all intervals but the last one, and the time from the last pulse to the report."""
    expected = rates(pulses)
    await host.wait()
    seen = host.t
    assert await host.response() == stopped(cause, sign * len(expected))
    host.mark = mark
    assert host.gaps() == expected[:-1] and len(host.pulses()) == len(expected)
    assert 0 <= seen - host.pulses()[-1] - expected[-1] * TICK < 200


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
async def p312_rates_that_may_be_asked_for(dut: Any) -> None:
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
    # 84 at R[sa]: the end of the motion comes one interval after its pulse.
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
    """t(x) is the last stage that is slow enough, whatever comes before it."""
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
            # t(200) = 125, above the first stage: 200x3 of stage 124, 300x3 of the deceleration.
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


WALKS = [
    # Table, start, what is done after which pulses, all intervals, cause.
    (TG, f"{ALWAYS} 0064", [(4, SLOW_STOP)], "100x4 100x6 200x4", 0x08),
    (TG, f"{ALWAYS} 0096", [(4, SLOW_STOP)], "150x4 200x4", 0x08),
    (TG, f"{ALWAYS} 00C8", [(4, SLOW_STOP)], "200x4", 0x10),  # as slow as the stop speed
    (TG, f"{ALWAYS} 012C", [(4, SLOW_STOP)], "300x4", 0x10),
    (TH, f"{ALWAYS} 00C8", [(4, SLOW_STOP)], "200x4 200x4 400x3", 0x08),
    (TH, f"{ALWAYS} 00C9", [(4, SLOW_STOP)], "201x4 400x3", 0x08),
    (ODD, f"{ALWAYS} 0064", [(4, SLOW_STOP)], "100x4 100x6 300x7", 0x08),
    (TF, message(Code.CONSTANT, "00 0064 0000000A"), [(4, SLOW_STOP)], "100x4 100x5 200x1", 0x40),
    (
        TF,
        message(Code.CONSTANT, "00 0064 00000014"),
        [(4, SLOW_STOP), (6, SLOW_STOP)],
        "100x9 200x4 400x3",
        0x08,
    ),
    (TG, message(Code.FOREVER_RAMP, "00 0000"), [(5, SLOW_STOP)], "400x3 200x2", 0x10),
    (TG, message(Code.FOREVER_RAMP, "00 0000"), [(2, SLOW_STOP)], "400x2", 0x10),
    (
        TF,
        message(Code.FOREVER_RAMP, "00 0000"),
        [(9, SLOW_STOP), (11, change(0x88, 150)), (14, SLOW_STOP)],
        "400x3 200x4 100x4 150x3 200x4 400x3",
        0x08,
    ),
    (TF, message(Code.RAMP, "00 0000 0000001E"), [(29, SLOW_STOP)], "400x3 200x4 100x16 200x4 400x2", 0x10),
    (TF, message(Code.RAMP, "00 0000 0000001E"), [(30, SLOW_STOP)], "400x3 200x4 100x16 200x4 400x3", 0x40),
    # Ramps of 87, and where they meet the deceleration point.
    (TF, message(Code.CONSTANT, "00 0190 00000014"), [(3, change(0x87, 150))], "400x3 200x4 150x13", 0x40),
    (TH, message(Code.CONSTANT, "00 0190 00000014"), [(3, change(0x87, 100))], "400x3 200x4 100x13", 0x40),
    (TG, message(Code.CONSTANT, "00 0064 00000014"), [(3, change(0x87, 400))], "100x3 200x4 400x13", 0x40),
    (
        TH,
        message(Code.CONSTANT, "00 0064 00000014"),
        [(3, change(0x87, 400))],
        "100x3 200x4 400x3 400x10",
        0x40,
    ),
    (TF, message(Code.CONSTANT, "00 0064 00000014"), [(3, change(0x87, 200))], "100x3 200x17", 0x40),
    (TF, message(Code.CONSTANT, "00 0064 00000014"), [(3, change(0x87, 201))], "100x3 200x4 201x13", 0x40),
    (TF, message(Code.CONSTANT, "00 00C8 0000000A"), [(3, change(0x87, 200))], "200x10", 0x40),
    (TF, message(Code.CONSTANT, "00 0064 00000008"), [(5, change(0x87, 400))], "100x5 200x3", 0x40),
    (
        TF,
        message(Code.RAMP, "00 0096 0000001E"),
        [(13, change(0x87, 100))],
        "400x3 200x4 150x6 100x10 100x5 200x2",
        0x40,
    ),
    (
        TF,
        message(Code.RAMP, "00 0096 0000001E"),
        [(9, change(0x87, 400))],
        "400x3 200x4 150x2 200x4 400x17",
        0x40,
    ),
    (
        TF,
        message(Code.RAMP, "00 0096 00000014"),
        [(11, change(0x87, 400))],
        "400x3 200x4 150x4 200x2 200x4 400x3",
        0x40,
    ),
    (
        TG,
        message(Code.RAMP, "00 0000 0000001E"),
        [(15, change(0x88, 150))],
        "400x3 200x4 100x8 150x5 200x10",
        0x40,
    ),
    (
        TF,
        message(Code.RAMP, "00 0000 0000001E"),
        [(25, change(0x88, 300))],
        "400x3 200x4 100x16 200x2 300x5",
        0x40,
    ),
    (
        TF,
        message(Code.CONSTANT, "00 0064 0000000A"),
        [(4, change(0x88, 300)), (6, change(0x88, 250))],
        "100x4 300x2 250x4",
        0x40,
    ),
    # Equal neighbouring rates: the last of them counts for a constant rate, its own stage for a stage.
    (EQUAL, message(Code.RAMP, "00 0000 00000028"), [], "400x4 200x7 100x18 200x7 400x4", 0x40),
    (EQUAL, message(Code.RAMP, "00 0190 00000006"), [(5, SLOW_STOP)], "400x5", 0x10),
    (EQUAL, message(Code.FOREVER_RAMP, "00 0000"), [(1, SLOW_STOP)], "400x1", 0x10),
    (EQUAL, message(Code.FOREVER_RAMP, "00 0000"), [(4, SLOW_STOP)], "400x4", 0x10),
    (EQUAL, message(Code.FOREVER_RAMP, "00 0000"), [(5, SLOW_STOP)], "400x4 200x1 200x3 400x4", 0x08),
    (EQUAL, message(Code.FOREVER_RAMP, "00 0000"), [(8, SLOW_STOP)], "400x4 200x4 200x7 400x4", 0x08),
    (EQUAL, f"{ALWAYS} 0064", [(4, SLOW_STOP)], "100x4 100x5 200x7 400x4", 0x08),
    (EQUAL, f"{ALWAYS} 00C8", [(4, SLOW_STOP)], "200x4 200x7 400x4", 0x08),
    (EQUAL, f"{ALWAYS} 00C9", [(4, SLOW_STOP)], "201x4 400x4", 0x08),
    (EQUAL, f"{ALWAYS} 0190", [(4, SLOW_STOP)], "400x4", 0x10),
    (EQUAL, message(Code.CONSTANT, "00 0190 00000014"), [(3, change(0x87, 100))], "400x3 200x7 100x10", 0x40),
    (EQUAL, message(Code.CONSTANT, "00 0064 00000014"), [(3, change(0x87, 400))], "100x3 200x7 400x10", 0x40),
    (EQUAL, message(Code.CONSTANT, "00 0064 00000014"), [(3, change(0x87, 200))], "100x3 200x17", 0x40),
    (
        EQUAL,
        message(Code.RAMP, "00 00C8 00000028"),
        [(14, change(0x88, 100))],
        "400x4 200x10 100x20 200x6",
        0x40,
    ),
    (
        EQUAL,
        message(Code.RAMP, "00 0000 00000028"),
        [(18, change(0x88, 200))],
        "400x4 200x7 100x7 200x13 400x9",
        0x40,
    ),
    (
        EQUAL,
        message(Code.RAMP, "00 0000 00000028"),
        [(18, change(0x88, 200)), (37, change(0x87, 100))],
        "400x4 200x7 100x7 200x13 400x6 200x3",
        0x40,
    ),
    # A ramp that ends at the deceleration point without a walk: the next 87 starts from t(R_c), not from the
    # stage in which it ended.
    (
        SLOW_EQUAL,
        message(Code.RAMP, "00 0096 0000003C"),
        [(20, change(0x88, 500)), (27, change(0x87, 100)), (33, change(0x87, 200))],
        "500x3 400x6 200x4 150x7 500x7 400x6 200x27",
        0x40,
    ),
    (
        LAST_EQUAL,
        message(Code.RAMP, "00 00C8 00000028"),
        [(22, change(0x87, 400)), (29, change(0x87, 200))],
        "400x9 200x13 400x7 200x11",
        0x40,
    ),
    # The same where rates do not fall: t(400) = t(401) = 125, so that 87 finds stages to slow down with.
    (
        UNEVEN,
        message(Code.RAMP, "00 0064 00000050"),
        [(20, change(0x88, 500)), (41, change(0x87, 100)), (50, change(0x87, 500))],
        "500x3 400x3 200x3 450x4 100x7 500x21 400x9 450x2 200x4 500x24",
        0x40,
    ),
    (
        UNEVEN,
        message(Code.RAMP, "00 0064 00000050"),
        [(20, change(0x88, 500)), (41, change(0x87, 100)), (50, change(0x87, 100))],
        "500x3 400x3 200x3 450x4 100x7 500x21 400x9 100x30",
        0x40,
    ),
    # Two held for one boundary: the newer one counts.
    (
        TF,
        message(Code.CONSTANT, "00 0190 0000000A"),
        [(4, change(0x88, 300)), (4, change(0x87, 400))],
        "400x10",
        0x40,
    ),
    (
        TF,
        message(Code.CONSTANT, "00 0190 0000000A"),
        [(4, change(0x87, 100)), (4, change(0x88, 350))],
        "400x4 350x6",
        0x40,
    ),
]


@cocotb.parametrize(case=WALKS)
@directed(
    "P312-MOT-20", "P312-MOT-30", "P312-MOT-31", "P312-MOT-32", "P312-MOT-33", "P312-OVR-11", "P312-CMD-81"
)
async def p312_walks_and_changes(dut: Any, case: Any) -> None:
    table, start, acts, pulses, cause = case
    host = await Host.start(dut, *table)
    await host.ask(start)
    mark = host.mark
    for number, block in acts:
        host.mark = mark
        await host.pulse(number, 20)
        assert await host.ask(block) == f"03 01 {block[6:8]}"
    await run_out(host, mark, cause, pulses)


@directed("P312-MOT-33", "P312-MOT-32", "P312-OVR-11", "P312-STA-01")
async def p312_two_87_across_the_deceleration_point(dut: Any) -> None:
    """The second one is accepted before the ramp of the first begins, and comes too late for its boundary.

    It is held in the ramp, and dropped where that ends: the rest is not sped up.
    """
    for ahead in (30, 60, 100, 140):
        host = await Host.start(dut, *TF)
        await host.ask(message(Code.RAMP, "00 0064 00000028"))
        mark = host.mark
        await host.pulse(20, 20)
        assert await host.ask(change(0x88, 400)) == message(Code.CHANGE)
        host.mark = mark
        edge = await host.pulse(25, 20)
        assert await host.ask(change(0x87, 100)) == message(Code.RAMP_CHANGE)
        await host.go(edge + 400 * TICK - ahead - 45)
        await host.put(change(0x87, 200))
        assert host.header == edge + 400 * TICK - ahead
        assert await host.response() == message(Code.RAMP_CHANGE)
        await run_out(host, mark, 0x40, "400x3 200x4 100x13 400x5 200x7 400x8")


@directed("P312-MOT-32", "P312-OVR-03", "P312-OVR-11", "P312-STA-01")
async def p312_an_override_with_a_ramp_waits_for_the_end_of_another_ramp(dut: Any) -> None:
    """Accepted before the ramp of a direct 87 begins, it is held over all steps of that ramp."""
    for ahead in (40, 60, 100, 140):
        host = await Host.start(dut, *TF, message(Code.RAMP_CHANGE, "05 0190"))
        await host.ask(f"{ALWAYS} 0190")
        mark = host.mark
        edge = await host.pulse(4, 20)
        assert await host.ask(change(0x87, 100)) == message(Code.RAMP_CHANGE)
        await host.go(edge + 400 * TICK - ahead)
        await host.pins(evt0_n=0)
        assert await host.response() == message(Code.RAMP_CHANGE, source=Source.OVERRIDE)
        host.mark = mark
        await host.pulse(22, 20)
        assert host.gaps() == rates("400x4 200x4 100x6 200x4 400x3")
        assert await host.ask(STOP) == message(Code.STOP)
        assert await host.response() == stopped(0x04, 22)


@directed("P312-MOT-12", "P312-MOT-31", "P312-OVR-11", "P312-CMD-88")
async def p312_stages_go_on_while_an_88_is_looked_up(dut: Any) -> None:
    """The look-up of its rate takes longer than a stage here, and the motion needs the table meanwhile."""
    steps = range(10, 34, 2)  # 2 clk each: stages of 40 .. 130 clk
    curve = ("02 04 01 10 0C 02", f"00 18 {''.join(f'{rate:04X}' for rate in steps)}")
    pulses = ("00 1E " + "000002" * 10, "00 06 000002 000003", "01 06 000009 000009")
    climb = [rate for rate in reversed(steps) for _ in range(3 if rate == 32 else 2)]
    for after in range(10, 130, 20):
        host = await Host.start(dut, *curve, *pulses)
        await host.ask(message(Code.FOREVER_RAMP, "00 0000"))
        mark = host.mark
        await host.pulse(1, after)
        await host.put(change(0x88, 31))
        host.mark = mark
        await host.pulse(30)
        gaps = host.gaps(2)
        begun = gaps.index(31)
        assert gaps[:begun] == climb[:begun] and 3 < begun < 15 and gaps[begun:] == [31] * (29 - begun)


@directed("P312-MOT-34", "P312-MOT-06", "P312-MOT-03", "P312-INP-12")
async def p312_causes_that_come_together(dut: Any) -> None:
    for start, levels, cause in (
        (f"{ALWAYS} 0190", {"alm_n": 0, "fl_n": 0, "org_n": 0}, 0x80),
        (message(Code.ORIGIN_SEARCH, "00 0190"), {"fl_n": 0, "org_n": 0, "fhl_n": 0}, 0x01),
        (message(Code.ORIGIN_SEARCH, "00 0064"), {"org_n": 0, "fhl_n": 0}, 0x20),
        (f"{ALWAYS} 0190", {"bl_n": 0, "fl_n": 0}, 0x01),
    ):
        host = await Host.start(dut, *TF, message(Code.SPEED_LIMIT, "FFFF"))
        await host.ask(start)
        await host.pulse(3, 20)  # pout is high, and it stays so for its time
        low = host.t
        await host.pins(**levels)
        if cause == 0x80:
            assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
        assert await host.response() == stopped(cause, 3)
        assert host.side.falls("pout", low)[0] - host.pulses()[2] == 80
    # 81 and a high-speed limit for one boundary.
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
    # After the last pulse the cause is NOS, and the interval still ends at once.
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
        # Starts with the limits of the other direction, and runs past them.
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
        # As fast as HSL now: the walk begins with the interval after the next boundary.
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
    # Slower than HSL: the walk is cancelled and does not come back.
    assert await host.ask(change(0x88, 300)) == message(Code.CHANGE)
    host.mark = mark
    await host.pulse(12, 20)
    assert host.gaps() == rates("100x5 300x6")
    # Fast enough again: another walk, from the table's stage.
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
        # A new table cannot come between; what is held is fixed.
        assert await host.ask(message(Code.SPEED_LIMIT, "FFFF")) == message(Answer.STATUS, "00 20")
        await host.pins(run=1)
        assert await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
        assert await host.response() == stopped(cause, 2 if cause == 0x40 else 0)


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
        # RUN means nothing any more.
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
            await host.pins(index_n=1, org_n=0)
            if index:
                await host.pulse(6, 20)
                await host.pins(index_n=0)
            count = 6 if index else 4
            assert await host.response() == stopped(0x20, count * sign)
            # 11: the way back at R[sa]; nothing rests between the phases.
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
            assert not host.side.falls("zclmp_n", mark)
            await host.pins(org_n=0, index_n=1 - index)
            assert await host.response() == stopped(0x20, (19 - 3) * sign)
            edges = host.pulses()
            gaps = [(b - a) / TICK for a, b in zip(edges, edges[1:], strict=False)]
            assert gaps[:18] == rates("400x3 200x4 100x8 200x3") and gaps[19:] == [400] * 2
            assert host.condition == 0x02 and await host.quiet()


@directed("P312-MOT-42", "P312-MOT-43", "P312-MOT-34")
async def p312_zero_return_that_ends_otherwise(dut: Any) -> None:
    # At the origin before pulse 1, and too slow for a walk: phase 2 at once.
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
    # Stops of phase 1 end it.
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
    # Limits of the other direction in phase 2, 80 and 81 there.
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


@directed("P312-MOT-32", "P312-MOT-30", "P312-MOT-31", "P312-INP-12")
async def p312_changes_that_wait_for_pulse_1(dut: Any) -> None:
    """The newest one counts, and it starts from the plan's rate, not from that of one which was replaced."""
    setting = ("02 03 01 06 03", "00 06 0008 000C 0010", "01 09 000003 000002 000003")

    async def seen(host: Host) -> list[int]:
        for _ in range(80):
            await host.pins(extck=1)
            await host.pause(10)
            await host.pins(extck=0)
            await host.pause(10)
        host.mark = 0
        return [gap // 22 for gap in host.gaps(1)]

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
    # A high-speed limit is compared with the rate that pulse 1 has without the change.
    host = await Host.start(dut, *setting)
    await host.ask(message(Code.SPEED_LIMIT, "000C"))
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0010"))
    await host.ask(change(0x88, 8))
    await host.pins(fhl_n=0)
    await host.pause(300)
    assert host.condition == 0x08
