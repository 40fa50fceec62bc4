"""Frames of the serial mode, valid and invalid: control codes, length, checksum, silence, counters."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import F16, directed

from .builds import CHARS, F8V
from .serial_frames import SILENCE, TS, summed
from .serial_host import SerialHost

NONE = "A0 00 00 00"


@cocotb.parametrize(adr=[0, 1, 2, 4, 7, 8, 15])
@directed("P312-SER-10", "P312-SER-02")
async def p312_serial_addresses(dut: Any, adr: int) -> None:
    host = await SerialHost.start(dut, adr=adr)
    assert await host.ask("25") == "A0 00"
    other = (adr + 5) % 16
    await host.say("25", other)
    await host.ask_poll(other)
    assert await host.quiet(3_000)
    assert await host.poll() == "90"


@directed("P312-SER-10", "P312-BAD-16", "P312-CHK-56")
async def p312_serial_control_codes(dut: Any) -> None:
    """Only control codes 81 and 91 address station 1. Any other byte with bit 7 set ends a frame and does not
    begin one.
    """
    host = await SerialHost.start(dut)
    for control in range(0x80, 0x100, 3):
        if control not in (0x81, 0x91):
            await host.raw("91 30 36 30")
            await host.send(summed(control, b"\x25"))
            await host.raw("31 67")
    await host.raw("A1 B1 C1 D1 E1 F1 7E")
    assert await host.quiet(4_000)
    assert await host.poll() == "90" and await host.asks("4F", "4D") == [NONE, "A0 00 01 00"]


@directed("P312-SER-10")
async def p312_serial_a_control_code_restarts_the_frame(dut: Any) -> None:
    host = await SerialHost.start(dut)
    for begin in ("81", "91", "91 32", "91 32 36", "91 32 36 31", "91 32 36 31 35", "91 33 33", "91 4A"):
        await host.raw(begin)
        assert await host.ask("25") == "A0 00"
    await host.raw("91 32 36 31 35")
    assert await host.poll() == "90"
    assert host.out("auxo_n") == 0x3F and await host.ask("4F") == NONE


@directed("P312-SER-11", "P312-SER-13")
async def p312_serial_checksums_that_look_like_digits(dut: Any) -> None:
    """For all values of instruction 26, a checksum that equals a digit ends the frame at its correct
    length.
    """
    host = await SerialHost.start(dut)
    seen = set()
    for value in (*range(0x0C, 0x19), *range(0x62, 0x69), 0x00, 0x47, 0x48, 0x49):
        frame = summed(0x91, bytes([0x26, value]))
        seen.add(frame[-1])
        await host.send(frame)
        assert await host.hear() == "90" and host.out("auxo_n") == ~value & 0x3F
    assert seen & set(b"0123456789") and seen & set(b"abcdef") and 0 in seen


@directed("P312-SER-11", "P312-BAD-16")
async def p312_serial_short_and_long_frames(dut: Any) -> None:
    """The code determines the length of a frame; characters after the checksum are ignored."""
    host = await SerialHost.start(dut)
    await host.raw("91 32 36 31 33 37")
    assert await host.hear() == "B0 41"
    await host.raw("91 32 35 49 30 31 32 33")
    assert await host.hear(timed=False) == "A0 00"
    await host.raw("35 32 49 7E")
    assert await host.quiet(3_000)
    await host.raw("81 7E 7E 7E")
    assert await host.hear(timed=False) == "90"
    await host.raw("81 30")
    assert await host.hear() == "B0 41"
    assert await host.ask("4F") == "A0 00 00 02" and host.out("auxo_n") == 0x3F


@directed("P312-SER-13", "P312-SER-14", "P312-CHK-57", builds=(F16, CHARS))
async def p312_serial_every_wrong_bit_of_a_checksum(dut: Any) -> None:
    host = await SerialHost.start(dut)
    good = summed(0x91, b"\x26\x15", host.sum_mode)
    for bit in range(7):
        await host.send(good[:-1] + bytes([good[-1] ^ 1 << bit]))
        assert await host.hear() == "B0 41"
    assert host.out("auxo_n") == 0x3F and await host.ask("4F") == "A0 00 00 07"
    await host.send(good)
    assert await host.hear() == "90" and host.out("auxo_n") == 0x2A
    poll = summed(0x81, b"", host.sum_mode)
    for bit in range(7):
        await host.send(poll[:-1] + bytes([poll[-1] ^ 1 << bit]))
        assert await host.hear() == "B0 41"
    assert await host.poll() == "90" and await host.ask("4E") == "A0 00"


@directed("P312-SER-13", builds=(CHARS,))
async def p312_serial_sum_of_characters(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    assert await host.asks("43 89ABCDEF", "42") == ["90", "A0 89 AB CD EF"]
    assert await host.ask("83 0000 00000000") == "B0 42"
    await host.raw("81 7E")
    assert await host.hear() == "B0 41" and host.wire == "B1 34 31 1A"
    await host.raw("81 7F")
    assert await host.hear() == "90" and host.wire == "91 7F"


@directed("P312-SER-13")
async def p312_serial_the_blind_bit(dut: Any) -> None:
    """If bit 7 of a data byte is wrong, this is not detected, and the instruction is executed.

    The manual warns of this: bit 7 of a byte is not part of the checksum.
    """
    host = await SerialHost.start(dut)
    good = summed(0x91, b"\x43\x00\x00\x00\x14")
    wrong = bytearray(good)
    wrong[-3] ^= 0x08
    assert (good[-3:-1], wrong[-3:-1]) == (b"14", b"94")
    await host.send(wrong)
    assert await host.hear() == "90" and await host.ask("42") == "A0 00 00 00 94"
    assert await host.ask("4F") == NONE


BAD_DIGITS = (0x00, 0x2F, 0x3A, 0x3F, 0x40, 0x41, 0x46, 0x60, 0x67, 0x7F, 0x20, 0x0A)


@cocotb.parametrize(bad=BAD_DIGITS)
@directed("P312-SER-12", "P312-CHK-73", "P312-BAD-16")
async def p312_serial_bad_digits(dut: Any, bad: int) -> None:
    """An invalid digit in the data does not shorten the frame, whose end is answered with reply 41."""
    host = await SerialHost.start(dut)
    frame = bytearray(summed(0x91, b"\x26\x15"))
    for place in (3, 4):
        wrong = bytes([*frame[:place], bad, *frame[place + 1 :]])
        await host.send(wrong[:-1])
        assert await host.quiet(500)
        await host.send(wrong[-1:])
        assert await host.hear() == "B0 41"
    assert await host.asks("4F", "4E") == ["A0 00 00 02", "A0 00"] and host.out("auxo_n") == 0x3F


@cocotb.parametrize(line=["91 4A", "91 4A 36", "91 30 4A", "91 46 46 6F 30"])
@directed("P312-SER-12", "P312-SER-17")
async def p312_serial_bad_digits_in_the_code(dut: Any, line: str) -> None:
    """After an invalid digit in the code, the length is unknown: the frame ends after 20 ms of silence."""
    host = await SerialHost.start(dut)
    await host.raw(line)
    assert await host.quiet(SILENCE - 2_000)
    assert await host.hear(SILENCE + 4_096) == "B0 41"
    assert await host.asks("4F", "4E") == ["A0 00 00 01", "A0 00"]


UNKNOWN = ("01", "29", "47", "92", "FE")


@cocotb.parametrize(code=UNKNOWN)
@directed("P312-SER-17", "P312-SER-44", "P312-BAD-06", "P312-CHK-60")
async def p312_serial_unknown_codes(dut: Any, code: str) -> None:
    host = await SerialHost.start(dut)
    await host.raw("91")
    await host.send(code.lower().encode())
    assert await host.quiet(SILENCE - 3_000)
    assert await host.hear(SILENCE + 4_096) == "B0 47"
    assert await host.asks("4E", "4E", "4F") == ["A0 47", "A0 00", NONE]


@directed("P312-SER-17")
async def p312_serial_unknown_code_with_more(dut: Any) -> None:
    """After an unknown code, all characters are discarded, and each of them restarts the silence time.

    A control code ends the frame.
    """
    host = await SerialHost.start(dut)
    await host.raw("91 33 33 30 31 32 33 7E")
    await host.pause(200_000)
    await host.raw("67")
    assert await host.quiet(SILENCE - 3_000)
    assert await host.hear(SILENCE + 4_096) == "B0 47"
    await host.raw("91 33 33 30")
    await host.pause(SILENCE - 10_000)
    assert await host.poll() == "90"
    await host.raw("91 33 33 30")
    await host.pause(SILENCE - 10_000)
    await host.raw("82")
    assert await host.quiet(SILENCE + 8_000)
    await host.raw("91 33 33")
    await host.character(0x30, stop=0)
    assert await host.quiet(SILENCE + 8_000)
    assert await host.ask("4E") == "A0 47"


@cocotb.parametrize(begin=["81", "91 32", "91 32 36 31 35"])
@directed("P312-SER-16")
async def p312_serial_silence_in_a_frame(dut: Any, begin: str) -> None:
    """A frame continues after 19 ms of silence; after 21 ms of silence, its remaining characters are
    ignored.
    """
    rest = {"81": "7E"}.get(begin, "91 32 36 31 35 33"[len(begin) + 1 :])
    host = await SerialHost.start(dut)
    await host.raw(begin)
    await host.pause(304_000)
    await host.raw(rest)
    assert await host.hear() == "90"
    level = host.out("auxo_n")
    await host.raw("91 32 36 30 30 48")
    assert await host.hear() == "90"
    await host.raw(begin)
    await host.pause(SILENCE + 16_000)
    await host.raw(rest)
    assert await host.quiet(8_000) and host.out("auxo_n") == 0x3F
    assert await host.poll() == "90" and await host.asks("4F", "4E") == [NONE, "A0 00"]
    assert level == (0x3F if begin == "81" else 0x2A)


@cocotb.parametrize(after=[-40, -1, 0, 1, 2, 40])
@directed("P312-SER-16")
async def p312_serial_the_end_of_the_silence(dut: Any, after: int) -> None:
    """A character whose stop bit is sampled within 20 ms belongs to the frame."""
    host = await SerialHost.start(dut)
    await host.raw("81")
    # If a character follows without a pause, 10 bits pass from one stop bit to the next.
    await host.pause(SILENCE - 1_920 + after)
    await host.raw("7E")
    assert await host.hear() == "90" if after < 0 else abs(after) < 3 or await host.quiet(8_000)
    await host.pause(5_000)


@directed("P312-SER-15", "P312-SER-19")
async def p312_serial_a_master_that_talks_out_of_turn(dut: Any) -> None:
    """While a reply is pending or being sent, each control code for this station is an overrun and has no
    effect.
    """
    host = await SerialHost.start(dut)
    await host.raw("91 34 31 2D")
    await host.send(summed(0x81) + summed(0x91, b"\x26\x15"))
    assert await host.hear(timed=False) == "A0 12" and await host.quiet(4_000)
    assert host.out("auxo_n") == 0x3F and await host.ask("4F") == "A0 00 02 00"
    await host.raw("91 34 31 2D")
    await host.raw("91 A1 B1 81")
    assert await host.hear(timed=False) == "A0 12" and await host.ask("4F") == "A0 00 02 00"


@directed("P312-SER-15", "P312-SER-18")
async def p312_serial_out_of_turn_while_a_table_is_built(dut: Any) -> None:
    host = await SerialHost.start(dut)
    await host.say(TS)
    for _ in range(4):
        await host.send(summed(0x81))
    await host.send(summed(0x91, b"\x25"))
    assert await host.hear(65_536) == "90"
    assert await host.poll() == "90" and await host.ask("4F") == "A0 00 05 00"


@directed("P312-SER-15")
async def p312_serial_a_station_that_hears_itself(dut: Any) -> None:
    """If a station receives its own replies, it counts echoes of control codes 91 and 81 as overruns, but not
    those of A1 and B1.

    This happens with a master that does not gate its receiver.
    """
    host = await SerialHost.start(dut)
    for line, echo in (("81 7E", "91 6E"), ("91 34 31 2D", "A1 31 32 4C"), ("81 00", "B1 34 31 0D")):
        await host.raw(line)
        rise = await host.begin()
        host.back_to(rise + 192)
        await host.raw(echo)
        assert await host.hear(timed=False) in ("90", "A0 12", "B0 41")
    assert await host.ask("4F") == "A0 00 01 01"


@cocotb.parametrize(clk=[-3, -2, -1, 0, 1, 2, 3])
@directed("P312-SER-15", "P312-SER-19")
async def p312_serial_the_end_of_a_turn(dut: Any, clk: int) -> None:
    """A control code whose stop bit is sampled before the fall of snd is an overrun; after the fall it is a
    frame.
    """
    host = await SerialHost.start(dut)
    await host.raw("81 7E")
    rise = await host.begin()
    # snd falls 21 bits after its rise; the middle of the next stop bit is 9.5 bits after its start.
    host.back_to(rise + 21 * 192 - 19 * 96 - 2 + clk)
    await host.raw("81 7E")
    assert await host.hear(timed=False) == "90"
    late = not await host.quiet(4_000)
    assert abs(clk) < 3 or late == (clk > 0)
    if late:
        assert await host.hear() == "90"
    assert await host.ask("4F") == f"A0 00 {not late:02X} 00"


@cocotb.parametrize(kind=["framing", "overrun", "checksum"])
@directed("P312-SER-45", "P312-SER-15", "P312-SER-14", builds=(F8V,))
async def p312_serial_counters_saturate(dut: Any, kind: str) -> None:
    host = await SerialHost.start(dut, "43 00000000")
    if kind == "framing":
        for _ in range(258):
            await host.low(9.8)
    elif kind == "checksum":
        for _ in range(258):
            await host.raw("81 00")
            assert await host.hear() == "B0 41"
    else:
        # The master sends nine control codes while the station sends ten characters.
        for _ in range(29):
            await host.say("42")
            await host.send(b"\x81" * 9)
            assert await host.hear(timed=False) == "A0 00 00 00 00"
    counts = {"framing": "FF 00 00", "overrun": "00 FF 00", "checksum": "00 00 FF"}[kind]
    assert [await host.ask("4F"), await host.ask("4F")] == [f"A0 {counts}", NONE]
