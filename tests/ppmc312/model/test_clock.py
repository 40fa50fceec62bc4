"""Base clocks of the PPMC-312: other crystals and clocks, shortest interval, EXTCK."""

from __future__ import annotations

from math import ceil

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import TF, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code

STOP = message(Code.STOP, "00")


def stopped(cause: int, position: int) -> str:
    return clean(message(Answer.STOPPED, f"{cause:02X} {position:08X}", source=SPONTANEOUS))


def highs(host: Host) -> list[int]:
    """High times of pout since `mark`."""
    changes = host.model.log.of("pout", host.mark)
    return [b - a for (a, level), (b, _) in zip(changes, changes[1:], strict=False) if level]


@verifies("P312-CHK-63", "P312-MOT-02")
def test_other_clock() -> None:
    host = Host("02 03 01 00 03", TF[1], TF[2], clk_hz=27_000_000)
    host.ask(message(Code.CONSTANT, "00 0064 00000032"))
    host.response()
    first = host.pulses()[0]
    assert [edge - first for edge in host.pulses()] == [ceil(27 * 100 * k / 8) for k in range(50)]


@verifies("P312-MOT-04")
def test_shortest_interval_is_4_clk() -> None:
    host = Host("02 03 01 00 02", "00 04 0002 0064", "01 06 000005 000005", clk_hz=8_000_000, version=0x34)
    host.ask(message(Code.CONSTANT, "00 0002 00000006"))
    host.response()
    assert [b - a for a, b in zip(host.pulses(), host.pulses()[1:], strict=False)] == [4] * 5


@verifies("P312-CHK-71", "P312-BAD-14")
def test_external_clock_that_stops() -> None:
    host = Host("02 03 01 06 03", TF[1], TF[2])

    def tick(count: int) -> None:
        for _ in range(count):
            host.pins(extck=1)
            host.pause(10)
            host.pins(extck=0)
            host.pause(10)

    host.ask(message(Code.CONSTANT, "00 0064 00000005"))
    host.pause(100)
    tick(201)
    assert len(host.pulses()) == 3
    host.pause(1000)
    assert highs(host) == [80] * 3 and host.condition == 0x08
    host.ask(STOP)
    assert host.response() == stopped(0x04, 3)
    host.ask(message(Code.CONSTANT, "00 0064 00000005"))
    host.pause(1000)
    host.ask(STOP)
    assert host.response() == stopped(0x04, 3) and not host.pulses()


@verifies("P312-MOT-02", "P312-MOT-03")
def test_external_clock_counts() -> None:
    host = Host("02 03 01 07 02", "00 04 0006 0064", "01 06 000005 000005")
    host.ask(message(Code.CONSTANT, "00 0006 00000004"))
    host.pause(100)
    falls: list[int] = []
    while len(host.pulses()) < 4:
        host.pins(extck=1)
        host.pause(4)
        host.pins(extck=0)
        falls.append(host.t - 1)
        host.pause(5)
    assert host.pulses()[0] - falls[0] in range(1, 5)
    gaps = [b - a for a, b in zip(host.pulses(), host.pulses()[1:], strict=False)]
    period = falls[1] - falls[0]
    assert gaps == [6 * period] * 3 and highs(host)[:3] == [3 * period] * 3
