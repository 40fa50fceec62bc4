"""Acceptance checks of the PPMC-312 in serial mode, byte for byte."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import pytest

from cocotb_tests.harness.block_host import clean
from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.serial_frames import T1, TS, summed
from cocotb_tests.ppmc312.serial_host import SerialHost


def exchange(host: SerialHost, text: str, within: int = 4_096) -> str:
    """Bytes on the line, and those of the reply."""
    host.raw(text)
    host.hear(within)
    return host.wire


@verifies("P312-CHK-54", "P312-SER-18", "P312-SER-01", "P312-SER-02")
def test_poll_at_19200() -> None:
    host = SerialHost(mod=5)
    host.raw("81 7E")
    rise = host.begin()
    assert host.hear() == "90" and host.wire == "91 6E"
    bit = Fraction(16_000_000, 19_200)
    assert host.middle + bit <= rise <= host.middle + bit + 64
    assert [t for t, level in host.model.log.of("snd", rise) if not level] == [rise + ceil(21 * bit)]
    assert host.model.log.of("txd", rise)[0] == (rise + ceil(bit), 0)


@verifies("P312-CHK-55", "P312-SER-14", "P312-SER-45")
def test_wrong_checksum() -> None:
    host = SerialHost()
    assert exchange(host, "81 00") == "B1 34 31 0D"
    assert [host.ask("4F"), host.ask("4F")] == ["A0 00 00 01", "A0 00 00 00"]


@verifies("P312-CHK-56", "P312-SER-10", "P312-BAD-16")
def test_not_for_this_station() -> None:
    host = SerialHost()
    for line in (
        summed(0x82),
        summed(0xA1),
        summed(0xB1),
        summed(0x92, b"\x25"),
        summed(0xC1),
        summed(0xA1, b"\x25"),
    ):
        host.send(line)
        assert host.quiet(6_000)
    assert host.poll() == "90"


SHEET = "91 30 30 31 30 31 31 32 32 35 35 36 36 61 62 63 64 65 66"


@pytest.mark.parametrize(
    ("mode", "checksum", "answer"),
    [
        ("BINARY", "09", "B1 34 32 0C"),
        ("BINARY", "4D", "B1 34 31 0D"),
        ("CHARS", "4D", "B1 34 32 19"),
        ("CHARS", "09", "B1 34 31 1A"),
    ],
)
@verifies("P312-CHK-57", "P312-SER-13", "P312-SER-41")
def test_frame_of_the_sheet(mode: str, checksum: str, answer: str) -> None:
    host = SerialHost(sum_mode=mode)
    assert exchange(host, f"{SHEET} {checksum}") == answer


@verifies("P312-CHK-58", "P312-SER-30")
def test_busy_until_the_end() -> None:
    host = SerialHost(TS)
    assert host.ask("83 0000 000003E8") == "90"
    said = []
    while not said or said[-1] == "81 7E":
        said.append(exchange(host, "81 7E"))
        host.pause(20_000)
    assert len(said) > 5 and said[-1] == "A1 33 38 26"
    assert [exchange(host, "81 7E") for _ in range(3)] == ["91 6E"] * 3


@verifies("P312-CHK-59", "P312-SER-30", "P312-INP-30")
def test_alarm_in_a_motion() -> None:
    host = SerialHost(TS)
    assert host.ask("86 0000") == "90"
    host.pause(4_000)
    host.pins(alm_n=0)
    host.pause(1_000)
    polls = [exchange(host, "81 7E") for _ in range(3)]
    assert polls == ["B1 34 36 08", "A1 33 31 2D", "91 6E"]
    assert host.condition == 0x10


@verifies("P312-CHK-60", "P312-SER-17")
def test_unknown_code() -> None:
    host = SerialHost()
    host.raw("91 34 37 4E")
    end = host.middle
    assert host.quiet(310_000)
    assert host.hear(324_000) == "B0 47" and host.wire == "B1 34 37 07"
    rise = max(t for t, level in host.model.log.of("snd") if level)
    assert 320_000 <= rise - end <= 320_016


@pytest.mark.parametrize("mod", [0, 1, 2, 3, 4])
@verifies("P312-CHK-61", "P312-BAD-17", "P312-PRT-03")
def test_silent_station(mod: int) -> None:
    host = SerialHost(mod=mod)
    for line in ("81 7E", "91 34 31 2D", "91 30 36 30 31 67"):
        host.raw(line)
        assert host.quiet(8_000)
    host.pins(mod=7)
    host.raw("81 7E")
    assert host.quiet(8_000)
    host.pins(rst_n=0)
    host.pause(10)
    host.pins(rst_n=1)
    host.pause(20)
    assert host.ask("06 00") == "90" and host.ask(TS) == "90"
    assert host.ask("49 03 01 20 00 00 00 00 00 00 00") == "90"
    host.blip("evt0_n")
    assert host.poll() == "B0 29" and not host.out("exon_n")


@verifies("P312-CHK-62", "P312-CMD-FF", "P312-SER-19")
def test_reset() -> None:
    host = SerialHost("43 00001000")
    host.say("FF")
    assert host.quiet(8_000)
    assert exchange(host, "81 7E") == "91 6E"
    assert host.ask("42") == "A0 00 00 00 00"


@verifies("P312-CHK-66", "P312-OVR-12", "P312-SER-22")
def test_stop_at_a_position() -> None:
    host = SerialHost(TS)
    assert host.ask("90 00001000") == "90" and host.ask("86 0000") == "90"
    mark = host.mark
    while not host.model.core.operation.at_rest:
        host.step()
    polls = [exchange(host, "81 7E") for _ in range(3)]
    assert polls == ["B1 32 38 26", "A1 33 37 27", "91 6E"]
    assert host.ask("42") == "A0 00 00 10 00" and len(host.model.log.rises("pout", mark)) == 0x1000


@verifies("P312-CHK-67", "P312-SER-30")
def test_order_of_polls() -> None:
    host = SerialHost(TS, "90 00000014")
    host.ask("84 01F4 00000064")
    while not host.model.core.operation.at_rest:
        host.step()
    host.pins(alm_n=0)
    host.pause(100)
    assert [host.poll() for _ in range(4)] == ["B0 46", "B0 28", "A0 37", "90"]


@verifies("P312-CHK-73", "P312-SER-12")
def test_upper_case() -> None:
    host = SerialHost("06 01")
    host.raw("91 30 36 30 4A")
    assert host.quiet(20_000)
    host.raw("67")
    host.hear()
    assert host.wire == "B1 34 31 0D"
    assert host.ask("4D") == f"A0 {clean('040100')}"


@verifies("P312-SER-41", "P312-CMD-00")
def test_flags_of_the_setting() -> None:
    """Bits 7:4 do not count: LE is one of them."""
    host = SerialHost()
    for flags in ("01", "11", "F1"):
        assert host.ask(flags.join(("00 ", T1[5:]))) == "90"
        assert host.condition == 0x02
