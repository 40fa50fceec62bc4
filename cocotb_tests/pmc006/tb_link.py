"""Valid and invalid bytes and frames on the link; times of replies, and frames without a reply."""

from __future__ import annotations

from fractions import Fraction
from math import ceil
from typing import Any

import cocotb

from .builds import F8B, ODD, directed
from .frames import checked, command, reply
from .host import Host
from .moves import DECAY, constant_speed_host

BUILDS = (F8B, ODD)

PATTERNS = (0x00000000, 0xFFFFFFFF, 0x55AA33CC, 0x80000001, 0x7F7FFEFE)
J = command(0xFF, "j")


async def echo(host: Host, *values: int) -> None:
    """Set the position, which accepts any 32 bits, and read it back."""
    for value in values or PATTERNS:
        assert await host.ask("i", value) == value and await host.ask("c") == value


@directed(
    "P006-UART-01", "P006-UART-02", "P006-UART-05", "P006-FRM-03", "P006-CMD-30", "P006-CMD-24", builds=BUILDS
)
async def p006_all_levels_of_all_bits(dut: Any) -> None:
    host = await Host.start(dut)
    await echo(host)
    for bit in range(0, 32, 5):
        await echo(host, 1 << bit)


@cocotb.parametrize(error=[0.025, -0.025, 0.012, -0.012])
@directed("P006-UART-04", builds=BUILDS)
async def p006_wrong_bit_rate(dut: Any, error: float) -> None:
    """Frames without gaps are received if the bit rate is 2.5 % too high or too low.

    At the last sample of a frame, the errors of its bits have added up.
    """
    await echo(await Host.start(dut, error=error), *PATTERNS[:3])


@directed("P006-UART-04", "P006-FRM-04", builds=BUILDS)
async def p006_gaps_between_bytes(dut: Any) -> None:
    host = await Host.start(dut)
    for gap in (0, 0.3, 1, 7.77, 100):
        await host.send(command(0xFF, "i", 0x12345678), gap)
        await host.pause(ceil(gap * host.bit))
        assert await host.receive_reply() == 0x12345678


@directed("P006-UART-02", "P006-BAD-05", builds=BUILDS)
async def p006_spikes_on_an_idle_line(dut: Any) -> None:
    """Low levels shorter than half a bit on an idle line have no effect."""
    host = await Host.start(dut)
    half = host.bit / 2
    for clk in (1, 2, 3, int(half) - 2):
        await host.pins(rxd=0)
        await host.pause(clk - 1)
        await host.pins(rxd=1)
        await host.pause(ceil(host.bit))
        assert await host.ask("j") == DECAY
    await host.send(J[:3])
    await host.pins(rxd=0)
    await host.pause(int(half) - 3)
    await host.pins(rxd=1)
    await host.pause(ceil(host.bit))
    await host.send(J[3:])
    assert await host.receive_reply() == DECAY


@directed("P006-UART-02", "P006-BAD-05", builds=BUILDS)
async def p006_noise_away_from_the_samples(dut: Any) -> None:
    """A wrong level for a fifth of a bit has no effect unless it is at the sampling time."""
    host = await Host.start(dut)
    clk = int(host.bit / 5)
    for byte in command(0xFF, "i", 0x0FF0A55A):
        spikes = [(bit + place, clk) for bit in range(10) for place in (0.1, 0.7) if 0.5 < bit + place < 9.4]
        await host.character(byte, spikes=spikes)
    assert await host.receive_reply() == 0x0FF0A55A


@cocotb.parametrize(place=range(8))
@directed("P006-UART-03", "P006-BAD-05", builds=BUILDS)
async def p006_framing_error_in_each_byte(dut: Any, place: int) -> None:
    """A framing error in any byte discards the frame, whose remaining bytes do not begin another frame."""
    host = await Host.start(dut)
    for number, byte in enumerate(command(0xFF, "i", 0xA5A5)):
        await host.character(byte, stop=int(number != place))
    assert await host.is_silent(ceil(90 * host.bit))
    await host.pause(ceil(200 * host.bit))
    assert await host.ask("c") == 0


@cocotb.parametrize(bits=[9.3, 9.7, 12, 60, 2000])
@directed("P006-UART-03", "P006-BAD-05", builds=BUILDS)
async def p006_breaks(dut: Any, bits: float) -> None:
    """A break of any length discards at most the frame that it disturbs. The next frame needs no pause before
    it.
    """
    host = await Host.start(dut)
    await host.send(J[:4])
    await host.low(bits)
    if bits < 9.5:
        # The low level is shorter than a break, so it is received as a valid byte 00, which is the value of
        # the fifth byte of the frame. The remaining bytes of the frame follow.
        await host.send(J[5:])
        assert await host.receive_reply() == DECAY
    assert await host.ask("j") == DECAY


@directed("P006-UART-03", "P006-BAD-24", builds=BUILDS)
async def p006_line_low_during_reset(dut: Any) -> None:
    """After a reset, no byte begins before the line has been high."""
    host = await Host.start(dut, levels={"sda_i": 0, "rxd": 0}, boot=False)
    await host.boot()
    await host.pause(ceil(30 * host.bit))
    await host.pins(rxd=1)
    await host.pause(ceil(2 * host.bit))
    assert await host.ask("j") == DECAY


@directed("P006-FRM-01", "P006-BAD-01", "P006-FRM-08", builds=BUILDS)
async def p006_bytes_before_a_frame(dut: Any) -> None:
    host = await Host.start(dut)
    await host.send(bytes(byte for byte in range(0, 256, 7) if byte != 0xA5))
    assert await host.ask("j") == DECAY
    await host.send(b"\x5a\x00\xff")
    assert await host.ask("i", 0xA5A5A5A5) == 0xA5A5A5A5
    await host.send(command(0xA5, "j"))
    assert await host.ask("c") == 0xA5A5A5A5


@directed("P006-FRM-02", "P006-FRM-08", "P006-BAD-02", builds=BUILDS)
async def p006_every_wrong_bit_of_a_frame(dut: Any) -> None:
    """A frame with one wrong bit is never executed; exactly its eight bytes are discarded."""
    host = await Host.start(dut)
    good = command(0xFF, "y", 0xF8)
    for place in range(1, 8):
        for bit in (0, 3, 7):
            frame = bytearray(good)
            frame[place] ^= 1 << bit
            await host.send(frame)
    assert await host.is_silent(ceil(10 * host.bit)) and not host.edges("de")
    assert not await host.out("gpo") and await host.ask("y", 0xF8) == 0xF8


@directed("P006-FRM-02", "P006-FRM-05", "P006-BAD-03", "P006-CMD-44", builds=BUILDS)
async def p006_own_address_only(dut: Any) -> None:
    host = await Host.start(dut)
    for address in (0, 1, 0x78, 0x79, 0x7A, 0xA5, 0xFE):
        await host.send_frame("y", 0xF8, address)
    assert await host.ask("w", 0x78) == 0x78
    for address in (0, 0x77, 0x79, 0xFF):
        await host.send_frame("y", 0xF8, address)
    assert await host.is_silent(ceil(10 * host.bit)) and not await host.out("gpo")
    assert await host.ask("j") == DECAY


@directed("P006-FRM-06", "P006-FRM-10", "P006-BAD-03", builds=BUILDS)
async def p006_traffic_of_other_nodes(dut: Any) -> None:
    """Commands to other nodes, and replies of other nodes, have no effect with any data. A frame may follow
    without a pause.
    """
    host = await Host.start(dut)
    assert await host.ask("w", 5) == 5
    for data in (0, 0xA505A505, 0x050505A5):
        await host.send(command(7, "s", data) + reply(7, data) + reply(5, data) + command(0x7A, "j", data))
        assert await host.ask("j") == DECAY
    assert not host.steps(0)


@directed("P006-UART-02", "P006-UART-05", "P006-FRM-04", builds=BUILDS)
async def p006_start_bits_about_the_middle_of_a_stop_bit(dut: Any) -> None:
    """A stop bit may end just after its middle; the next character is sampled relative to its own start
    edge.
    """
    host = await Host.start(dut)
    data, heard = 0x55AA33CC, []
    *first, last = command(0xFF, "i", data)
    for late in range(-3, 5):
        for byte in first:
            begin = host.t
            await host.character(byte)
            host.back_to(begin + ceil(Fraction(19, 2) * host.bit) + late)
        await host.character(last)
        await host.pause(ceil(300 * host.bit))
        await host.ignore_replies()
        heard.append(await host.ask("c") == data)
        assert await host.ask("i", 0) == 0
    assert heard == sorted(heard) and set(heard) == {False, True}


@directed("P006-FRM-04", "P006-BAD-04", builds=BUILDS)
async def p006_silence_within_a_frame(dut: Any) -> None:
    """A silence of less than 192 bit times within a frame has no effect; a longer silence ends the frame.

    The silence is counted from the sample of the stop bit to the next start bit.
    """
    host = await Host.start(dut)
    for after, answered in ((-12, True), (-5, True), (6, False), (40, False)):
        # The silence is counted from the middle of the stop bit, after which half a bit remains.
        gap = ceil(192 * host.bit) - int(host.bit / 2) + after
        await host.send(command(0xFF, "i", 0x77)[:4])
        await host.pause(gap)
        await host.send(command(0xFF, "i", 0x77)[4:])
        if answered:
            assert await host.receive_reply() == 0x77
        else:
            assert await host.is_silent(ceil(20 * host.bit))
            await host.pause(ceil(200 * host.bit))
    assert await host.ask("j") == DECAY


@directed("P006-FRM-04", builds=BUILDS)
async def p006_the_very_end_of_the_silence(dut: Any) -> None:
    """If a byte arrives within a few cycles of the end of the silence, model and RTL agree; both results are
    legal.
    """
    host = await Host.start(dut)
    for after in range(-4, 5):
        await host.send(J[:4])
        await host.pause(ceil(192 * host.bit) - int(host.bit / 2) + after)
        await host.send(J[4:])
        await host.pause(ceil(6 * host.bit))
        await host.ignore_replies()
        await host.pause(ceil(200 * host.bit))
    assert await host.ask("j") == DECAY


@cocotb.parametrize(count=range(1, 8))
@directed("P006-FRM-04", "P006-BAD-04", builds=BUILDS)
async def p006_frames_cut_short(dut: Any, count: int) -> None:
    host = await Host.start(dut)
    await host.send(J[:count])
    await host.pause(ceil(195 * host.bit))
    assert await host.ask("j") == DECAY


@directed("P006-FRM-07", "P006-BAD-06", builds=BUILDS)
async def p006_talking_while_the_reply_is_sent(dut: Any) -> None:
    """A frame sent during a reply is ignored completely, also its bytes after the reply."""
    for start in (0, 0.4, 1.2, 5, 40):
        host = await Host.start(dut)
        await host.send_frame("c")
        host.back_to(host.e + ceil(start * host.bit))
        await host.send(command(0xFF, "y", 0xF8))
        host.middle -= 80 * host.bit + ceil(start * host.bit) - 0.5 * host.bit
        await host.ignore_replies()
        assert await host.is_silent(ceil(12 * host.bit)) and not await host.out("gpo")
        await host.pause(ceil(200 * host.bit))
        assert await host.ask("j") == DECAY
        assert len(host.edges("de")) == 4


@directed("P006-FRM-07", "P006-UART-02", "P006-BAD-06", builds=BUILDS)
async def p006_line_that_is_low_when_the_reply_ends(dut: Any) -> None:
    """If the line is low at the end of a reply, no byte begins before the line has been high. A frame shortly
    after the line has become high is received.
    """
    for gap in (2, 4, 8):
        host = await Host.start(dut)
        await host.send_frame("c")
        await host.go(host.e + ceil(81 * host.bit))
        await host.pins(rxd=0)
        await host.pause(ceil(3.5 * host.bit))
        await host.pins(rxd=1)
        await host.ignore_replies()
        host.back_to(host.t + ceil(gap * host.bit))
        assert await host.ask("j") == DECAY


@directed("P006-FRM-07", "P006-BAD-06", builds=BUILDS)
async def p006_frame_in_the_last_half_of_the_stop_bit(dut: Any) -> None:
    """A frame that begins in the middle of the last stop bit of a reply, or later, is received."""
    for late in (-1, 0, 1, 9, 25, 33):
        host = await Host.start(dut)
        if late < 0:
            late -= host.bench.slack
        await host.send_frame("c")
        await host.pause(ceil(3 * host.bit))
        rise = await host.next_de_rise()
        assert rise is not None
        middle = rise - ceil(host.bit) + ceil(Fraction(163, 2) * host.bit)
        await host.go(middle + late)
        assert await host.out("de")
        await host.send_frame("y", 0xF8)
        await host.pause(ceil(90 * host.bit))
        heard = late >= 0
        assert await host.out("gpo") == (0x1F if heard else 0), f"{late} cycles after the middle"
        assert len(host.edges("de", rise)) == (4 if heard else 2)


@directed("P006-FRM-07", "P006-UART-05", builds=BUILDS)
async def p006_line_that_echoes(dut: Any) -> None:
    """A node that receives the echo of its own reply answers the next frame."""
    host = await Host.start(dut)
    await host.send_frame("c")
    start = host.e + ceil(2 * host.bit)
    host.back_to(start + 1)
    await host.send(reply(0xFF, 0))
    await host.ignore_replies()
    assert await host.ask("j") == DECAY


@directed("P006-FRM-03", "P006-CMD-52", "P006-CMD-53", builds=BUILDS)
async def p006_reply_shows_the_moment_of_execution(dut: Any) -> None:
    """The reply returns the position at the time of execution; steps continue while it is sent."""
    host = await constant_speed_host(dut)
    await host.ask("s", 200)
    await host.wait_us(3_000)
    value = await host.ask("c")
    made = len([t for t in host.steps(0) if t <= host.e + 1])
    assert abs(value - made) <= 1 and len(host.steps(0)) > made
    await host.ask("I")


@directed("P006-FRM-09", "P006-CMD-40", builds=BUILDS)
async def p006_worked_frames(dut: Any) -> None:
    """The six frames of the old manual have the replies that the manual states (P006-FRM-09)."""
    host = await Host.start(dut)
    assert await host.ask("w", 1) == 1
    await host.ok(v=3000, L=3000, S=3000)
    assert await host.exchange("A5 01 73 1F 01 00 00 39") == reply(1, host.accepted(287)).hex(" ").upper()
    await host.ask("I")
    assert await host.ask("w", 2) == 2
    assert await host.exchange("A5 02 6D 04 00 00 00 18") == "A5 7A 02 04 00 00 00 25"
    assert await host.exchange("A5 02 79 08 00 00 00 28") == "A5 7A 02 08 00 00 00 29"


@directed("P006-UART-03", "P006-FRM-02", "P006-BAD-24", builds=BUILDS)
async def p006_reset_in_the_middle_of_a_reply(dut: Any) -> None:
    """A reset during a reply sets the outputs to their reset levels immediately; the next frame is
    answered.
    """
    for bits in (0.5, 1.5, 2.5, 30):
        host = await Host.start(dut)
        await host.send_frame("j")
        await host.pause(ceil(bits * host.bit))
        await host.reset()
        assert await host.out("txd") == 1 and await host.out("de") == 0
        await host.boot()
        assert await host.is_silent(ceil(5 * host.bit))
        assert await host.ask("j") == DECAY


@directed("P006-FRM-01", "P006-FRM-08", "P006-BAD-02", builds=BUILDS)
async def p006_frames_with_a_wrong_head(dut: Any) -> None:
    host = await Host.start(dut)
    await host.send(bytes([0xA4]) + J[1:])
    await host.send(checked(0xA5, 0xFF, 0x6A, 0, 0, 0, 1)[:-1] + b"\x00")
    assert await host.ask("j") == DECAY
