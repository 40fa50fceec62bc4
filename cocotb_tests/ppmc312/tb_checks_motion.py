"""Acceptance checks of the PPMC-312: pulses, stops, changes, limits, searches."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import directed
from cocotb_tests.harness.bus import clean
from cocotb_tests.ppmc312.blocks import T1, T2, T3, T4, TF, TG, TH
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message, rates, stopped
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code

MOVES = [
    (TF, 30, 0, 0x00, "400x3 200x4 100x16 200x4 400x3"),
    (TF, 24, 0, 0x00, "400x3 200x4 100x10 200x4 400x3"),
    (TF, 23, 0, 0x10, "400x3 200x4 100x9 200x4 400x3"),
    (TF, 7, 0, 0x10, "400x3 200x1 400x3"),
    (TF, 2, 0, 0x10, "400x2"),
    (TF, 1, 0, 0x10, "400x1"),
    (TF, 20, 150, 0x00, "400x3 200x4 150x6 200x4 400x3"),
    (TF, 10, 300, 0x20, "300x7 400x3"),
    (TG, 30, 0, 0x00, "400x3 200x4 100x19 200x4"),
    (TG, 10, 0, 0x10, "400x3 200x7"),
    (TG, 3, 0, 0x40, "400x3"),
    (TG, 4, 0, 0x10, "400x3 200x1"),
    (TH, 7, 0, 0x10, "200x4 400x3"),
    (TH, 2, 0, 0x20, "400x2"),
]


@cocotb.parametrize(case=MOVES)
@directed("P312-CHK-15", "P312-CHK-16", "P312-MOT-01", "P312-MOT-05", "P312-MOT-06")
async def p312_worked_moves(dut: Any, case: Any) -> None:
    setting, n, rate, kind, pulses = case
    host = await Host.start(dut, *setting)
    assert await host.ask(message(Code.RAMP, f"00 {rate:04X} {n:08X}")) == message(Code.RAMP, f"{kind:02X}")
    assert await host.response() == stopped(0x40, n)
    assert host.gaps() == rates(pulses)[:-1] and len(host.pulses()) == n
    assert host.t > host.pulses()[-1] + 16 * rates(pulses)[-1]


@cocotb.parametrize(
    case=[
        (T1, 5000, 1_532_294, "1000x5 969x5 940x6", "940x6 969x5 1000x4"),
        (T1, 101, 89_849, "1000x5 969x5 940x6 913x5", "913x5 940x6 969x5 1000x4"),
        (T2, 3999, 1_332_196, "1000x5 999x5 998x5 994x6", "1000x4"),
        (T3, 3000, 992_384, "1000x5 969x5", "488x10 496x9 504x7"),
        (T3, 100, 81_077, "1000x5 969x5 940x6 913x5", "692x8 677x3"),
        (T4, 700, 362_582, "504x8 496x9 488x10 481x9", "969x5 1000x4"),
    ]
)
@directed("P312-CHK-17")
async def p312_long_moves(dut: Any, case: Any) -> None:
    """In long moves of all curves, the number, rates and total time of the pulses are as expected.

    At F = 8 MHz a tick lasts 2 cycles, which keeps the simulation short.
    """
    setting, n, total, first, last = case
    block = bytearray.fromhex(setting)
    block[3] &= 0xF8
    host = await Host.start(dut, block.hex())
    await host.ask(message(Code.RAMP, f"00 0000 {n:08X}"))
    await host.arrival()
    assert 0 <= host.t - 1 - host.pulses()[0] - 2 * total <= 64 and host.condition == 0x02
    gaps, head, tail = host.gaps(2), rates(first), rates(last)
    assert gaps[: len(head)] == head and gaps[-len(tail) :] == tail
    assert await host.response() == stopped(0x40, n)


START_30 = message(Code.RAMP, "00 0000 0000001E")


def change(code: int, rate: int) -> str:
    return message(code, f"00 {rate:04X}")


STOP, SLOW_STOP = message(Code.STOP, "00"), message(Code.SLOW_STOP, "00")
CHANGES = [
    (START_30, 15, [SLOW_STOP], "400x3 200x4 100x13 200x4 400x3", 0x08),
    (START_30, 5, [SLOW_STOP], "400x3 200x6 400x3", 0x08),
    (START_30, 2, [SLOW_STOP], "400x2", 0x10),
    (START_30, 24, [SLOW_STOP], "400x3 200x4 100x16 200x4 400x3", 0x40),
    (START_30, 28, [SLOW_STOP], "400x3 200x4 100x16 200x4 400x1", 0x10),
    (START_30, 15, [change(0x88, 200)], "400x3 200x4 100x8 200x7 400x8", 0x40),
    (message(Code.RAMP, "00 00C8 0000001E"), 11, [change(0x88, 100)], "400x3 200x8 100x17 200x2", 0x40),
    (START_30, 15, [change(0x88, 400)], "400x3 200x4 100x8 400x15", 0x40),
    (message(Code.CONSTANT, "00 0190 0000001E"), 10, [change(0x87, 100)], "400x10 200x4 100x16", 0x40),
    (START_30, 15, [SLOW_STOP, change(0x88, 150)], "400x3 200x4 100x13 200x4 400x3", 0x08),
    (START_30, 18, [change(0x88, 200)], "400x3 200x4 100x11 200x4 400x8", 0x40),
]


@cocotb.parametrize(case=CHANGES)
@directed("P312-CHK-19", "P312-CHK-20", "P312-OVR-11")
async def p312_changes(dut: Any, case: Any) -> None:
    start, when, blocks, pulses, cause = case
    host = await Host.start(dut, *TF)
    await host.ask(start)
    mark = host.mark
    await host.pulse(when)
    for block in blocks:
        assert await host.ask(block) == clean(f"03 01 {block[6:8]}")
    expected = rates(pulses)
    assert await host.response() == stopped(cause, len(expected))
    host.mark = mark
    assert host.gaps() == expected[:-1]


@directed("P312-CHK-20")
async def p312_slower_while_running(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    await host.pulse(10)
    await host.ask(change(0x87, 400))
    host.mark = mark
    await host.pulse(25)
    assert host.gaps() == rates("100x10 200x4 400x10")
    assert await host.ask(STOP) == message(Code.STOP)
    assert await host.response() == stopped(0x04, 25)


@directed("P312-CHK-21", "P312-CHK-64")
async def p312_positions_wrap(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.POSITION_SET, "00 00000003"))
    await host.ask(message(Code.CONSTANT, "40 00C8 0000000A"))
    assert await host.response() == stopped(0x40, 0xFFFFFFF9) and host.out("dir") == 1
    for before, after in ((0x7FFFFFFF, 0x80000000), (0xFFFFFFFF, 0)):
        await host.ask(message(Code.POSITION_SET, f"00 {before:08X}"))
        await host.ask(message(Code.STEP, "00"))
        assert await host.response() == stopped(0x40, after)


def highs(host: Host) -> list[int]:
    """Return the high times of pout since `mark`."""
    changes = host.bench.edges("pout", host.mark)
    return [b - a for (a, level), (b, _) in zip(changes, changes[1:], strict=False) if level]


@directed("P312-CHK-22", "P312-MOT-03")
async def p312_pulse_width(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.CONSTANT, "00 0190 00000003"))
    await host.response()
    assert highs(host) == [80] * 3
    host = await Host.start(dut, "02 03 01 01 02", "00 04 0003 0064", "01 06 000005 000005")
    await host.ask(message(Code.CONSTANT, "00 0003 00000004"))
    await host.response()
    assert highs(host) == [16] * 4 and host.gaps() == [3] * 3


@directed("P312-CHK-31", "P312-CHK-32", "P312-CHK-33", "P312-INP-20")
async def p312_run(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.pins(run=0)
    assert await host.ask(message(Code.RAMP, "00 0000 00000005")) == message(Code.RAMP, "11")
    assert host.condition == 0x20 and not host.pulses()
    await host.pins(run=1)
    assert await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    assert await host.response() == stopped(0x40, 5) and len(host.pulses()) == 5
    await host.pins(run=0)
    await host.ask(message(Code.RAMP, "00 0000 00000005"))
    mark = host.mark
    assert await host.ask(message(Code.RUN_MONITOR)) == message(Code.RUN_MONITOR, "01")
    assert await host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    assert (await host.ask(message(Code.STATUS))).split()[3] == "80"
    assert await host.response() == stopped(0x40, 10)
    host.mark = mark
    assert len(host.pulses()) == 5


@directed("P312-CHK-37", "P312-INP-30")
async def p312_alarm_while_running(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    await host.pulse(5, 20)
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert await host.response() == stopped(0x80, 5)
    assert host.condition == 0x10 and host.out("cd_n") == 0
    assert highs(host) == [80] * 5
    assert await host.ask(message(Code.STEP, "00")) == message(Answer.STATUS, "00 10")


@directed("P312-CHK-40")
async def p312_stop_report_left_unread(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.STEP, "00"))
    await host.wait()
    await host.issue(message(Code.STEP, "00"))
    await host.pause(20_000)
    assert await host.response() == stopped(0x40, 1)
    assert await host.response() == message(Answer.ALARM, "03", source=SPONTANEOUS)
    assert await host.response() == message(Code.STEP)
    assert host.condition == 0x10 and host.bench.golden.position == 2 and await host.quiet()


@directed("P312-CHK-44", "P312-STA-02", "P312-BAD-18", "P312-BAD-19")
async def p312_positioning_end(dut: Any) -> None:
    host = await Host.start(dut, *TF, message(Code.END_TERMINAL, "01"))
    await host.ask(message(Code.CONSTANT, "00 0190 00000005"))
    await host.pause(100_000)
    assert await host.quiet() and host.condition == 0x08
    for block in (STOP, SLOW_STOP, change(0x87, 200), change(0x88, 200)):
        assert await host.ask(block) == clean(f"03 01 {block[6:8]}")
    assert await host.quiet() and host.condition == 0x08
    await host.pins(end_n=0)
    assert await host.response() == stopped(0x40, 5)
    await host.pins(end_n=1)
    await host.ask(message(Code.CONSTANT, "00 0190 00000005"))
    await host.pause(100_000)
    assert await host.ask(message(Code.END_TERMINAL, "00")) == message(Code.END_TERMINAL, "00")
    assert await host.response() == stopped(0x40, 10) and host.condition == 0x02


@directed("P312-CHK-45", "P312-OUT-01")
async def p312_current_reduction(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.CONSTANT, "00 0190 00000003"))
    await host.response()
    last = host.pulses()[-1]
    await host.pause(1_620_000)
    (edge,) = host.bench.falls("cd_n")
    assert abs(edge - last - 1_606_400) <= 4
    await host.ask(message(Code.STEP, "00"))
    await host.response()
    await host.pause(1_584_000)
    # The t0 of this motion stops the timer of cd_n shortly before the timer expires, so cd_n stays high.
    await host.ask(message(Code.CONSTANT, "00 0190 0000000A"))
    await host.response()
    await host.pause(1_000_000)
    assert host.out("cd_n") == 1 and len(host.bench.falls("cd_n")) == 1


@directed("P312-CHK-68", "P312-MOT-01")
async def p312_start_delay(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.ask(message(Code.CONSTANT, "40 0190 00000003"))
    await host.pulse(1)
    (turned,) = host.bench.rises("dir", host.mark)
    assert host.pulses()[0] - turned in (80, 81, 82)


@directed("P312-CHK-69")
async def p312_single_steps_keep_their_distance(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    edges = []
    for number in range(5):
        await host.ask(message(Code.STEP, "00"))
        assert await host.response() == stopped(0x40, number + 1)
        edges += host.pulses()
    assert all(b - a >= 6480 for a, b in zip(edges, edges[1:], strict=False))
