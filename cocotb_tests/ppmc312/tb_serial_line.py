"""Line of the serial mode: speeds, wrong bit times, noise, breaks, framing errors."""

from __future__ import annotations

from fractions import Fraction
from math import ceil
from typing import Any

import cocotb

from cocotb_tests.harness import F16, directed

from .builds import F27, F27X12, SLOW, SLOWEST
from .serial_frames import TS, summed
from .serial_host import SerialHost

PATTERNS = (0x00, 0x55, 0xAA, 0x7F, 0x80, 0xFF, 0x01, 0xFE)


async def echo(host: SerialHost, word: int) -> None:
    """Write a position and read it back, which uses all bits of eight characters in both directions."""
    assert await host.ask(f"43 {word:08X}") == "90"
    assert await host.ask("42") == " ".join(
        ("A0", f"{word:08X}"[:2], *(f"{word:08X}"[k : k + 2] for k in (2, 4, 6)))
    )


@cocotb.parametrize(mod=[5, 6, 7])
@directed("P312-SER-01", "P312-SER-18")
async def p312_serial_speeds(dut: Any, mod: int) -> None:
    host = await SerialHost.start(dut, mod=mod)
    await echo(host, 0x5AC30FF1)
    assert await host.poll() == "90"


@cocotb.parametrize(mod=[5, 6, 7])
@directed("P312-SER-01", "P312-SER-18", "P312-GEN-02", builds=(F27, F27X12))
async def p312_serial_bit_times_that_are_no_whole_clk(dut: Any, mod: int) -> None:
    host = await SerialHost.start(dut, mod=mod)
    await echo(host, 0x5AC30FF1)


REPLIES = {"81 7E": "90", "91 34 31 2D": "A0 12", "91 32 30 4E": "90"}
REPLIES |= {"91 32 30 4F": "B0 41", "91 34 65 20": "A0 00"}
"""Frame -> reply, for each source of a reply: the poll, the core with and without data, and the station
itself (last two frames).
"""


@cocotb.parametrize(mod=[5, 6, 7])
@directed("P312-SER-18", builds=(F16, F27X12))
async def p312_serial_a_reply_leaves_one_pair_of_wires_to_its_master(dut: Any, mod: int) -> None:
    """snd rises half a bit after the end of the master's stop bit, at most 6 cycles late."""
    host = await SerialHost.start(dut, mod=mod)
    for line, answer in REPLIES.items():
        await host.raw(line)
        assert await host.hear() == answer
        assert 0 <= host.waited - host.bit / 2 <= 6


@cocotb.parametrize(mod=[5, 6, 7])
@directed("P312-SER-18", builds=(F16, SLOW, SLOWEST))
async def p312_serial_a_slow_line_driver_has_its_time(dut: Any, mod: int) -> None:
    """With a slow line driver, snd rises SND_WAIT + 0.5 bits after the end of the frame (P312-SER-18).

    The start bit begins exactly SND_LEAD bits later, and snd falls at the end of the last stop bit.
    """
    host = await SerialHost.start(dut, mod=mod)
    for line, answer in REPLIES.items():
        await host.raw(line)
        assert await host.hear() == answer
        rise = host.bench.rises("snd")[-1]
        assert 0 <= host.waited - (host.wait + Fraction(1, 2)) * host.bit <= 6
        assert host.bench.falls("txd", rise)[0] == rise + ceil(host.lead * host.bit)
        characters = len(bytes.fromhex(host.wire))
        assert host.bench.falls("snd", rise) == [rise + ceil((host.lead + 10 * characters) * host.bit)]


@directed("P312-SER-15", "P312-SER-18", builds=(F16, SLOW, SLOWEST))
async def p312_serial_frames_back_to_back_with_a_slow_line_driver(dut: Any) -> None:
    """A control code that ends before the fall of snd is an overrun; one that ends after it is executed.

    Frames for other stations have no effect (P312-SER-15, P312-SER-18).
    """
    host = await SerialHost.start(dut)
    for line in ("82 7D", "92 34 31 2C", "81 7E"):
        await host.raw(line)
    assert await host.hear() == "90"
    await host.raw("81 7E")
    await host.go(host.t + 1)
    await host.raw("81 7E")  # the reply to the previous frame is pending or being sent
    assert await host.hear(timed=False) == "90"
    assert await host.ask("4F") == "A0 00 01 00"


@directed("P312-SER-18", "P312-OVR-10", exact="the event must be sampled once in each cycle before the reply")
async def p312_serial_a_reply_that_is_ready_about_half_a_bit_after_the_frame(dut: Any) -> None:
    """snd rises after the end of the frame or of an instruction in progress, whichever is later.

    In each repetition, an event occurs one cycle later, but before the end of the frame, and is processed
    before the frame.
    """
    host = await SerialHost.start(dut, TS, "49 03 08 82 00 01 EE 00 00 00 28")
    waited = []
    for clk in range(14, 2, -1):
        await host.raw("91 32 35")
        await host.character(0x49)
        middle = ceil(host.middle)
        await host.bench.until(middle - clk)
        host.bench.set(evt0_n=0)
        assert await host.hear() == "A0 00"
        waited.append(host.waited)
        await host.pins(evt0_n=1)
        assert (await host.settle())[0] == "B0 29"
    still = [clk for clk in waited if clk == waited[0]]
    assert 1 < len(still) < 8 and 0 <= waited[0] - host.bit / 2 <= 6
    assert waited[len(still) :] == [waited[0] + clk for clk in range(1, len(waited) - len(still) + 1)]


@cocotb.parametrize(case=[(7, 0.02), (7, -0.02), (7, 0.03), (7, -0.03)])
@directed("P312-SER-01")
async def p312_serial_wrong_bit_time(dut: Any, case: Any) -> None:
    mod, error = case
    host = await SerialHost.start(dut, mod=mod, error=error)
    for word in (0x00000000, 0xFFFFFFFF, 0x5555AAAA):
        await echo(host, word)
    assert await host.polls(2) == ["90", "90"]
    assert await host.ask("4F") == "A0 00 00 00"


@cocotb.parametrize(case=[(5, 0.03), (5, -0.03), (6, 0.02), (6, -0.02)])
@directed("P312-SER-01")
async def p312_serial_wrong_bit_time_of_slow_lines(dut: Any, case: Any) -> None:
    mod, error = case
    host = await SerialHost.start(dut, mod=mod, error=error)
    assert await host.asks("43 0055FFAA", "4F") == ["90", "A0 00 00 00"]


@directed("P312-SER-01", "P312-SER-15")
async def p312_serial_far_too_slow_master(dut: Any) -> None:
    """With a bit time 12 % too long, no frame is executed, and a framing error is counted."""
    host = await SerialHost.start(dut, error=0.12)
    for _ in range(3):
        await host.send(summed(0x91, b"\x26\x3f"))
        await host.pause(4_000)
    assert host.out("auxo_n") == 0x3F
    host.error = Fraction(0)
    await host.pause(40_000)
    while host.rise() is not None:
        host.forget()
    await host.send(b"\x82")
    assert await host.poll() == "90"
    assert (await host.ask("4F")).split()[1] != "00"


@directed("P312-SER-01", "P312-BAD-16")
async def p312_serial_glitches_between_characters(dut: Any) -> None:
    """A low level that ends before the middle of a start bit is ignored."""
    host = await SerialHost.start(dut)
    for clk in (1, 2, 3, 40, 94):
        await host.pins(rxd=0)
        await host.pause(clk - 1)
        await host.pins(rxd=1)
        await host.pause(200)
        assert await host.poll() == "90"
    await host.character(0x81)
    await host.pins(rxd=0)
    await host.pause(60)
    await host.pins(rxd=1)
    await host.pause(100)
    await host.character(0x7E)
    assert await host.hear() == "90" and await host.ask("4F") == "A0 00 00 00"


@cocotb.parametrize(clk=[94, 95, 96, 97, 98])
@directed("P312-SER-01", "P312-SER-15")
async def p312_serial_where_the_start_bit_is_verified(dut: Any, clk: int) -> None:
    """A low level of at least half a bit (96 cycles) is received as the character FF."""
    host = await SerialHost.start(dut)
    await host.raw("91")
    start = host.t
    await host.pins(rxd=0)
    await host.pause(clk - 1)
    await host.pins(rxd=1)
    await host.pause(2_000)
    sampled = host.bench.pin_edges("rxd", 1, start)[0] - host.bench.pin_edges("rxd", 0, start)[0]
    await host.raw("34 31 2D")
    assert await host.quiet(8_000) if sampled >= 96 else await host.hear() == "A0 12"


@directed("P312-SER-01", "P312-BAD-16")
async def p312_serial_noise_away_from_the_middle(dut: Any) -> None:
    """Wrong levels of 30 cycles have no effect unless they are in the middle of a bit, where it is
    sampled.
    """
    host = await SerialHost.start(dut)
    for byte in b"\x91" + b"26" + b"15" + b"3":
        spikes = [(bit + place, 30) for bit in range(10) for place in (0.05, 0.7) if 0.5 < bit + place < 9.5]
        await host.character(byte, spikes=spikes)
    assert await host.hear() == "90" and host.out("auxo_n") == 0x2A
    assert await host.ask("4F") == "A0 00 00 00"


@directed("P312-SER-14", "P312-BAD-16")
async def p312_serial_noise_in_the_middle(dut: Any) -> None:
    """A frame with one wrong bit at any place is never executed."""
    host = await SerialHost.start(dut)
    frame = summed(0x91, b"\x26\x15")
    for place in range(1, len(frame)):
        # The checksum does not include the highest bit of a byte.
        for bit in (0, 2, 5):
            for number, byte in enumerate(frame):
                await host.character(byte, spikes=[(bit + 1.3, 80)] if number == place else ())
            if place > 2:
                assert await host.hear() == "B0 41"
            elif not await host.quiet(3_000):
                assert await host.hear(timed=False) == "B0 41"
            assert host.out("auxo_n") == 0x3F
            await host.send(b"\x82")
    assert await host.poll() == "90"


@directed("P312-SER-15", "P312-SER-45")
async def p312_serial_framing_errors(dut: Any) -> None:
    """A framing error ends any frame, also one for another station.

    The line must be idle before the next character is received.
    """
    host = await SerialHost.start(dut)
    for adr in (1, 2):
        await host.character(0x90 + adr, stop=1)
        await host.character(0x32, stop=0)
        await host.raw("32 35 49")
        assert await host.quiet(4_000)
    await host.character(0x81, stop=0)
    await host.raw("7E")
    assert await host.quiet(4_000)
    assert await host.poll() == "90"
    assert [await host.ask("4F"), await host.ask("4F")] == ["A0 03 00 00", "A0 00 00 00"]


@cocotb.parametrize(bits=[9.3, 9.7, 10, 10.5, 15, 40, 300])
@directed("P312-SER-15", "P312-BAD-16")
async def p312_serial_breaks(dut: Any, bits: float) -> None:
    """A break of any length causes one framing error. Exception: it causes none if it ends before the stop
    bit is sampled.
    """
    host = await SerialHost.start(dut)
    await host.raw("91 32")
    await host.low(bits)
    assert await host.poll() == "90"
    assert await host.ask("4F") == f"A0 {bits > 9.5:02X} 00 00"


@directed("P312-SER-15")
async def p312_serial_break_in_a_reset(dut: Any) -> None:
    host = await SerialHost.start(dut)
    await host.pins(rxd=0)
    await host.pins(rst_n=0)
    await host.pause(10)
    await host.pins(rst_n=1)
    await host.pause(8_000)
    await host.pins(rxd=1)
    await host.pause(400)
    assert await host.poll() == "90"
    assert await host.ask("4F") == "A0 01 00 00"


@directed("P312-SER-18", "P312-SER-01")
async def p312_serial_characters_without_a_gap_and_with_one(dut: Any) -> None:
    host = await SerialHost.start(dut)
    for gap in (0, 0.3, 1, 7.77, 100):
        await host.send(summed(0x91, b"\x43\xa5\x5a\x00\xff"), gap)
        # The reply follows while the line is idle.
        host.t -= ceil(Fraction(gap) * host.bit)
        assert await host.hear() == "90"
    assert await host.ask("42") == "A0 A5 5A 00 FF"


@cocotb.parametrize(byte=PATTERNS)
@directed("P312-SER-01")
async def p312_serial_all_kinds_of_characters(dut: Any, byte: int) -> None:
    host = await SerialHost.start(dut, f"63 {byte * 0x01010101:08X}")
    assert await host.ask("62") == " ".join(("A0", *[f"{byte:02X}"] * 4))
