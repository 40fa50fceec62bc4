"""Scripts: bytes and frames on the link, good and bad; when replies come, and when none does."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import pytest

from cocotb_tests.harness.verifies import verifies

from .frames import checked, command, reply
from .scenes import DECAY, device, image, quick
from .script_host import Host

PATTERNS = (0x00000000, 0xFFFFFFFF, 0x55AA33CC, 0x80000001, 0x7F7FFEFE)
J = command(0xFF, "j")


def echo(host: Host, *values: int) -> None:
    """Set the position, which takes any 32 bits, and read it back."""
    for value in values or PATTERNS:
        assert host.ask("i", value) == value and host.ask("c") == value


@verifies("P006-UART-01", "P006-UART-02", "P006-UART-05", "P006-FRM-03", "P006-CMD-30", "P006-CMD-24")
def test_all_levels_of_all_bits() -> None:
    host = Host()
    echo(host)
    for bit in range(0, 32, 5):
        echo(host, 1 << bit)


@pytest.mark.parametrize("error", [0.025, -0.025, 0.012, -0.012])
@verifies("P006-UART-04")
def test_wrong_bit_rate(error: float) -> None:
    """2.5 % either way, without gaps; the last sample of a frame shows the sum of it all."""
    echo(Host(error=error), *PATTERNS[:3])


@verifies("P006-UART-04", "P006-FRM-04")
def test_gaps_between_bytes() -> None:
    host = Host()
    for gap in (0, 0.3, 1, 7.77, 100):
        host.send(command(0xFF, "i", 0x12345678), gap)
        host.t -= ceil(gap * host.bit)
        assert host.hear() == 0x12345678


@verifies("P006-UART-02", "P006-BAD-05")
def test_spikes_on_an_idle_line() -> None:
    """Shorter than half a bit: nothing has been."""
    host = Host()
    half = host.bit / 2
    for clk in (1, 2, 3, int(half) - 2):
        host.pins(rxd=0)
        host.pause(clk - 1)
        host.pins(rxd=1)
        host.pause(ceil(host.bit))
        assert host.ask("j") == DECAY
    host.send(J[:3])
    host.pins(rxd=0)
    host.pause(int(half) - 3)
    host.pins(rxd=1)
    host.pause(ceil(host.bit))
    host.send(J[3:])
    assert host.hear() == DECAY


@verifies("P006-UART-02", "P006-BAD-05")
def test_noise_away_from_the_samples() -> None:
    """Levels are wrong for a fifth of a bit, but not where they are looked at."""
    host = Host()
    clk = int(host.bit / 5)
    for byte in command(0xFF, "i", 0x0FF0A55A):
        spikes = [(bit + place, clk) for bit in range(10) for place in (0.1, 0.7) if 0.5 < bit + place < 9.4]
        host.character(byte, spikes=spikes)
    assert host.hear() == 0x0FF0A55A


@pytest.mark.parametrize("place", range(8))
@verifies("P006-UART-03", "P006-BAD-05")
def test_framing_error_in_each_byte(place: int) -> None:
    """The frame is gone; the rest of it begins nothing."""
    host = Host()
    for number, byte in enumerate(command(0xFF, "i", 0xA5A5)):
        host.character(byte, stop=int(number != place))
    assert host.silent(ceil(90 * host.bit))
    host.pause(ceil(200 * host.bit))
    assert host.ask("c") == 0


@pytest.mark.parametrize("bits", [9.3, 9.7, 12, 60, 2000])
@verifies("P006-UART-03", "P006-BAD-05")
def test_breaks(bits: float) -> None:
    """However long it is, no more than the frame it is in is lost; the next one needs no pause."""
    host = Host()
    host.send(J[:4])
    host.low(bits)
    if bits < 9.5:
        # A good byte of zeros: the frame goes on.
        host.send(J[5:])
        assert host.hear() == DECAY
    assert host.ask("j") == DECAY


@verifies("P006-UART-03", "P006-BAD-24")
def test_line_low_during_reset() -> None:
    """No byte begins before the line has been high."""
    host = Host(levels={"sda_i": 0, "rxd": 0}, boot=False)
    host.boot()
    host.pause(ceil(30 * host.bit))
    host.pins(rxd=1)
    host.pause(ceil(2 * host.bit))
    assert host.ask("j") == DECAY


@verifies("P006-FRM-01", "P006-BAD-01", "P006-FRM-08")
def test_bytes_before_a_frame() -> None:
    host = Host()
    host.send(bytes(byte for byte in range(0, 256, 7) if byte != 0xA5))
    assert host.ask("j") == DECAY
    host.send(b"\x5a\x00\xff")
    assert host.ask("i", 0xA5A5A5A5) == 0xA5A5A5A5
    host.send(command(0xA5, "j"))
    assert host.ask("c") == 0xA5A5A5A5


@verifies("P006-FRM-02", "P006-FRM-08", "P006-BAD-02")
def test_every_wrong_bit_of_a_frame() -> None:
    """One wrong bit is never executed; all eight bytes are gone, and no others."""
    host = Host()
    good = command(0xFF, "y", 0xF8)
    for place in range(1, 8):
        for bit in (0, 3, 7):
            frame = bytearray(good)
            frame[place] ^= 1 << bit
            host.send(frame)
    assert host.silent(ceil(10 * host.bit)) and not host.edges("de")
    assert not host.out("gpo") and host.ask("y", 0xF8) == 0xF8


@verifies("P006-FRM-02", "P006-FRM-05", "P006-BAD-03", "P006-CMD-44")
def test_own_address_only() -> None:
    host = Host()
    for address in (0, 1, 0x78, 0x79, 0x7A, 0xA5, 0xFE):
        host.say("y", 0xF8, address)
    assert host.ask("w", 0x78) == 0x78
    for address in (0, 0x77, 0x79, 0xFF):
        host.say("y", 0xF8, address)
    assert host.silent(ceil(10 * host.bit)) and not host.out("gpo")
    assert host.ask("j") == DECAY


@verifies("P006-FRM-06", "P006-FRM-10", "P006-BAD-03")
def test_traffic_of_other_nodes() -> None:
    """Commands to others, their replies, whatever they hold; then at once a frame to this one."""
    host = Host()
    assert host.ask("w", 5) == 5
    for data in (0, 0xA505A505, 0x050505A5):
        host.send(command(7, "s", data) + reply(7, data) + reply(5, data) + command(0x7A, "j", data))
        assert host.ask("j") == DECAY
    assert not host.steps(0)


@verifies("P006-FRM-04", "P006-BAD-04")
def test_silence_within_a_frame() -> None:
    """Less than 192 bit times between the stop-bit sample and the next start bit are nothing; more end it."""
    host = Host()
    for after, answered in ((-12, True), (-5, True), (6, False), (40, False)):
        # From the middle of the stop bit, where the line has half a bit to go.
        gap = ceil(192 * host.bit) - int(host.bit / 2) + after
        host.send(command(0xFF, "i", 0x77)[:4])
        host.pause(gap)
        host.send(command(0xFF, "i", 0x77)[4:])
        if answered:
            assert host.hear() == 0x77
        else:
            assert host.silent(ceil(20 * host.bit))
            host.pause(ceil(200 * host.bit))
    assert host.ask("j") == DECAY


@verifies("P006-FRM-04")
def test_the_very_end_of_the_silence() -> None:
    """Around the last clk either may be; model and RTL agree about it."""
    host = Host()
    for after in range(-4, 5):
        host.send(J[:4])
        host.pause(ceil(192 * host.bit) - int(host.bit / 2) + after)
        host.send(J[4:])
        host.pause(ceil(6 * host.bit))
        host.forget()
        host.pause(ceil(200 * host.bit))
    assert host.ask("j") == DECAY


@verifies("P006-FRM-04", "P006-BAD-04")
@pytest.mark.parametrize("count", range(1, 8))
def test_frames_cut_short(count: int) -> None:
    host = Host()
    host.send(J[:count])
    host.pause(ceil(195 * host.bit))
    assert host.ask("j") == DECAY


@verifies("P006-FRM-07", "P006-BAD-06")
def test_talking_while_the_reply_is_sent() -> None:
    """Nothing of it is heard, not even the rest of a frame that ends after the reply."""
    for start in (0, 0.4, 1.2, 5, 40):
        host = Host()
        host.say("c")
        host.back_to(host.e + ceil(start * host.bit))
        host.send(command(0xFF, "y", 0xF8))
        host.middle -= 80 * host.bit + ceil(start * host.bit) - 0.5 * host.bit
        host.forget()
        assert host.silent(ceil(12 * host.bit)) and not host.out("gpo")
        host.pause(ceil(200 * host.bit))
        assert host.ask("j") == DECAY
        assert len(host.edges("de")) == 4


@verifies("P006-FRM-07", "P006-UART-02", "P006-BAD-06")
def test_line_that_is_low_when_the_reply_ends() -> None:
    """No byte begins before the line has been high; what follows soon afterwards is heard."""
    for gap in (2, 4, 8):
        host = Host()
        host.say("c")
        host.go(host.e + ceil(81 * host.bit))
        host.pins(rxd=0)
        host.pause(ceil(3.5 * host.bit))
        host.pins(rxd=1)
        host.forget()
        host.back_to(host.t + ceil(gap * host.bit))
        assert host.ask("j") == DECAY


@verifies("P006-FRM-07", "P006-BAD-06")
def test_frame_in_the_last_half_of_the_stop_bit() -> None:
    """A host has a reply in the middle of its last stop bit; a frame that begins there or later is heard."""
    for late in (-1, 0, 1, 9, 25, 33):
        host = Host()
        host.say("c")
        host.pause(ceil(3 * host.bit))
        rise = host.rise()
        assert rise is not None
        middle = rise - ceil(host.bit) + ceil(Fraction(163, 2) * host.bit)
        host.go(middle + late)
        assert host.out("de")
        host.say("y", 0xF8)
        host.pause(ceil(90 * host.bit))
        heard = late >= 0
        assert host.out("gpo") == (0x1F if heard else 0), f"{late} clk after the middle"
        assert len(host.edges("de", rise)) == (4 if heard else 2)


@verifies("P006-FRM-07", "P006-EEP-01", "P006-BAD-06")
def test_frames_before_the_end_of_the_boot() -> None:
    """Deaf until then, with an EEPROM or without one: such a frame is lost, and so is one that ends later."""
    for chip, longest in ((device(image(), write_us=500), 60_000), (device(missing=True), 15_000)):
        up = Host(eeprom=chip).t
        chip = device(image(), missing=chip.missing)
        host = Host(eeprom=chip, boot=False)
        for begin in (host.us(500), up // 2, up - ceil(40 * host.bit)):
            host.go(begin)
            host.say("y", 0xF8)
        assert host.t > host.boot() and up <= host.us(longest)
        assert host.silent(ceil(30 * host.bit)) and not host.out("gpo") and not host.edges("de")
        host.pause(ceil(200 * host.bit))
        assert host.ask("y", 0x08) == 0x08 and host.ask("j") == DECAY


@verifies("P006-FRM-07", "P006-UART-05")
def test_line_that_echoes() -> None:
    """A transceiver that lets the node hear itself: the assembler is empty afterwards."""
    host = Host()
    host.say("c")
    start = host.e + ceil(2 * host.bit)
    host.back_to(start + 1)
    host.send(reply(0xFF, 0))
    host.forget()
    assert host.ask("j") == DECAY


@verifies("P006-FRM-03", "P006-CMD-52", "P006-CMD-53")
def test_reply_shows_the_moment_of_execution() -> None:
    """Steps go on while a position is being sent."""
    host = quick()
    host.ask("s", 200)
    host.wait_us(3_000)
    value = host.ask("c")
    made = len([t for t in host.steps(0) if t <= host.e + 1])
    assert abs(value - made) <= 1 and len(host.steps(0)) > made
    host.ask("I")


@verifies("P006-FRM-09", "P006-CMD-40")
def test_worked_frames() -> None:
    """F1..F6 of chapter 2.5."""
    host = Host()
    assert host.ask("w", 1) == 1
    host.ok(v=3000, L=3000, S=3000)
    assert host.swap("A5 01 73 1F 01 00 00 39") == reply(1, host.accepted(287)).hex(" ").upper()
    host.ask("I")
    assert host.ask("w", 2) == 2
    assert host.swap("A5 02 6D 04 00 00 00 18") == "A5 7A 02 04 00 00 00 25"
    assert host.swap("A5 02 79 08 00 00 00 28") == "A5 7A 02 08 00 00 00 29"


@verifies("P006-UART-03", "P006-FRM-02", "P006-BAD-24")
def test_reset_in_the_middle_of_a_reply() -> None:
    """Outputs are at their reset levels at once; afterwards a frame is answered."""
    for bits in (0.5, 1.5, 2.5, 30):
        host = Host()
        host.say("j")
        host.pause(ceil(bits * host.bit))
        host.reset()
        assert host.out("txd") == 1 and host.out("de") == 0
        host.boot()
        assert host.silent(ceil(5 * host.bit))
        assert host.ask("j") == DECAY


@verifies("P006-FRM-01", "P006-FRM-08", "P006-BAD-02")
def test_frames_with_a_wrong_head() -> None:
    host = Host()
    host.send(bytes([0xA4]) + J[1:])
    host.send(checked(0xA5, 0xFF, 0x6A, 0, 0, 0, 1)[:-1] + b"\x00")
    assert host.ask("j") == DECAY
