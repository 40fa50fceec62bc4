"""Acceptance checks of the PPMC-312 in serial mode, byte for byte."""

from __future__ import annotations

from fractions import Fraction
from math import ceil
from typing import Any

import cocotb

from cocotb_tests.harness import F16, directed
from cocotb_tests.harness.bus import clean

from .builds import CHARS
from .serial_frames import T1, TS, summed
from .serial_host import SerialHost


async def exchange(host: SerialHost, text: str, within: int = 4_096) -> str:
    """Send bytes on the line; return the bytes of the reply."""
    await host.raw(text)
    await host.hear(within)
    return host.wire


@directed("P312-CHK-54", "P312-SER-18", "P312-SER-01", "P312-SER-02")
async def p312_serial_poll_at_19200(dut: Any) -> None:
    host = await SerialHost.start(dut, mod=5)
    await host.raw("81 7E")
    rise = await host.begin()
    assert await host.hear() == "90" and host.wire == "91 6E"
    bit = Fraction(16_000_000, 19_200)
    assert host.middle + bit <= rise <= host.middle + bit + 64
    assert [t for t, level in host.bench.edges("snd", rise) if not level] == [rise + ceil(21 * bit)]
    assert host.bench.edges("txd", rise)[0] == (rise + ceil(bit), 0)


@directed("P312-CHK-55", "P312-SER-14", "P312-SER-45")
async def p312_serial_wrong_checksum(dut: Any) -> None:
    host = await SerialHost.start(dut)
    assert await exchange(host, "81 00") == "B1 34 31 0D"
    assert [await host.ask("4F"), await host.ask("4F")] == ["A0 00 00 01", "A0 00 00 00"]


@directed("P312-CHK-56", "P312-SER-10", "P312-BAD-16")
async def p312_serial_not_for_this_station(dut: Any) -> None:
    host = await SerialHost.start(dut)
    for line in (
        summed(0x82),
        summed(0xA1),
        summed(0xB1),
        summed(0x92, b"\x25"),
        summed(0xC1),
        summed(0xA1, b"\x25"),
    ):
        await host.send(line)
        assert await host.quiet(6_000)
    assert await host.poll() == "90"


SHEET = "91 30 30 31 30 31 31 32 32 35 35 36 36 61 62 63 64 65 66"


ANSWERS = {
    "BINARY": {"09": "B1 34 32 0C", "4D": "B1 34 31 0D"},
    "CHARS": {"4D": "B1 34 32 19", "09": "B1 34 31 1A"},
}


@cocotb.parametrize(checksum=["09", "4D"])
@directed("P312-CHK-57", "P312-SER-13", "P312-SER-41", builds=(F16, CHARS))
async def p312_serial_frame_of_the_data_sheet(dut: Any, checksum: str) -> None:
    """In each build, the frame of the data sheet is valid with exactly one of the two checksums."""
    host = await SerialHost.start(dut)
    assert await exchange(host, f"{SHEET} {checksum}") == ANSWERS[host.sum_mode][checksum]


@directed("P312-CHK-58", "P312-SER-30")
async def p312_serial_busy_until_the_end(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    assert await host.ask("83 0000 000003E8") == "90"
    said = []
    while not said or said[-1] == "81 7E":
        said.append(await exchange(host, "81 7E"))
        await host.pause(20_000)
    assert len(said) > 5 and said[-1] == "A1 33 38 26"
    assert [await exchange(host, "81 7E") for _ in range(3)] == ["91 6E"] * 3


@directed("P312-CHK-59", "P312-SER-30", "P312-INP-30")
async def p312_serial_alarm_in_a_motion(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    assert await host.ask("86 0000") == "90"
    await host.pause(4_000)
    await host.pins(alm_n=0)
    await host.pause(1_000)
    polls = [await exchange(host, "81 7E") for _ in range(3)]
    assert polls == ["B1 34 36 08", "A1 33 31 2D", "91 6E"]
    assert await host.state() == 0x10


@directed("P312-CHK-60", "P312-SER-17")
async def p312_serial_unknown_code(dut: Any) -> None:
    host = await SerialHost.start(dut)
    await host.raw("91 34 37 4E")
    end = host.middle
    assert await host.quiet(310_000)
    assert await host.hear(324_000) == "B0 47" and host.wire == "B1 34 37 07"
    rise = max(t for t, level in host.bench.edges("snd") if level)
    assert 320_000 <= rise - end <= 320_016


@cocotb.parametrize(mod=[0, 1, 2, 3, 4])
@directed("P312-CHK-61", "P312-BAD-17", "P312-PRT-03")
async def p312_serial_silent_station(dut: Any, mod: int) -> None:
    host = await SerialHost.start(dut, mod=mod)
    for line in ("81 7E", "91 34 31 2D", "91 30 36 30 31 67"):
        await host.raw(line)
        assert await host.quiet(8_000)
    await host.pins(mod=7)
    await host.raw("81 7E")
    assert await host.quiet(8_000)
    await host.pins(rst_n=0)
    await host.pause(10)
    await host.pins(rst_n=1)
    await host.pause(20)
    assert await host.asks("06 00", TS) == ["90", "90"]
    assert await host.ask("49 03 01 20 00 00 00 00 00 00 00") == "90"
    await host.blip("evt0_n")
    assert await host.poll() == "B0 29" and not host.out("exon_n")


@directed("P312-CHK-62", "P312-CMD-FF", "P312-SER-19")
async def p312_serial_reset(dut: Any) -> None:
    host = await SerialHost.start(dut, "43 00001000")
    await host.say("FF")
    assert await host.quiet(8_000)
    assert await exchange(host, "81 7E") == "91 6E"
    assert await host.ask("42") == "A0 00 00 00 00"


@directed("P312-CHK-66", "P312-OVR-12", "P312-SER-22")
async def p312_serial_stop_at_a_position(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    assert await host.asks("90 00001000", "86 0000") == ["90", "90"]
    mark = host.mark
    await host.at_rest(after=0)
    polls = [await exchange(host, "81 7E") for _ in range(3)]
    assert polls == ["B1 32 38 26", "A1 33 37 27", "91 6E"]
    assert await host.ask("42") == "A0 00 00 10 00" and len(host.bench.rises("pout", mark)) == 0x1000


@directed("P312-CHK-67", "P312-SER-30")
async def p312_serial_order_of_polls(dut: Any) -> None:
    host = await SerialHost.start(dut, TS, "90 00000014")
    await host.ask("84 01F4 00000064")
    await host.at_rest(after=0)
    await host.pins(alm_n=0)
    await host.pause(100)
    assert await host.polls(4) == ["B0 46", "B0 28", "A0 37", "90"]


@directed("P312-CHK-73", "P312-SER-12")
async def p312_serial_upper_case(dut: Any) -> None:
    host = await SerialHost.start(dut, "06 01")
    await host.raw("91 30 36 30 4A")
    assert await host.quiet(20_000)
    await host.raw("67")
    await host.hear()
    assert host.wire == "B1 34 31 0D"
    assert await host.ask("4D") == f"A0 {clean('040100')}"


@directed("P312-SER-41", "P312-CMD-00")
async def p312_serial_flags_of_the_setting(dut: Any) -> None:
    """Bits 7:4 of the flags, which include LE, are ignored."""
    host = await SerialHost.start(dut)
    for flags in ("01", "11", "F1"):
        assert await host.ask(flags.join(("00 ", T1[5:]))) == "90"
        assert await host.state() == 0x02
