"""Scripts: the line of the serial mode: speeds, wrong bit times, noise, breaks, framing errors."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import pytest

from cocotb_tests.harness.verifies import verifies

from .serial_frames import TS, summed
from .serial_host import SerialHost

PATTERNS = (0x00, 0x55, 0xAA, 0x7F, 0x80, 0xFF, 0x01, 0xFE)


def echo(host: SerialHost, word: int) -> None:
    """Write a position and read it back: all bits of eight characters in both directions."""
    assert host.ask(f"43 {word:08X}") == "90"
    assert host.ask("42") == " ".join(
        ("A0", f"{word:08X}"[:2], *(f"{word:08X}"[k : k + 2] for k in (2, 4, 6)))
    )


@pytest.mark.parametrize("mod", [5, 6, 7])
@verifies("P312-SER-01", "P312-SER-18")
def test_speeds(mod: int) -> None:
    host = SerialHost(mod=mod)
    echo(host, 0x5AC30FF1)
    assert host.poll() == "90"


@pytest.mark.parametrize("mod", [5, 6, 7])
@pytest.mark.parametrize("clk", [{"clk_hz": 27_000_000}, {"clk_hz": 27_000_000, "xtal_hz": 12_000_000}])
@verifies("P312-SER-01", "P312-SER-18", "P312-GEN-02")
def test_bit_times_that_are_no_whole_clk(mod: int, clk: dict[str, int]) -> None:
    host = SerialHost(mod=mod, **clk)
    echo(host, 0x5AC30FF1)


REPLIES = {"81 7E": "90", "91 34 31 2D": "A0 12", "91 32 30 4E": "90"}
REPLIES |= {"91 32 30 4F": "B0 41", "91 34 65 20": "A0 00"}
"""Frames by who answers them: the poll, the core with and without data, the station for both of its own."""


@pytest.mark.parametrize("mod", [5, 6, 7])
@pytest.mark.parametrize("clk", [{}, {"clk_hz": 27_000_000, "xtal_hz": 12_000_000}])
@verifies("P312-SER-18")
def test_a_reply_leaves_one_pair_of_wires_to_its_master(mod: int, clk: dict[str, int]) -> None:
    """snd rises half a bit after the end of the master's stop bit, and not more than a few clk later."""
    host = SerialHost(mod=mod, **clk)
    for line, answer in REPLIES.items():
        host.raw(line)
        assert host.hear() == answer
        assert 0 <= host.waited - host.bit / 2 <= 6


@verifies("P312-SER-18", "P312-OVR-10")
def test_a_reply_that_is_ready_about_half_a_bit_after_the_frame() -> None:
    """An event is processed before the frame, a clk later each time: snd waits for whatever is over last."""
    host = SerialHost(TS, "49 03 08 82 00 01 EE 00 00 00 28")
    waited = []
    for clk in range(14, 2, -1):
        host.raw("91 32 35")
        host.character(0x49)
        middle = ceil(host.middle)
        host.model.pins(middle - clk, evt0_n=0)
        assert host.hear() == "A0 00"
        waited.append(host.waited)
        host.pins(evt0_n=1)
        assert host.settle()[0] == "B0 29"
    still = [clk for clk in waited if clk == waited[0]]
    assert 1 < len(still) < 8 and 0 <= waited[0] - host.bit / 2 <= 6
    assert waited[len(still) :] == [waited[0] + clk for clk in range(1, len(waited) - len(still) + 1)]


@pytest.mark.parametrize(("mod", "error"), [(7, 0.02), (7, -0.02), (7, 0.03), (7, -0.03)])
@verifies("P312-SER-01")
def test_wrong_bit_time(mod: int, error: float) -> None:
    host = SerialHost(mod=mod, error=error)
    for word in (0x00000000, 0xFFFFFFFF, 0x5555AAAA):
        echo(host, word)
    assert [host.poll() for _ in range(2)] == ["90", "90"]
    assert host.ask("4F") == "A0 00 00 00"


@pytest.mark.parametrize(("mod", "error"), [(5, 0.03), (5, -0.03), (6, 0.02), (6, -0.02)])
@verifies("P312-SER-01")
def test_wrong_bit_time_of_slow_lines(mod: int, error: float) -> None:
    host = SerialHost(mod=mod, error=error)
    assert host.ask("43 0055FFAA") == "90" and host.ask("4F") == "A0 00 00 00"


@verifies("P312-SER-01", "P312-SER-15")
def test_far_too_slow_master() -> None:
    """At 12 % the last data bit is taken for the stop bit: no answer, or a framing error, but no harm."""
    host = SerialHost(error=0.12)
    for _ in range(3):
        host.send(summed(0x91, b"\x26\x3f"))
        host.pause(4_000)
    assert host.out("auxo_n") == 0x3F
    host.error = Fraction(0)
    host.t += 40_000
    while host.rise() is not None:
        host.forget()
    host.send(b"\x82")
    assert host.poll() == "90"
    assert host.ask("4F").split()[1] != "00"


@verifies("P312-SER-01", "P312-BAD-16")
def test_glitches_between_characters() -> None:
    """A low level that is over in the middle of a start bit is none."""
    host = SerialHost()
    for clk in (1, 2, 3, 40, 94):
        host.pins(rxd=0)
        host.pause(clk - 1)
        host.pins(rxd=1)
        host.pause(200)
        assert host.poll() == "90"
    host.character(0x81)
    host.pins(rxd=0)
    host.pause(60)
    host.pins(rxd=1)
    host.pause(100)
    host.character(0x7E)
    assert host.hear() == "90" and host.ask("4F") == "A0 00 00 00"


@pytest.mark.parametrize("clk", [94, 95, 96, 97, 98])
@verifies("P312-SER-01", "P312-SER-15")
def test_where_the_start_bit_is_verified(clk: int) -> None:
    """Half a bit are 96 clk; a longer one is a character FF, which nobody has asked for."""
    host = SerialHost()
    host.raw("91")
    host.pins(rxd=0)
    host.pause(clk - 1)
    host.pins(rxd=1)
    host.pause(2_000)
    host.raw("34 31 2D")
    assert host.quiet(8_000) if clk >= 96 else host.hear() == "A0 12"


@verifies("P312-SER-01", "P312-BAD-16")
def test_noise_away_from_the_middle() -> None:
    """Levels are wrong for 30 clk, but not where they are looked at."""
    host = SerialHost()
    for byte in b"\x91" + b"26" + b"15" + b"3":
        spikes = [(bit + place, 30) for bit in range(10) for place in (0.05, 0.7) if 0.5 < bit + place < 9.5]
        host.character(byte, spikes=spikes)
    assert host.hear() == "90" and host.out("auxo_n") == 0x2A
    assert host.ask("4F") == "A0 00 00 00"


@verifies("P312-SER-14", "P312-BAD-16")
def test_noise_in_the_middle() -> None:
    """One wrong bit anywhere in a frame is never executed."""
    host = SerialHost()
    frame = summed(0x91, b"\x26\x15")
    for place in range(1, len(frame)):
        # The sum does not hold the highest bit of a byte.
        for bit in (0, 2, 5):
            for number, byte in enumerate(frame):
                host.character(byte, spikes=[(bit + 1.3, 80)] if number == place else ())
            if place > 2:
                assert host.hear() == "B0 41"
            elif not host.quiet(3_000):
                assert host.hear(timed=False) == "B0 41"
            assert host.out("auxo_n") == 0x3F
            host.send(b"\x82")
    assert host.poll() == "90"


@verifies("P312-SER-15", "P312-SER-45")
def test_framing_errors() -> None:
    """The frame is abandoned, whose ever it is; the line has to rest before the next character counts."""
    host = SerialHost()
    for adr in (1, 2):
        host.character(0x90 + adr, stop=1)
        host.character(0x32, stop=0)
        host.raw("32 35 49")
        assert host.quiet(4_000)
    host.character(0x81, stop=0)
    host.raw("7E")
    assert host.quiet(4_000)
    assert host.poll() == "90"
    assert [host.ask("4F"), host.ask("4F")] == ["A0 03 00 00", "A0 00 00 00"]


@pytest.mark.parametrize("bits", [9.3, 9.7, 10, 10.5, 15, 40, 300])
@verifies("P312-SER-15", "P312-BAD-16")
def test_breaks(bits: float) -> None:
    """However long it is: one framing error; none if it ends before the stop bit is looked at."""
    host = SerialHost()
    host.raw("91 32")
    host.low(bits)
    assert host.poll() == "90"
    assert host.ask("4F") == f"A0 {bits > 9.5:02X} 00 00"


@verifies("P312-SER-15")
def test_break_in_a_reset() -> None:
    host = SerialHost()
    host.pins(rxd=0)
    host.pins(rst_n=0)
    host.pause(10)
    host.pins(rst_n=1)
    host.pause(8_000)
    host.pins(rxd=1)
    host.pause(400)
    assert host.poll() == "90"
    assert host.ask("4F") == "A0 01 00 00"


@verifies("P312-SER-18", "P312-SER-01")
def test_characters_without_a_gap_and_with_one() -> None:
    host = SerialHost()
    for gap in (0, 0.3, 1, 7.77, 100):
        host.send(summed(0x91, b"\x43\xa5\x5a\x00\xff"), gap)
        host.t -= ceil(Fraction(gap) * host.bit)
        assert host.hear() == "90"
    assert host.ask("42") == "A0 A5 5A 00 FF"


@pytest.mark.parametrize("byte", PATTERNS)
@verifies("P312-SER-01")
def test_all_kinds_of_characters(byte: int) -> None:
    host = SerialHost(f"63 {byte * 0x01010101:08X}")
    assert host.ask("62") == " ".join(("A0", *[f"{byte:02X}"] * 4))
