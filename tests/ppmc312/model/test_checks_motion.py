"""Acceptance checks of the PPMC-312: pulses, stops, changes, limits, searches on the pins of the model."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import T1, T2, T3, T4, TF, TG, TH, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code


def rates(text: str) -> list[int]:
    """`400x3 200x4` as a list of intervals."""
    return [
        int(rate) for word in text.split() for rate, count in [word.split("x")] for _ in range(int(count))
    ]


def stopped(cause: int, position: int) -> str:
    return clean(message(Answer.STOPPED, f"{cause:02X} {position:08X}", source=SPONTANEOUS))


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


@pytest.mark.parametrize(("setting", "n", "rate", "kind", "pulses"), MOVES)
@verifies("P312-CHK-15", "P312-CHK-16", "P312-MOT-01", "P312-MOT-05", "P312-MOT-06")
def test_worked_moves(setting: tuple[str, ...], n: int, rate: int, kind: int, pulses: str) -> None:
    host = Host(*setting)
    assert host.ask(message(Code.RAMP, f"00 {rate:04X} {n:08X}")) == message(Code.RAMP, f"{kind:02X}")
    assert host.response() == stopped(0x40, n)
    assert host.gaps() == rates(pulses)[:-1] and len(host.pulses()) == n
    assert host.t > host.pulses()[-1] + 16 * rates(pulses)[-1]


@pytest.mark.parametrize(
    ("setting", "n", "total", "first", "last"),
    [
        (T1, 5000, 1_532_294, "1000x5 969x5 940x6", "940x6 969x5 1000x4"),
        (T1, 101, 89_849, "1000x5 969x5 940x6 913x5", "913x5 940x6 969x5 1000x4"),
        (T2, 3999, 1_332_196, "1000x5 999x5 998x5 994x6", "1000x4"),
        (T3, 3000, 992_384, "1000x5 969x5", "488x10 496x9 504x7"),
        (T3, 100, 81_077, "1000x5 969x5 940x6 913x5", "692x8 677x3"),
        (T4, 700, 362_582, "504x8 496x9 488x10 481x9", "969x5 1000x4"),
    ],
)
@verifies("P312-CHK-17")
def test_long_moves(setting: str, n: int, total: int, first: str, last: str) -> None:
    """At F = 8 MHz, 2 clk a tick, so that nobody has to wait for 70 million clk."""
    block = bytearray.fromhex(setting)
    block[3] &= 0xF8
    host = Host(block.hex())
    host.ask(message(Code.RAMP, f"00 0000 {n:08X}"))
    while not host.model.core.responses.any_waiting:
        host.step()
    assert 0 <= host.model.now - host.pulses()[0] - 2 * total <= 64 and host.condition == 0x02
    gaps, head, tail = host.gaps(2), rates(first), rates(last)
    assert gaps[: len(head)] == head and gaps[-len(tail) :] == tail
    assert host.response() == stopped(0x40, n)


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


@pytest.mark.parametrize(("start", "when", "blocks", "pulses", "cause"), CHANGES)
@verifies("P312-CHK-19", "P312-CHK-20", "P312-OVR-11")
def test_changes(start: str, when: int, blocks: list[str], pulses: str, cause: int) -> None:
    host = Host(*TF)
    host.ask(start)
    mark = host.mark
    host.pulse(when)
    for block in blocks:
        assert host.ask(block) == clean(f"03 01 {block[6:8]}")
    expected = rates(pulses)
    assert host.response() == stopped(cause, len(expected))
    host.mark = mark
    assert host.gaps() == expected[:-1]


@verifies("P312-CHK-20")
def test_slower_while_running() -> None:
    host = Host(*TF)
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    mark = host.mark
    host.pulse(10)
    host.ask(change(0x87, 400))
    host.mark = mark
    host.pulse(25)
    assert host.gaps() == rates("100x10 200x4 400x10")
    assert host.ask(STOP) == message(Code.STOP)
    assert host.response() == stopped(0x04, 25)


@verifies("P312-CHK-21", "P312-CHK-64")
def test_positions_wrap() -> None:
    host = Host(*TF)
    host.ask(message(Code.POSITION_SET, "00 00000003"))
    host.ask(message(Code.CONSTANT, "40 00C8 0000000A"))
    assert host.response() == stopped(0x40, 0xFFFFFFF9) and host.out("dir") == 1
    for before, after in ((0x7FFFFFFF, 0x80000000), (0xFFFFFFFF, 0)):
        host.ask(message(Code.POSITION_SET, f"00 {before:08X}"))
        host.ask(message(Code.STEP, "00"))
        assert host.response() == stopped(0x40, after)


def highs(host: Host) -> list[int]:
    """High times of pout since `mark`."""
    changes = host.model.log.of("pout", host.mark)
    return [b - a for (a, level), (b, _) in zip(changes, changes[1:], strict=False) if level]


@verifies("P312-CHK-22", "P312-MOT-03")
def test_pulse_width() -> None:
    host = Host(*TF)
    host.ask(message(Code.CONSTANT, "00 0190 00000003"))
    host.response()
    assert highs(host) == [80] * 3
    host = Host("02 03 01 01 02", "00 04 0003 0064", "01 06 000005 000005")
    host.ask(message(Code.CONSTANT, "00 0003 00000004"))
    host.response()
    assert highs(host) == [16] * 4 and host.gaps() == [3] * 3


@verifies("P312-CHK-31", "P312-CHK-32", "P312-CHK-33", "P312-INP-20")
def test_run() -> None:
    host = Host(*TF)
    host.pins(run=0)
    assert host.ask(message(Code.RAMP, "00 0000 00000005")) == message(Code.RAMP, "11")
    assert host.condition == 0x20 and not host.pulses()
    host.pins(run=1)
    assert host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    assert host.response() == stopped(0x40, 5) and len(host.pulses()) == 5
    host.pins(run=0)
    host.ask(message(Code.RAMP, "00 0000 00000005"))
    mark = host.mark
    assert host.ask(message(Code.RUN_MONITOR)) == message(Code.RUN_MONITOR, "01")
    assert host.response() == message(Answer.HOLD_EXECUTED, source=SPONTANEOUS)
    assert host.ask(message(Code.STATUS)).split()[3] == "80"
    assert host.response() == stopped(0x40, 10)
    host.mark = mark
    assert len(host.pulses()) == 5


@verifies("P312-CHK-37", "P312-INP-30")
def test_alarm_while_running() -> None:
    host = Host(*TF)
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    host.pulse(5, 20)
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.response() == stopped(0x80, 5)
    assert host.condition == 0x10 and host.out("cd_n") == 0
    assert highs(host) == [80] * 5
    assert host.ask(message(Code.STEP, "00")) == message(Answer.STATUS, "00 10")


@verifies("P312-CHK-40")
def test_stop_report_left_unread() -> None:
    host = Host(*TF)
    host.ask(message(Code.STEP, "00"))
    host.wait()
    host.issue(message(Code.STEP, "00"))
    host.pause(20_000)
    assert host.response() == stopped(0x40, 1)
    assert host.response() == message(Answer.ALARM, "03", source=SPONTANEOUS)
    assert host.response() == message(Code.STEP)
    assert host.condition == 0x10 and host.model.position == 2 and host.quiet()


@verifies("P312-CHK-44", "P312-STA-02", "P312-BAD-18", "P312-BAD-19")
def test_positioning_end() -> None:
    host = Host(*TF, message(Code.END_TERMINAL, "01"))
    host.ask(message(Code.CONSTANT, "00 0190 00000005"))
    host.pause(100_000)
    assert host.quiet() and host.condition == 0x08
    for block in (STOP, SLOW_STOP, change(0x87, 200), change(0x88, 200)):
        assert host.ask(block) == clean(f"03 01 {block[6:8]}")
    assert host.quiet() and host.condition == 0x08
    host.pins(end_n=0)
    assert host.response() == stopped(0x40, 5)
    host.pins(end_n=1)
    host.ask(message(Code.CONSTANT, "00 0190 00000005"))
    host.pause(100_000)
    assert host.ask(message(Code.END_TERMINAL, "00")) == message(Code.END_TERMINAL, "00")
    assert host.response() == stopped(0x40, 10) and host.condition == 0x02


@verifies("P312-CHK-45", "P312-OUT-01")
def test_current_reduction() -> None:
    host = Host(*TF)
    host.ask(message(Code.CONSTANT, "00 0190 00000003"))
    host.response()
    last = host.pulses()[-1]
    host.pause(1_620_000)
    (edge,) = host.model.log.falls("cd_n")
    assert abs(edge - last - 1_606_400) <= 4
    host.ask(message(Code.STEP, "00"))
    host.response()
    host.pause(1_584_000)
    # Runs on past the time of the timer that its t0 has stopped.
    host.ask(message(Code.CONSTANT, "00 0190 0000000A"))
    host.response()
    host.pause(1_000_000)
    assert host.out("cd_n") == 1 and len(host.model.log.falls("cd_n")) == 1


@verifies("P312-CHK-68", "P312-MOT-01")
def test_start_delay() -> None:
    host = Host(*TF)
    host.ask(message(Code.CONSTANT, "40 0190 00000003"))
    host.pulse(1)
    (turned,) = host.model.log.rises("dir", host.mark)
    assert host.pulses()[0] - turned in (80, 81, 82)


@verifies("P312-CHK-69")
def test_single_steps_keep_their_distance() -> None:
    host = Host(*TF)
    edges = []
    for number in range(5):
        host.ask(message(Code.STEP, "00"))
        assert host.response() == stopped(0x40, number + 1)
        edges += host.pulses()
    assert all(b - a >= 6480 for a, b in zip(edges, edges[1:], strict=False))
