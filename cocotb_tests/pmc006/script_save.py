"""Scripts: what is written into the EEPROM: save, burn, factory restore; and when nothing is (13.3..13.5)."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies

from .scenes import DECAY, FACTORY_PAGE, P1, device, download, image, page, quick, start, words
from .script_eeprom import BLINK, FACTORY, SAVED, VALUES, booted, values
from .script_host import Host

PAGE, PROGRAM, SUM, MARK, COPY = 32, 0x20, 0x340, 0x342, 0x360
FSET_US = 20_000


def written(host: Host) -> list[tuple[int, bytes]]:
    """Address and bytes of all writes."""
    assert host.eeprom is not None
    return [(write.address, write.data) for write in host.eeprom.writes]


@verifies("P006-EEP-10", "P006-CMD-41", "P006-BAD-12")
def test_save() -> None:
    """Two writes of a page with everything that is saved, the copy first, and nothing else."""
    host = Host(eeprom=device(write_us=3_000))
    host.ok(m=0, u=5, o=4, a=0, Q=4, J=3, L=3000, S=65, M=1200, P=2000, e=4000, w=120)
    host.ok(v=5, d=0, f=3, y=0xF8, T=3, Y=7, Z=99, i=12, A=7)
    assert host.ask("t") == 1
    assert [host.ask(code) for code in "tBV"] == [0, 0, 1]
    host.ms(5)
    assert written(host) == [(COPY, SAVED), (0, SAVED)] and host.ask("V") == 0
    assert host.ask("t") == 1
    host.ms(9)
    host.reset(ext1=1)
    host.boot()
    assert values(host) == VALUES and host.replied == 120
    assert (
        host.ask("q") == 1000 and host.ask("O") == 0x10 and host.ask("T", -1) == 64 and host.ask("A", -1) == 0
    )


@verifies("P006-EEP-10", "P006-CMD-54")
def test_registers_go_whole_into_a_save() -> None:
    """VSTART changes before, between and behind its two bytes: old or new, never half; the sum is right. Each
    of the two pages takes it anew.

    The device stretches the clock, so that a byte lasts longer than a frame.
    """
    host = Host(eeprom=device(write_us=100))
    assert host.eeprom is not None
    host.eeprom.stretch_clk = host.us(900)
    old, seen = 600, []
    for place, new in ((13.4, 0x0A0B), (14.3, 0x0201), (14.8, 0x0A0B), (15.6, 0x0201)):
        assert host.ask("t") == 1
        # Three bytes come before those of the page; one lasts 22.5 us more than it is stretched, and is taken
        # as soon as the one before has been acknowledged, before the stretch.
        host.go(host.e + host.us(922.5 * place) - int(79.5 * host.bit))
        assert host.ask("L", new) == new
        host.ms(58)
        (_, copy), (_, content) = written(host)[-2:]
        for one in (copy, content):
            assert sum(one[:31]) & 0xFF == one[31] and len(one) == PAGE
        pair, later = (int.from_bytes(one[0x0C:0x0E], "little") for one in (copy, content))
        assert pair in (old, new) and later == new
        seen.append(pair == new)
        old = new
    assert seen == [True, False, False, False]


@verifies("P006-EEP-11", "P006-CMD-02", "P006-BAD-12", "P006-BAD-11", "P006-PRG-02")
def test_burn() -> None:
    """Mark away, 25 pages, sum and mark; W is refused meanwhile, a program runs, the buffer stays."""
    host = booted(image(SAVED, BLINK), 120)
    download(host, P1)
    assert host.ask("B") == 1
    assert [host.ask(code, 1) for code in "WtBG"] == [0, 0, 0, words(P1)[0]]
    assert host.ask("A", 0) == 0 and host.ask("z") == 1
    host.ok(F=0)
    host.ms(40)
    first, *pages, last = written(host)
    content = image(SAVED, P1)
    assert first == (MARK, b"\x00") and last == (SUM, content[SUM:])
    assert pages == [(at, content[at : at + PAGE]) for at in range(PROGRAM, SUM, PAGE)]
    assert host.eeprom is not None and bytes(host.eeprom.memory[: len(content)]) == content
    assert host.ask("W", 9) == 9


@pytest.mark.parametrize("count", [1, 26, 27])
@verifies("P006-EEP-11", "P006-BAD-15", "P006-BAD-13")
def test_a_device_that_dies_while_burning(count: int) -> None:
    """The job ends within 10 ms of calls; without its last write the mark stays away."""
    host = booted(image(SAVED, BLINK), 120)
    assert host.ask("B") == 1 and host.eeprom is not None
    while len(host.eeprom.writes) < count:
        host.wait_us(100)
    host.eeprom.missing = True
    host.eeprom.sda = host.eeprom.scl = 0
    host.ms(13)
    assert host.ask("B") == 1 and host.ask("k") == 0
    assert host.eeprom.memory[MARK] == (0x5A if count == 27 else 0) and len(host.eeprom.writes) == count
    host.ms(13)
    assert host.ask("t") == 1


@verifies("P006-BAD-13", "P006-BAD-12", "P006-EEP-10")
def test_lines_that_stick_while_saving() -> None:
    """SCL low: over after 1 ms; SDA low looks like acknowledges that write nothing; SDA high like none."""
    host = Host(eeprom=device(write_us=100))
    chip = host.eeprom
    assert chip is not None and host.bus is not None
    for line, jobs in (("stuck_scl", "tB"), ("stuck_sda", "t")):
        for job in jobs:
            host.say(job)
            assert host.hear() == 1
            setattr(chip, line, True)
            host.sync()
            host.bus.again(host.model.now + 1)
            host.ms(3)
            assert host.ask("V") == (2 if line == "stuck_scl" else 0)
            assert host.ask("t") == 1
            host.ms(3)
            setattr(chip, line, False)
            host.sync()
            host.bus.again(host.model.now + 1)
            host.ms(13)
    assert host.ask("t") == 1
    host.ms(3)
    assert written(host)[-1] == (0, FACTORY_PAGE) and host.ask("V") == 0


@verifies("P006-EEP-10", "P006-CMD-41", "P006-CMD-48")
def test_a_save_that_fails_is_told() -> None:
    """V: 1 while the EEPROM is at work, 2 if it did not answer, 0 if all went well."""
    host = Host(eeprom=device(write_us=2_000))
    chip = host.eeprom
    assert chip is not None and host.ask("V") == 0
    for count in range(3):
        before = len(chip.writes)
        chip.missing = not count
        assert host.ask("t") == 1
        while len(chip.writes) < before + count:
            host.wait_us(50)
        chip.missing = True
        chip.sda = chip.scl = 0
        host.ms(14)
        assert host.ask("V") == 2 and host.ask("j") == DECAY and host.ask("V", 77) == 2
        assert len(chip.writes) == before + count
        chip.missing = False
        assert host.ask("t") == 1 and host.ask("V") == 1
        host.ms(8)
        assert host.ask("V") == 0
    host.reset()
    host.boot()
    assert host.ask("V") == 0


NEW = {
    "w": 5,
    "m": 4,
    "u": 1,
    "o": 2,
    "a": 0,
    "Q": 2,
    "J": 1,
    "L": 0x145,
    "S": 0x246,
    "M": 300,
    "P": 1250,
    "e": 0x3E8,
}


BOOTED = {"k": 4, "r": 1, "h": 2, 0x55: 2, "K": 1, "L": 0x145, "S": 0x246, "M": 300, "P": 1250, "n": 0x3E8}
"""What replaces SAVED, and its read-outs."""


PLACES = 7


def answering(host: Host) -> int:
    """Address that the part has after a boot."""
    for address in (120, 5, 0xFF):
        host.say("k", address=address)
        host.pause(int(3 * host.bit))
        if host.rise() is not None:
            host.hear()
            return address
    raise AssertionError("nobody answers")


@verifies("P006-EEP-10", "P006-BAD-24", "P006-BAD-14")
def test_reset_while_settings_are_saved() -> None:
    """Wherever a reset cuts t off, the next boot has the old settings or the new ones, all of them. Here some
    places, each through the whole part; tests/pmc006/model/test_cuts.py has every edge of the lines."""
    seen: list[bool] = []
    for number in range(PLACES):
        host = booted(image(SAVED) + bytes(0x1D) + SAVED, 120)
        host.ok(**{name: value for name, value in NEW.items() if name != "w"})
        assert host.ask("w", 5) == 5
        host.say("t")
        host.go(host.e + host.us(30 + 500 * number) + 7 * number)
        host.reset()
        host.boot()
        host.address = answering(host)
        seen.append(host.address == 5)
        assert values(host) == (BOOTED if seen[-1] else VALUES), f"cut {number}"
    assert not seen[0] and seen[-1] and 1 < sum(seen) < PLACES


@verifies("P006-EEP-20", "P006-EEP-21", "P006-EEP-22", "P006-BAD-22")
def test_restore_in_operation() -> None:
    """20 ms low without interruption are one event, however long it lasts; nothing in force changes."""
    host = booted(image(SAVED, BLINK), 120)
    host.ok(v=3000)
    start(host, 100_000)
    for us in (FSET_US - 100, FSET_US - 1_000):
        host.pins(fset_n=0)
        host.wait_us(us)
        host.pins(fset_n=1)
        host.pause(1)
    assert not written(host)
    host.pins(fset_n=0)
    host.wait_us(2 * FSET_US)
    assert written(host) == [(COPY, FACTORY_PAGE), (0, FACTORY_PAGE)]
    host.pins(fset_n=1)
    assert values(host) == VALUES and host.busy and host.ask("I") == 0
    assert (
        host.eeprom is not None and bytes(host.eeprom.memory[PROGRAM : MARK + 1]) == image(SAVED, BLINK)[32:]
    )
    host.address = 0xFF
    host.reset()
    host.boot()
    assert values(host) == FACTORY and host.ask("G") == words(BLINK)[0] and host.out("gpo") == 0


@verifies("P006-EEP-22", "P006-BAD-12")
def test_restore_waits_for_a_job() -> None:
    """Burn first, then the factory page; t and B are refused until both are done."""
    host = booted(image(SAVED, BLINK), 120)
    host.pins(fset_n=0)
    host.wait_us(FSET_US - 5_000)
    assert host.ask("B") == 1
    host.wait_us(8_000)
    assert host.ask("t") == 0
    host.ms(38)
    host.pins(fset_n=1)
    order = [address for address, _ in written(host)]
    assert order == [MARK, *range(PROGRAM, SUM, PAGE), SUM, COPY, 0] and written(host)[-1][1] == FACTORY_PAGE
    assert host.ask("t") == 1


@verifies("P006-EEP-21", "P006-EEP-20", "P006-BAD-22")
@pytest.mark.parametrize("low_us", [FSET_US - 100, FSET_US + 100, 60_000])
def test_restore_at_power_up(low_us: int) -> None:
    """Held for ever it delays the boot by 20 ms and no more; the program is kept but not started."""
    host = Host(
        eeprom=device(image(page(a0B=1, a04=4), BLINK), write_us=500), levels={"fset_n": 0}, boot=False
    )
    host.wait_us(low_us)
    host.pins(fset_n=1)
    host.boot()
    restored = low_us > FSET_US
    assert host.ask("k") == (16 if restored else 4) and host.out("gpo") == (0 if restored else 1)
    assert host.ask("G") == words(BLINK)[0] and host.ask("F", -1) == (0 if restored else 1)
    assert written(host) == ([(COPY, FACTORY_PAGE), (0, FACTORY_PAGE)] if restored else [])


@verifies("P006-EEP-21", "P006-EEP-22")
def test_restore_without_a_device() -> None:
    """Nothing lasts, nothing hangs."""
    host = Host(levels={"sda_i": 0, "fset_n": 0}, boot=False)
    host.boot()
    assert host.us(FSET_US) <= host.t <= host.us(FSET_US + 2_500)
    host.pins(fset_n=1)
    assert values(host) == FACTORY and host.status() == DECAY
    host = quick()
    # What the line says now is no acknowledge.
    host.pins(fset_n=0, sda_i=1)
    host.wait_us(FSET_US + 100)
    assert host.ask("V") == 2 and host.ask("t") == 1
    host.ms(12)
    assert host.ask("V") == 2 and host.ask("t") == 1


@verifies("P006-EEP-21", "P006-EEP-20")
def test_restore_at_the_end_of_power_up() -> None:
    """Whenever the event comes, during BOOT factory values are in force, and behind it the saved ones."""
    late_us = 6_000
    saved = image(SAVED, BLINK)
    chip = device(saved)
    host = Host(address=120, eeprom=chip, boot=False)
    chip.occupy(host.us(late_us))
    up = host.boot()
    for before in (400, 240, 120, 30, -20):
        chip = device(saved, write_us=500)
        host = Host(address=120, eeprom=chip, boot=False)
        chip.occupy(host.us(late_us))
        host.go(up - before - host.us(FSET_US + 1))
        host.pins(fset_n=0)
        host.go(up + 100)
        host.boot()
        host.pins(fset_n=1)
        host.ms(5)
        if before > 0:
            host.address = 0xFF
        assert values(host) == (FACTORY if before > 0 else VALUES), before
        assert written(host) == [(COPY, FACTORY_PAGE), (0, FACTORY_PAGE)]
