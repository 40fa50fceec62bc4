"""Scripts: frames of the serial mode, good and bad: control codes, length, checksum, silence, counters."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies

from .serial_frames import SILENCE, TS, summed
from .serial_host import SerialHost

NONE = "A0 00 00 00"


@pytest.mark.parametrize("adr", [0, 1, 2, 4, 7, 8, 15])
@verifies("P312-SER-10", "P312-SER-02")
def test_addresses(adr: int) -> None:
    host = SerialHost(adr=adr)
    assert host.ask("25") == "A0 00"
    other = (adr + 5) % 16
    host.say("25", other)
    host.ask_poll(other)
    assert host.quiet(3_000)
    assert host.poll() == "90"


@verifies("P312-SER-10", "P312-BAD-16", "P312-CHK-56")
def test_control_codes() -> None:
    """Only 81 and 91 are for station 1; whatever else has bit 7 ends a frame and begins none."""
    host = SerialHost()
    for control in range(0x80, 0x100, 3):
        if control not in (0x81, 0x91):
            host.raw("91 30 36 30")
            host.send(summed(control, b"\x25"))
            host.raw("31 67")
    host.raw("A1 B1 C1 D1 E1 F1 7E")
    assert host.quiet(4_000)
    assert host.poll() == "90" and host.ask("4F") == NONE and host.ask("4D") == "A0 00 01 00"


@verifies("P312-SER-10")
def test_a_control_code_begins_anew() -> None:
    host = SerialHost()
    for begin in ("81", "91", "91 32", "91 32 36", "91 32 36 31", "91 32 36 31 35", "91 33 33", "91 4A"):
        host.raw(begin)
        assert host.ask("25") == "A0 00"
    host.raw("91 32 36 31 35")
    assert host.poll() == "90"
    assert host.out("auxo_n") == 0x3F and host.ask("4F") == NONE


@verifies("P312-SER-11", "P312-SER-13")
def test_checksums_that_look_like_digits() -> None:
    """26 with any value: the checksum goes through all numbers; the frame ends where it has to."""
    host = SerialHost()
    seen = set()
    for value in (*range(0x0C, 0x19), *range(0x62, 0x69), 0x00, 0x47, 0x48, 0x49):
        frame = summed(0x91, bytes([0x26, value]))
        seen.add(frame[-1])
        host.send(frame)
        assert host.hear() == "90" and host.out("auxo_n") == ~value & 0x3F
    assert seen & set(b"0123456789") and seen & set(b"abcdef") and 0 in seen


@verifies("P312-SER-11", "P312-BAD-16")
def test_short_and_long_frames() -> None:
    """The code says how long a frame is; what comes after the checksum belongs to nothing."""
    host = SerialHost()
    host.raw("91 32 36 31 33 37")
    assert host.hear() == "B0 41"
    host.raw("91 32 35 49 30 31 32 33")
    assert host.hear(timed=False) == "A0 00"
    host.raw("35 32 49 7E")
    assert host.quiet(3_000)
    host.raw("81 7E 7E 7E")
    assert host.hear(timed=False) == "90"
    host.raw("81 30")
    assert host.hear() == "B0 41"
    assert host.ask("4F") == "A0 00 00 02" and host.out("auxo_n") == 0x3F


@pytest.mark.parametrize("mode", ["BINARY", "CHARS"])
@verifies("P312-SER-13", "P312-SER-14", "P312-CHK-57")
def test_every_wrong_bit_of_a_checksum(mode: str) -> None:
    host = SerialHost(sum_mode=mode)
    good = summed(0x91, b"\x26\x15", mode)
    for bit in range(7):
        host.send(good[:-1] + bytes([good[-1] ^ 1 << bit]))
        assert host.hear() == "B0 41"
    assert host.out("auxo_n") == 0x3F and host.ask("4F") == "A0 00 00 07"
    host.send(good)
    assert host.hear() == "90" and host.out("auxo_n") == 0x2A
    poll = summed(0x81, b"", mode)
    for bit in range(7):
        host.send(poll[:-1] + bytes([poll[-1] ^ 1 << bit]))
        assert host.hear() == "B0 41"
    assert host.poll() == "90" and host.ask("4E") == "A0 00"


@verifies("P312-SER-13")
def test_sum_of_characters() -> None:
    host = SerialHost(TS, sum_mode="CHARS")
    assert host.ask("43 89ABCDEF") == "90" and host.ask("42") == "A0 89 AB CD EF"
    assert host.ask("83 0000 00000000") == "B0 42"
    host.raw("81 7E")
    assert host.hear() == "B0 41" and host.wire == "B1 34 31 1A"
    host.raw("81 7F")
    assert host.hear() == "90" and host.wire == "91 7F"


@verifies("P312-SER-13")
def test_the_blind_bit() -> None:
    """Bit 7 of a byte is not in the sum: what one wrong bit makes of it is executed. The manual warns."""
    host = SerialHost()
    good = summed(0x91, b"\x43\x00\x00\x00\x14")
    wrong = bytearray(good)
    wrong[-3] ^= 0x08
    assert (good[-3:-1], wrong[-3:-1]) == (b"14", b"94")
    host.send(wrong)
    assert host.hear() == "90" and host.ask("42") == "A0 00 00 00 94"
    assert host.ask("4F") == NONE


BAD_DIGITS = (0x00, 0x2F, 0x3A, 0x3F, 0x40, 0x41, 0x46, 0x60, 0x67, 0x7F, 0x20, 0x0A)


@pytest.mark.parametrize("bad", BAD_DIGITS)
@verifies("P312-SER-12", "P312-CHK-73", "P312-BAD-16")
def test_bad_digits(bad: int) -> None:
    """In the data the frame goes on to its end."""
    host = SerialHost()
    frame = bytearray(summed(0x91, b"\x26\x15"))
    for place in (3, 4):
        wrong = bytes([*frame[:place], bad, *frame[place + 1 :]])
        host.send(wrong[:-1])
        assert host.quiet(500)
        host.send(wrong[-1:])
        assert host.hear() == "B0 41"
    assert host.ask("4F") == "A0 00 00 02" and host.ask("4E") == "A0 00" and host.out("auxo_n") == 0x3F


@pytest.mark.parametrize("line", ["91 4A", "91 4A 36", "91 30 4A", "91 46 46 6F 30"])
@verifies("P312-SER-12", "P312-SER-17")
def test_bad_digits_in_the_code(line: str) -> None:
    """The length is unknown: the end is 20 ms of silence."""
    host = SerialHost()
    host.raw(line)
    assert host.quiet(SILENCE - 2_000)
    assert host.hear(SILENCE + 4_096) == "B0 41"
    assert host.ask("4F") == "A0 00 00 01" and host.ask("4E") == "A0 00"


UNKNOWN = ("01", "29", "47", "92", "FE")


@pytest.mark.parametrize("code", UNKNOWN)
@verifies("P312-SER-17", "P312-SER-44", "P312-BAD-06", "P312-CHK-60")
def test_unknown_codes(code: str) -> None:
    host = SerialHost()
    host.raw("91")
    host.send(code.lower().encode())
    assert host.quiet(SILENCE - 3_000)
    assert host.hear(SILENCE + 4_096) == "B0 47"
    assert host.ask("4E") == "A0 47" and host.ask("4E") == "A0 00" and host.ask("4F") == NONE


@verifies("P312-SER-17")
def test_unknown_code_with_more() -> None:
    """Everything is swallowed; each character begins the silence anew; a control code ends it all."""
    host = SerialHost()
    host.raw("91 33 33 30 31 32 33 7E")
    host.pause(200_000)
    host.raw("67")
    assert host.quiet(SILENCE - 3_000)
    assert host.hear(SILENCE + 4_096) == "B0 47"
    host.raw("91 33 33 30")
    host.pause(SILENCE - 10_000)
    assert host.poll() == "90"
    host.raw("91 33 33 30")
    host.pause(SILENCE - 10_000)
    host.raw("82")
    assert host.quiet(SILENCE + 8_000)
    host.raw("91 33 33")
    host.character(0x30, stop=0)
    assert host.quiet(SILENCE + 8_000)
    assert host.ask("4E") == "A0 47"


@pytest.mark.parametrize("begin", ["81", "91 32", "91 32 36 31 35"])
@verifies("P312-SER-16")
def test_silence_in_a_frame(begin: str) -> None:
    """19 ms are nothing; after 21 ms nobody waits for the rest."""
    rest = {"81": "7E"}.get(begin, "91 32 36 31 35 33"[len(begin) + 1 :])
    host = SerialHost()
    host.raw(begin)
    host.pause(304_000)
    host.raw(rest)
    assert host.hear() == "90"
    level = host.out("auxo_n")
    host.raw("91 32 36 30 30 48")
    assert host.hear() == "90"
    host.raw(begin)
    host.pause(SILENCE + 16_000)
    host.raw(rest)
    assert host.quiet(8_000) and host.out("auxo_n") == 0x3F
    assert host.poll() == "90" and host.ask("4F") == NONE and host.ask("4E") == "A0 00"
    assert level == (0x3F if begin == "81" else 0x2A)


@pytest.mark.parametrize("after", [-40, -1, 0, 1, 2, 40])
@verifies("P312-SER-16")
def test_the_end_of_the_silence(after: int) -> None:
    """A character whose stop bit comes within 20 ms belongs to the frame."""
    host = SerialHost()
    host.raw("81")
    # 10 bits from one stop bit to that of a character that follows at once.
    host.t += SILENCE - 1_920 + after
    host.raw("7E")
    assert host.hear() == "90" if after < 0 else abs(after) < 3 or host.quiet(8_000)
    host.pause(5_000)


@verifies("P312-SER-15", "P312-SER-19")
def test_a_master_that_talks_out_of_turn() -> None:
    """While a reply is on its way every control code for this station counts, and its frame is ignored."""
    host = SerialHost()
    host.raw("91 34 31 2D")
    host.send(summed(0x81) + summed(0x91, b"\x26\x15"))
    assert host.hear(timed=False) == "A0 12" and host.quiet(4_000)
    assert host.out("auxo_n") == 0x3F and host.ask("4F") == "A0 00 02 00"
    host.raw("91 34 31 2D")
    host.raw("91 A1 B1 81")
    assert host.hear(timed=False) == "A0 12" and host.ask("4F") == "A0 00 02 00"


@verifies("P312-SER-15", "P312-SER-18")
def test_out_of_turn_while_a_table_is_built() -> None:
    host = SerialHost()
    host.say(TS)
    for _ in range(4):
        host.send(summed(0x81))
    host.send(summed(0x91, b"\x25"))
    assert host.hear(65_536) == "90"
    assert host.poll() == "90" and host.ask("4F") == "A0 00 05 00"


@verifies("P312-SER-15")
def test_a_station_that_hears_itself() -> None:
    """A master without a gate on its receiver: the echo of 91 and 81 counts, those of A1 and B1 do not."""
    host = SerialHost()
    for line, echo in (("81 7E", "91 6E"), ("91 34 31 2D", "A1 31 32 4C"), ("81 00", "B1 34 31 0D")):
        host.raw(line)
        rise = host.begin()
        host.back_to(rise + 192)
        host.raw(echo)
        assert host.hear(timed=False) in ("90", "A0 12", "B0 41")
    assert host.ask("4F") == "A0 00 01 01"


@pytest.mark.parametrize("clk", [-3, -2, -1, 0, 1, 2, 3])
@verifies("P312-SER-15", "P312-SER-19")
def test_the_end_of_a_turn(clk: int) -> None:
    """The stop bit of a control code is looked at around the fall of snd."""
    host = SerialHost()
    host.raw("81 7E")
    rise = host.begin()
    # snd falls 21 bits after its rise; the middle of the next stop bit is 9.5 bits after its start.
    host.back_to(rise + 21 * 192 - 19 * 96 - 2 + clk)
    host.raw("81 7E")
    assert host.hear(timed=False) == "90"
    late = not host.quiet(4_000)
    assert abs(clk) < 3 or late == (clk > 0)
    if late:
        assert host.hear() == "90"
    assert host.ask("4F") == f"A0 00 {not late:02X} 00"


@pytest.mark.parametrize("kind", ["framing", "overrun", "checksum"])
@verifies("P312-SER-45", "P312-SER-15", "P312-SER-14")
def test_counters_saturate(kind: str) -> None:
    host = SerialHost("43 00000000", clk_hz=8_000_000, version=0x34)
    if kind == "framing":
        for _ in range(258):
            host.low(9.8)
    elif kind == "checksum":
        for _ in range(258):
            host.raw("81 00")
            assert host.hear() == "B0 41"
    else:
        # Nine control codes while ten characters are sent.
        for _ in range(29):
            host.say("42")
            host.send(b"\x81" * 9)
            assert host.hear(timed=False) == "A0 00 00 00 00"
    counts = {"framing": "FF 00 00", "overrun": "00 FF 00", "checksum": "00 00 FF"}[kind]
    assert [host.ask("4F"), host.ask("4F")] == [f"A0 {counts}", NONE]
