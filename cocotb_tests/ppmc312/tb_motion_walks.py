"""Motions through the stages of a table of the PPMC-312, and rate changes during them.

R[i] is the rate of stage i; pa[i] and pd[i] are the numbers of its pulses in the acceleration and the
deceleration (-: unused). sa and sd are the first stages in use of the two ramps.
"""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import directed
from cocotb_tests.ppmc312.blocks import TF, TG, TH
from cocotb_tests.ppmc312.directed_host import TICK
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, rates, stopped
from cocotb_tests.ppmc312.motion_tables import ALWAYS, ODD, SLOW_STOP, STOP, change, run_out
from openppmc.model.ppmc312.codes import Code, Source, State

# Equal neighbouring rates: R[122..126] = 400 400 200 200 100, pa = pd = 2 2 3 4 5.
EQUAL = (
    "02 03 01 01 05",
    "00 0A 0064 00C8 00C8 0190 0190",
    "01 0F 000005 000004 000003 000002 000002",
)
# R[122..126] = 500 400 400 200 100, pa = 3 3 3 4 5, pd = - - - 30 6: the equal rates are slower than R[sd].
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


WALKS = [
    # A row contains the table, the start, pairs (pulses, instruction after them), all intervals, and the
    # cause of the end.
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
    # Instruction 87 makes ramps, which may collide with the deceleration point.
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
    # Equal neighbouring rates: at a constant rate, a stop or change begins in the last stage that has this
    # rate; within a stage, it begins in that stage.
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
    # If a ramp ends at the deceleration point and no deceleration follows, the next instruction 87 starts
    # from t(R_c), R_c being the last rate, and not from the stage in which the ramp ended.
    (
        SLOW_EQUAL,
        message(Code.RAMP, "00 0096 0000003C"),
        [(20, change(0x88, 500)), (27, change(0x87, 100)), (33, change(0x87, 200))],
        "500x3 400x6 200x4 150x7 500x7 400x6 200x27",
        0x40,
    ),
    (
        SLOW_EQUAL,
        message(Code.RAMP, "00 0096 0000003C"),
        [(20, change(0x88, 500)), (27, change(0x87, 100)), (35, change(0x87, 450))],
        "500x3 400x6 200x4 150x7 500x7 400x8 450x25",
        0x40,
    ),
    (
        LAST_EQUAL,
        message(Code.RAMP, "00 00C8 00000028"),
        [(22, change(0x87, 400)), (29, change(0x87, 200))],
        "400x9 200x13 400x7 200x11",
        0x40,
    ),
    # As before, but with rates that do not descend: t(400) = t(401) = 125, so that instruction 87 finds
    # stages to decelerate.
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
    # If two changes wait for one boundary, the newer one is used.
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
    """If instruction 87 is accepted before the ramp of an earlier instruction 87 begins, the later one waits
    during this ramp and is then discarded.

    The later one is too late for the boundary at which the earlier one takes effect. The remaining pulses are
    not accelerated.
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
    """If an override with instruction 87 is accepted before the ramp of a direct instruction 87 begins, the
    override waits until this ramp ends.
    """
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
    """While the rate of an instruction 88 is looked up, the motion continues through the stages.

    The look-up takes longer than a stage here, and the motion reads the table during this time.
    """
    steps = range(10, 34, 2)  # in ticks of 2 cycles: stages of 40 .. 130 cycles
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


@directed("P312-STA-01", "P312-MOT-11", "P312-MOT-12")
async def p312_state_before_pulse_1(dut: Any) -> None:
    """Before pulse 1, the state is ACC if the first interval belongs to a ramp, also to a deceleration that
    begins with pulse 1. The external base clock has no edges, so pulse 1 is not output.
    """
    blocks = (TH[0].replace(" 11 ", " 16 "), *TH[1:])
    for rate, count, state in ((100, 30, State.ACC), (200, 5, State.ACC), (200, 30, State.FIX)):
        host = await Host.start(dut, *blocks)
        await host.ask(message(Code.RAMP, f"00 {rate:04X} {count:08X}"))
        await host.pause(200)
        assert not host.pulses() and await host.ask(message(Code.STATUS)) and host.condition == state
        assert await host.ask(STOP) == message(Code.STOP)
