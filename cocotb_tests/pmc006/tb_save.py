"""Writes to the EEPROM: save, burn, factory restore, and cases that are rejected (P006-EEP-10 to 23).

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any

import cocotb

from .builds import directed
from .chip import Chip
from .host import Host
from .moves import DECAY, download, start
from .programs import FACTORY_PAGE, P1, image, page, words
from .tb_boot import BLINK, FACTORY, SAVED, VALUES, booted, values

PAGE, PROGRAM, SUM, MARK, COPY = 32, 0x20, 0x340, 0x342, 0x360
FSET_US = 20_000


def written(host: Host) -> list[tuple[int, bytes]]:
    """Return the address and the bytes of each write."""
    return [(write.address, write.data) for write in host.eeprom.writes]


@directed("P006-EEP-10", "P006-CMD-41", "P006-BAD-12")
async def p006_save(dut: Any) -> None:
    """Instruction t writes two pages with all saved registers (the copy first) and nothing else."""
    host = await Host.start(dut, chip=Chip(write_us=3_000))
    await host.ok(m=0, u=5, o=4, a=0, Q=4, J=3, L=3000, S=65, M=1200, P=2000, e=4000, w=120)
    await host.ok(v=5, d=0, f=3, y=0xF8, T=3, Y=7, Z=99, i=12, A=7)
    assert await host.ask("t") == 1
    assert [await host.ask(code) for code in "tBV"] == [0, 0, 1]
    await host.ms(5)
    assert written(host) == [(COPY, SAVED), (0, SAVED)] and await host.ask("V") == 0
    assert await host.ask("t") == 1
    await host.ms(9)
    await host.reset(ext1=1)
    await host.boot()
    assert await values(host) == VALUES and host.replied == 120
    assert await host.ask("q") == 1000
    assert await host.ask("O") == 0x10
    assert await host.ask("T", -1) == 64
    assert await host.ask("A", -1) == 0


@directed("P006-EEP-10", "P006-CMD-54")
async def p006_registers_go_whole_into_a_save(dut: Any) -> None:
    """A save contains the old or the new VSTART, never a mixture, and its checksum is correct.

    The test changes VSTART before, between and after the writes of its two bytes. The job reads VSTART again
    for the second of the two pages. The device stretches the clock, so that a byte takes longer than a frame.
    """
    host = await Host.start(dut, chip=Chip(write_us=100))
    host.eeprom.stretch(host.us(900))
    old, seen = 600, []
    for place, new in ((13.4, 0x0A0B), (14.3, 0x0201), (14.8, 0x0A0B), (15.6, 0x0201)):
        assert await host.ask("t") == 1
        # Three bytes precede the bytes of the page. Each byte takes 22.5 us longer than the stretch. The part
        # reads the value of a byte after the acknowledge of the previous byte, before the stretch.
        await host.go(host.e + host.us(922.5 * place) - int(79.5 * host.bit))
        assert await host.ask("L", new) == new
        await host.ms(58)
        (_, copy), (_, content) = written(host)[-2:]
        for one in (copy, content):
            assert sum(one[:31]) & 0xFF == one[31] and len(one) == PAGE
        pair, later = (int.from_bytes(one[0x0C:0x0E], "little") for one in (copy, content))
        assert pair in (old, new) and later == new
        seen.append(pair == new)
        old = new
    assert seen == [True, False, False, False]


@directed("P006-EEP-11", "P006-CMD-02", "P006-BAD-12", "P006-BAD-11", "P006-PRG-02")
async def p006_burn(dut: Any) -> None:
    """Instruction B clears the mark, writes 25 pages, then writes checksum and mark.

    During this time the part rejects instruction W, a program can run, and the buffer does not change.
    """
    host = await booted(dut, image(SAVED, BLINK), 120)
    await download(host, P1)
    assert await host.ask("B") == 1
    assert [await host.ask(code, 1) for code in "WtBG"] == [0, 0, 0, words(P1)[0]]
    assert await host.ask("A", 0) == 0 and await host.ask("z") == 1
    await host.ok(F=0)
    await host.ms(40)
    first, *pages, last = written(host)
    content = image(SAVED, P1)
    assert first == (MARK, b"\x00") and last == (SUM, content[SUM:])
    assert pages == [(at, content[at : at + PAGE]) for at in range(PROGRAM, SUM, PAGE)]
    assert host.eeprom.memory[: len(content)] == content
    assert await host.ask("W", 9) == 9


@cocotb.parametrize(count=[1, 26, 27])
@directed("P006-EEP-11", "P006-BAD-15", "P006-BAD-13")
async def p006_a_device_that_dies_while_burning(dut: Any, count: int) -> None:
    """If the device fails, the job ends after 10 ms of polling; if the last write fails, the mark is not
    set.
    """
    host = await booted(dut, image(SAVED, BLINK), 120)
    assert await host.ask("B") == 1
    while len(host.eeprom.writes) < count:
        await host.wait_us(100)
    host.eeprom.missing(True)
    await host.ms(13)
    assert await host.ask("B") == 1 and await host.ask("k") == 0
    assert host.eeprom.memory[MARK] == (0x5A if count == 27 else 0) and len(host.eeprom.writes) == count
    await host.ms(13)
    assert await host.ask("t") == 1


@directed("P006-BAD-13", "P006-BAD-12", "P006-EEP-10")
async def p006_lines_that_stick_while_saving(dut: Any) -> None:
    """If SCL is held low, a job ends after 1 ms and reports an error.

    If SDA is held low, the part receives this level as acknowledges: the job ends without an error, and
    nothing is written.
    """
    host = await Host.start(dut, chip=Chip(write_us=100))
    chip = host.eeprom
    for line, jobs in (("scl", "tB"), ("sda", "t")):
        for job in jobs:
            await host.send_frame(job)
            assert await host.receive_reply() == 1
            chip.stuck(line, True)
            await host.ms(3)
            assert await host.ask("V") == (2 if line == "scl" else 0)
            assert await host.ask("t") == 1
            await host.ms(3)
            chip.stuck(line, False)
            await host.ms(13)
    assert await host.ask("t") == 1
    await host.ms(3)
    assert written(host)[-1] == (0, FACTORY_PAGE) and await host.ask("V") == 0


@directed("P006-EEP-10", "P006-CMD-41", "P006-CMD-48")
async def p006_a_failed_save_is_reported(dut: Any) -> None:
    """Instruction V returns 1 while the EEPROM is in use, 2 if it did not respond, and 0 after success."""
    host = await Host.start(dut, chip=Chip(write_us=2_000))
    chip = host.eeprom
    assert await host.ask("V") == 0
    for count in range(3):
        before = len(chip.writes)
        chip.missing(not count)
        assert await host.ask("t") == 1
        while len(chip.writes) < before + count:
            await host.wait_us(50)
        chip.missing(True)
        await host.ms(14)
        assert await host.ask("V") == 2 and await host.ask("j") == DECAY and await host.ask("V", 77) == 2
        assert len(chip.writes) == before + count
        chip.missing(False)
        assert await host.ask("t") == 1 and await host.ask("V") == 1
        await host.ms(8)
        assert await host.ask("V") == 0
    await host.reset()
    await host.boot()
    assert await host.ask("V") == 0


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
"""Code -> value in the reply of the part after a boot with the settings NEW instead of SAVED."""


PLACES = 7


async def answering(host: Host) -> int:
    """Return the address to which the part responds after a boot."""
    for address in (120, 5, 0xFF):
        await host.send_frame("k", address=address)
        await host.pause(int(3 * host.bit))
        if await host.next_de_rise() is not None:
            await host.receive_reply()
            return address
    raise AssertionError("no reply")


TORN = bytes([*SAVED[:8], SAVED[8] ^ 1, *SAVED[9:]])
"""SAVED with a wrong checksum."""
COPY_FIRST, PAGE_FIRST = [COPY, 0], [0, COPY]


@directed("P006-EEP-10", "P006-BAD-14", "P006-BAD-15")
async def p006_valid_block_is_replaced_last(dut: Any) -> None:
    """While the page may be invalid and its copy is valid, a save writes the page first; otherwise the copy.

    The page may be invalid after a boot from the copy, or after a save that failed in the page.
    """
    host = await booted(dut, image(SAVED), 120)

    async def save(expected: list[int], job: str = "t") -> None:
        before = len(written(host))
        assert await host.ask(job) == 1
        await host.ms(6 if job == "t" else 45)
        assert [address for address, _ in written(host)[before:]] == expected

    async def fail(after: int) -> None:
        before = len(written(host))
        assert await host.ask("t") == 1
        while len(written(host)) < before + after:
            await host.wait_us(20)
        host.eeprom.missing(True)
        await host.ms(14)
        assert await host.ask("V") == 2
        host.eeprom.missing(False)

    await save(COPY_FIRST)
    await fail(after=0)
    await save(COPY_FIRST)
    await fail(after=2)
    await save([MARK, *range(PROGRAM, SUM, PAGE), SUM], "B")
    await save(PAGE_FIRST)
    await save(COPY_FIRST)
    await fail(after=2)
    await fail(after=1)
    await fail(after=2)
    await save(COPY_FIRST)
    for block, copy, expected in (
        (SAVED, TORN, COPY_FIRST),
        (TORN, SAVED, PAGE_FIRST),
        (TORN, TORN, COPY_FIRST),
    ):
        host = await booted(dut, image(block) + bytes(0x1D) + copy, 0xFF if block == copy else 120)
        await save(expected)
        await save(COPY_FIRST)
    host = await booted(dut, image(TORN) + bytes(0x1D) + SAVED, 120)
    await host.pins(fset_n=0)
    await host.wait_us(FSET_US + 6_000)
    await host.pins(fset_n=1)
    assert written(host) == [(0, FACTORY_PAGE), (COPY, FACTORY_PAGE)]


@cocotb.parametrize(page_valid=[True, False])
@directed("P006-EEP-10", "P006-BAD-24", "P006-BAD-14")
async def p006_reset_while_settings_are_saved(dut: Any, page_valid: bool) -> None:
    """After a reset at any time during a save, the next boot restores either all old or all new settings.

    This test resets the complete part at some times; tests/pmc006/model/test_cuts.py tests every edge.
    """
    seen: list[bool] = []
    for number in range(PLACES):
        host = await booted(dut, image(SAVED if page_valid else TORN) + bytes(0x1D) + SAVED, 120)
        await host.ok(**{name: value for name, value in NEW.items() if name != "w"})
        assert await host.ask("w", 5) == 5
        await host.send_frame("t")
        await host.go(host.e + host.us(30 + 500 * number) + 7 * number)
        await host.reset()
        await host.boot()
        host.address = await answering(host)
        seen.append(host.address == 5)
        assert await values(host) == (BOOTED if seen[-1] else VALUES), f"cut {number}"
    assert not seen[0] and seen[-1] and 1 < sum(seen) < PLACES


@directed("P006-EEP-20", "P006-EEP-21", "P006-EEP-22", "P006-BAD-22")
async def p006_restore_in_operation(dut: Any) -> None:
    """FSET low for 20 ms without interruption is one event, however long it stays low; active settings do not
    change.
    """
    host = await booted(dut, image(SAVED, BLINK), 120)
    await host.ok(v=3000)
    await start(host, 100_000)
    for us in (FSET_US - 100, FSET_US - 1_000):
        await host.pins(fset_n=0)
        await host.wait_us(us)
        await host.pins(fset_n=1)
        await host.pause(1)
    assert not written(host)
    await host.pins(fset_n=0)
    await host.wait_us(2 * FSET_US)
    assert written(host) == [(COPY, FACTORY_PAGE), (0, FACTORY_PAGE)]
    await host.pins(fset_n=1)
    assert await values(host) == VALUES and await host.busy() and await host.ask("I") == 0
    assert host.eeprom.memory[PROGRAM : MARK + 1] == image(SAVED, BLINK)[32:]
    host.address = 0xFF
    await host.reset()
    await host.boot()
    assert await values(host) == FACTORY
    assert await host.ask("G") == words(BLINK)[0]
    assert await host.out("gpo") == 0


@directed("P006-EEP-22", "P006-BAD-12")
async def p006_restore_waits_for_a_job(dut: Any) -> None:
    """A factory restore waits for the end of a burn; until both have ended, instructions t and B are
    rejected.
    """
    host = await booted(dut, image(SAVED, BLINK), 120)
    await host.pins(fset_n=0)
    await host.wait_us(FSET_US - 5_000)
    assert await host.ask("B") == 1
    await host.wait_us(8_000)
    assert await host.ask("t") == 0
    await host.ms(38)
    await host.pins(fset_n=1)
    order = [address for address, _ in written(host)]
    assert order == [MARK, *range(PROGRAM, SUM, PAGE), SUM, COPY, 0] and written(host)[-1][1] == FACTORY_PAGE
    assert await host.ask("t") == 1


@cocotb.parametrize(low_us=[FSET_US - 100, FSET_US + 100, 60_000])
@directed("P006-EEP-21", "P006-EEP-20", "P006-BAD-22")
async def p006_restore_at_power_up(dut: Any, low_us: int) -> None:
    """FSET held low delays the boot by at most 20 ms; the program is kept but not started."""
    host = await Host.start(
        dut, chip=Chip(image(page(a0B=1, a04=4), BLINK), write_us=500), levels={"fset_n": 0}, boot=False
    )
    await host.wait_us(low_us)
    await host.pins(fset_n=1)
    await host.boot()
    restored = low_us > FSET_US
    assert await host.ask("k") == (16 if restored else 4) and await host.out("gpo") == (0 if restored else 1)
    assert await host.ask("G") == words(BLINK)[0] and await host.ask("F", -1) == (0 if restored else 1)
    assert written(host) == ([(COPY, FACTORY_PAGE), (0, FACTORY_PAGE)] if restored else [])


@directed("P006-EEP-21", "P006-EEP-20")
async def p006_restore_at_the_end_of_power_up(dut: Any) -> None:
    """If the FSET event occurs during BOOT, the factory values are active afterwards; if it occurs after
    BOOT, the saved values are active.
    """
    late_us = 6_000
    saved = image(SAVED, BLINK)
    chip = Chip(saved, busy_us=late_us)
    host = await Host.start(dut, address=120, chip=chip, boot=False)
    up = await host.boot()
    for before in (400, 240, 120, 30, -20):
        chip = Chip(saved, write_us=500, busy_us=late_us)
        host = await Host.start(dut, address=120, chip=chip, boot=False)
        await host.go(up - before - host.us(FSET_US + 1))
        await host.pins(fset_n=0)
        await host.go(up + 100)
        await host.boot()
        await host.pins(fset_n=1)
        await host.ms(5)
        if before > 0:
            host.address = 0xFF
        assert await values(host) == (FACTORY if before > 0 else VALUES), before
        assert written(host) == [(COPY, FACTORY_PAGE), (0, FACTORY_PAGE)]
