"""Acceptance checks of the PPMC-312: limits, high-speed limits, origin search, zero return."""

from __future__ import annotations

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import TF, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code

STOP = message(Code.STOP, "00")
START_30 = message(Code.RAMP, "00 0000 0000001E")


def stopped(cause: int, position: int) -> str:
    return clean(message(Answer.STOPPED, f"{cause:02X} {position:08X}", source=SPONTANEOUS))


def rates(text: str) -> list[int]:
    """`400x3 200x4` as a list of intervals."""
    return [
        int(rate) for word in text.split() for rate, count in [word.split("x")] for _ in range(int(count))
    ]


@verifies("P312-CHK-34", "P312-CHK-35", "P312-BAD-12")
def test_limits() -> None:
    host = Host(*TF)
    host.pins(fl_n=0)
    assert host.ask(START_30) == message(Answer.LIMIT)
    assert host.ask(message(Code.RAMP, "40 0000 00000002")) == message(Code.RAMP, "10")
    assert host.response() == stopped(0x40, 0xFFFFFFFE)
    host.pins(fl_n=1)
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    host.pulse(5)
    host.pins(bl_n=0)
    edge = host.pulse(10, 1595)
    host.pins(fl_n=0)
    assert host.response() == stopped(0x01, 8)
    assert edge == host.pulses()[-1]
    host.pins(bl_n=0)
    assert host.ask(START_30) == host.ask(START_30.replace("82 00", "82 40")) == message(Answer.LIMIT)


@verifies("P312-CHK-36", "P312-INP-12")
def test_high_speed_limit() -> None:
    host = Host(*TF)
    host.ask(message(Code.SPEED_LIMIT, "00C8"))
    host.ask(message(Code.FOREVER_CONSTANT, "00 0064"))
    host.pulse(20)
    host.pins(fhl_n=0)
    assert host.response() == stopped(0x02, 32)
    assert host.gaps() == rates("100x20 100x5 200x4 400x2")
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 0064")) == message(Answer.LIMIT)
    assert host.ask(message(Code.FOREVER_CONSTANT, "00 012C")) == message(Code.FOREVER_CONSTANT, "00")
    host.pulse(10)
    host.ask(STOP)
    assert host.response() == stopped(0x04, 42)


@verifies("P312-CHK-41", "P312-CHK-43", "P312-MOT-40", "P312-MOT-41")
def test_origin_search() -> None:
    host = Host(*TF)
    host.ask(message(Code.ORIGIN_SEARCH, "10 00C8"))
    host.pulse(50)
    host.pins(org_n=0)
    host.pulse(53)
    host.pins(index_n=0)
    assert host.response() == stopped(0x20, 53)
    assert host.ask(message(Code.ORIGIN_SEARCH, "00 00C8")) == message(Code.ORIGIN_SEARCH, "00")
    assert host.response() == stopped(0x20, 53) and not host.pulses()
    host.pins(index_n=1)
    host.ask(message(Code.ORIGIN_SEARCH, "10 00C8"))
    host.pulse(20)
    host.ask(STOP)
    assert host.response() == stopped(0x04, 73)


@verifies("P312-CHK-42", "P312-MOT-42")
def test_zero_return() -> None:
    host = Host(*TF)
    host.ask(message(Code.ZERO_RETURN, "00 0000"))
    host.pulse(15)
    host.pins(org_n=0)
    host.pulse(17)
    host.pins(org_n=1)
    host.pulse(27)
    host.pulse(37, 4)
    assert host.model.position == 17
    host.pulse(38)
    host.pins(org_n=0)
    assert host.response() == stopped(0x20, 16)
    assert len(host.pulses()) == 38
    turned = host.model.log.rises("dir", host.mark)
    assert len(turned) == 1 and 6400 <= turned[0] - host.pulses()[26] <= 6464
    gaps = [
        round(gap / 16) for gap in (b - a for a, b in zip(host.pulses(), host.pulses()[1:], strict=False))
    ]
    assert gaps[:26] == rates("400x3 200x4 100x8 100x5 200x4 400x2") and gaps[27:] == [400] * 10
    assert host.quiet()


@verifies("P312-MOT-43")
def test_zero_return_ended_by_a_stop() -> None:
    host = Host(*TF)
    host.ask(message(Code.ZERO_RETURN, "00 0000"))
    mark = host.mark
    host.pulse(15)
    host.pins(org_n=0)
    host.pulse(18)
    assert host.ask(message(Code.SLOW_STOP, "00")) == message(Code.SLOW_STOP)
    assert host.response() == stopped(0x08, 27)
    host.mark = mark
    assert len(host.pulses()) == 27 and host.out("dir") == 0
