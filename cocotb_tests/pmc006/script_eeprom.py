"""Scripts: boot from an EEPROM: what is valid, what is not; a device that is missing, busy, stuck (13.2)."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies

from .scenes import DECAY, FACTORY_PAGE, OFFLINE, Op, device, goto, image, out, page, quick, start, words
from .script_host import Host

SAVED = page(
    a03=0x78, a04=0, a06=5, a07=4, a08=0, a09=4, a0A=3, a0B=0, a0C=0xB8, a0D=0x0B, a0E=65, a0F=0,
    a10=0xB0, a11=4, a12=0xD0, a13=7, a14=0xA0, a15=0x0F,
)  # fmt: skip
"""Address 120, m 0, u 5, o 4, a 0, Q 4, J 3, L 3000, S 65, M 1200, P 2000, e 4000: ends of their ranges."""
VALUES = {"k": 0, "r": 5, "h": 4, 0x55: 4, "K": 3, "L": 3000, "S": 65, "M": 1200, "P": 2000, "n": 4000}
FACTORY = {"k": 16, "r": 0, "h": 0, 0x55: 1, "K": 0, "L": 600, "S": 600, "M": 300, "P": 1250, "n": 800}
BLINK = (out(1, 1), goto(1))
"""A program that shows itself and does not end."""


def values(host: Host) -> dict[str | int, int]:
    """Registers that are saved."""
    return {code: host.ask(code) for code in FACTORY}


def booted(content: bytes, address: int = 0xFF, **more: int) -> Host:
    """A host on a part with that EEPROM."""
    return Host(address=address, eeprom=device(content, write_us=500, **more))


def unread(host: Host) -> bool:
    """Whether nothing has been written, and the page is not in force."""
    assert host.eeprom is not None
    return not host.eeprom.writes and host.ask("k") == 16 and host.replied == 0xFF


@verifies("P006-EEP-01", "P006-CMD-50", "P006-CMD-56")
def test_all_registers_of_the_page() -> None:
    host = booted(image(SAVED), 120)
    assert values(host) == VALUES and host.status() == 0 and host.ask("O") == 0x10
    assert (host.out("ext1_pu"), host.out("ext2_pu")) == (0, 0)


ILLEGAL = ({"a03": 121}, {"a04": 6}, {"a08": 2}, {"a0C": 64, "a0D": 0}, {"a13": 8}, {"a15": 0x10}, {"a02": 2})
"""A byte or field of a good block changed; the sum is right."""


@verifies("P006-BAD-14", "P006-EEP-01")
def test_one_bad_field_makes_the_block_bad() -> None:
    """Factory values, and nothing is written. The program is not touched by that."""
    for changes in ILLEGAL:
        host = booted(image(page(a06=3, a07=4, **changes), BLINK))
        assert unread(host), changes
        assert host.ask("r") == host.ask("h") == 0 and host.ask("G") == words(BLINK)[0], changes


@verifies("P006-BAD-14", "P006-EEP-01")
def test_sum_and_unused_bytes_of_the_block() -> None:
    """Those that nobody looks at may be anything, as long as the sum is right."""
    unused = {f"a{place:02X}": 0xA0 + place for place in (0x05, *range(0x16, 0x1F))}
    assert booted(image(page(a04=8, **unused))).ask("k") == 8
    for place in (0x05, 0x1F):
        content = bytearray(page(a04=8))
        content[place] ^= 0x40
        assert unread(booted(image(bytes(content))))


@verifies("P006-BAD-14", "P006-EEP-10", "P006-EEP-01", "P006-PRG-11")
def test_a_copy_stands_in_for_a_bad_block() -> None:
    """Sum, head or field: the copy is judged likewise, and nothing is written. A good block leaves it alone.
    The program counts by itself."""
    old, new = page(a04=4, a03=7), page(a04=32, a03=9, a0B=1)
    torn, wild, short = bytearray(old), page(a04=6), page(a02=2)
    torn[3] ^= 1
    for number, (first, copy, wanted) in enumerate(
        (
            (old, new, (4, 7)),
            (bytes(torn), new, (32, 9)),
            (wild, new, (32, 9)),
            (short, new, (32, 9)),
            (b"\xff" * 32, old, (4, 7)),
            (old, bytes(torn), (4, 7)),
            (bytes(torn), bytes(torn), (16, 255)),
            (bytes(torn), wild, (16, 255)),
            (wild, short, (16, 255)),
        )
    ):
        good = number % 3 != 1
        content = image(first, BLINK, 0x5A if good else 0) + bytes(0x1D) + copy
        host = booted(content, wanted[1])
        assert host.t < host.us(60_000) and host.ask("k") == wanted[0], number
        assert host.replied == wanted[1] and host.ask("V") == 0
        assert host.ask("G") == (words(BLINK)[0] if good else 0)
        runs = good and copy == new and wanted[1] == 9
        assert host.out("gpo") == runs and host.eeprom is not None and not host.eeprom.writes


@verifies("P006-BAD-15", "P006-PRG-11", "P006-PRG-01", "P006-EEP-11")
def test_which_programs_count() -> None:
    """Sum over the program alone, end mark; a bad one leaves 200 words of zero and starts nothing."""
    good = image(page(a0B=1, a04=4), BLINK)
    host = booted(good)
    assert host.ask("k") == 4 and host.out("gpo") == 1 and host.ask("W") == 0
    host.ok(A=0)
    assert [host.ask("G") for _ in range(4)] == words(BLINK)
    for place, change in ((0x342, 0xFF), (0x341, 0x80), (0x33F, 0x10)):
        content = bytearray(good)
        content[place] ^= change
        host = booted(bytes(content))
        assert host.ask("k") == 4 and host.out("gpo") == 0 and host.ask("O") & OFFLINE
        assert host.ask("z") == 1 and host.ask("G") == 0
        host.ok(A=199)
        assert host.ask("G") == 0 and host.eeprom is not None and not host.eeprom.writes


@verifies("P006-PRG-11", "P006-PRG-01")
def test_a_good_program_without_a_good_block() -> None:
    """It is there, but the factory's OFFLINE does not start it."""
    host = booted(image(b"\xff" * 32, BLINK))
    assert unread(host) and host.out("gpo") == 0 and host.ask("G") == words(BLINK)[0]
    host.ok(A=0)
    assert host.ask("z") == 1 and host.out("gpo") == 1


@verifies("P006-PRG-11", "P006-EEP-01")
def test_last_instruction_and_high_bytes_are_loaded() -> None:
    program = [Op(0x12, 8, -2)] * 99 + [Op(0x08, 1, 0x12345678)]
    host = booted(image(page(), program))
    host.ok(A=196)
    assert [host.ask("G") for _ in range(4)] == words(program[-2:])


@pytest.mark.parametrize("fault", ["missing", "other", "scl"])
@verifies("P006-BAD-13", "P006-EEP-01", "P006-BAD-12")
def test_without_a_device(fault: str) -> None:
    """10 ms of calls, or 1 ms of a clock held low; then all works, saving too, but without effect."""
    chip = device(image(SAVED), missing=fault == "missing")
    chip.device ^= fault == "other"
    chip.stuck_scl = fault == "scl"
    host = Host(eeprom=chip)
    assert host.us(1_000 if fault == "scl" else 10_000) <= host.t <= host.us(15_000)
    assert values(host) == FACTORY and host.ask("W", 5) == 5
    assert host.ask("V") == 0
    for job in "tBt":
        assert host.ask(job) == 1
        assert host.ask("W", 5) == 5 or job == "B"
        host.ms(12)
        assert host.ask("V") == 2
    assert not chip.writes and host.status() == DECAY
    assert (host.out("scl_oe"), host.out("sda_oe")) == (0, 0)


@verifies("P006-BAD-24", "P006-BAD-13", "P006-EEP-01")
def test_a_device_that_holds_sda() -> None:
    """A reset in the middle of a read: up to 9 pulses free it; one that never lets go is absent at once."""
    host = booted(image(SAVED), 120)
    for clk in range(0, 80, 23):
        host.pins(rst_n=0)
        host.pins(rst_n=1)
        host.pause(host.us(2_000) + clk)
        host.pins(rst_n=0)
        host.pause(3)
        host.pins(rst_n=1)
        host.forget()
        host.boot()
        assert host.ask("k") == 0 and host.replied == 120
    chip = device(image(SAVED))
    chip.stuck_sda = True
    host = Host(eeprom=chip)
    assert host.t < host.us(500)
    assert [t for t, level in host.edges("scl_oe") if level][9:] == []
    assert unread(host)


@verifies("P006-EEP-01", "P006-BAD-13")
def test_a_device_that_stretches_and_one_that_is_busy() -> None:
    assert booted(image(SAVED), 120, stretch_us=3).ask("n") == 4000
    chip = device(image(SAVED), write_us=6_000)
    host = Host(address=120, eeprom=chip, boot=False)
    chip.occupy(host.us(6_000))
    up = host.boot()
    assert host.us(6_000 + 18_000) < up < host.us(60_000) and host.ask("n") == 4000


@verifies("P006-BAD-24", "P006-PORT-01", "P006-PRG-01", "P006-IO-03")
def test_reset_in_the_middle_of_everything() -> None:
    """Outputs are at their reset levels at once; registers, flags and words start anew."""
    host = quick()
    host.ok(f=3, y=0xF8)
    host.ok(A=0)
    assert host.ask("W", 77) == 77
    start(host, 100_000)
    host.pins(ext2=0)
    host.pause(30)
    host.say("c")
    host.pause(int(host.bit * 20))
    host.pins(rst_n=0)
    levels = {pin: host.model.log.initial[pin] for pin in host.model.outputs}
    assert dict(host.model.outputs) == levels
    host.pause(10)
    host.pins(rst_n=1, ext2=1)
    host.forget()
    host.boot()
    assert values(host) == FACTORY and host.status() == DECAY and host.ask("O") == 0x10
    assert host.ask("G") == 0 and host.ask("c") == 0 and host.ask("x") == 0xF07 and FACTORY_PAGE[3] == 0xFF
