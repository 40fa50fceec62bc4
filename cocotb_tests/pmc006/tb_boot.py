"""Boot from an EEPROM: valid and invalid content; a device that is missing, busy or stuck."""

from __future__ import annotations

from typing import Any

import cocotb

from .builds import directed
from .chip import Chip
from .host import Host
from .moves import DECAY, OFFLINE
from .programs import Op, goto, image, out, page, words

SAVED = page(
    a03=0x78, a04=0, a06=5, a07=4, a08=0, a09=4, a0A=3, a0B=0, a0C=0xB8, a0D=0x0B, a0E=65, a0F=0,
    a10=0xB0, a11=4, a12=0xD0, a13=7, a14=0xA0, a15=0x0F,
)  # fmt: skip
"""Valid page with the ends of the ranges: address 120, m 0, u 5, o 4, a 0, Q 4, J 3, L 3000, S 65, M 1200, P
2000, e 4000.
"""
VALUES = {"k": 0, "r": 5, "h": 4, 0x55: 4, "K": 3, "L": 3000, "S": 65, "M": 1200, "P": 2000, "n": 4000}
FACTORY = {"k": 16, "r": 0, "h": 0, 0x55: 1, "K": 0, "L": 600, "S": 600, "M": 300, "P": 1250, "n": 800}
BLINK = (out(1, 1), goto(1))
"""A program that sets an output and does not end."""


async def values(host: Host) -> dict[str | int, int]:
    """Return the values of the registers that are saved."""
    return {code: await host.ask(code) for code in FACTORY}


async def booted(dut: Any, content: bytes, address: int = 0xFF, **more: Any) -> Host:
    """Return the host of a part that has booted from an EEPROM with this content."""
    return await Host.start(dut, address=address, chip=Chip(content, write_us=500, **more))


async def unread(host: Host) -> bool:
    """Return whether the registers have factory values, not those of the page, and no byte was written."""
    return not host.eeprom.writes and await host.ask("k") == 16 and host.replied == 0xFF


@directed("P006-EEP-01", "P006-CMD-50", "P006-CMD-56")
async def p006_all_registers_of_the_page(dut: Any) -> None:
    host = await booted(dut, image(SAVED), 120)
    assert await values(host) == VALUES and await host.status() == 0 and await host.ask("O") == 0x10
    assert (await host.out("ext1_pu"), await host.out("ext2_pu")) == (0, 0)


ILLEGAL = ({"a03": 121}, {"a04": 6}, {"a08": 2}, {"a0C": 64, "a0D": 0}, {"a13": 8}, {"a15": 0x10}, {"a02": 2})
"""Changes that make one byte or field of a valid block illegal; `page` adds the correct checksum."""


@directed("P006-BAD-14", "P006-EEP-01")
async def p006_one_bad_field_makes_the_block_bad(dut: Any) -> None:
    """One invalid field makes the block invalid: factory values apply, nothing is written, and the program is
    kept.
    """
    for changes in ILLEGAL:
        host = await booted(dut, image(page(a06=3, a07=4, **changes), BLINK))
        assert await unread(host), changes
        assert await host.ask("r") == await host.ask("h") == 0 and await host.ask("G") == words(BLINK)[0], (
            changes
        )


@directed("P006-BAD-14", "P006-EEP-01")
async def p006_sum_and_unused_bytes_of_the_block(dut: Any) -> None:
    """Unused bytes of the block may have any value if the checksum is correct."""
    unused = {f"a{place:02X}": 0xA0 + place for place in (0x05, *range(0x16, 0x1F))}
    assert await (await booted(dut, image(page(a04=8, **unused)))).ask("k") == 8
    for place in (0x05, 0x1F):
        content = bytearray(page(a04=8))
        content[place] ^= 0x40
        assert await unread(await booted(dut, image(bytes(content))))


@directed("P006-BAD-14", "P006-EEP-10", "P006-EEP-01", "P006-PRG-11")
async def p006_a_copy_replaces_a_bad_block(dut: Any) -> None:
    """A valid copy replaces a block with an invalid checksum, head or field.

    The copy is validated in the same way, and nothing is written. If the block is valid, the copy is not
    used. The program is validated independently.
    """
    old, new = page(a04=4, a03=7), page(a04=32, a03=9, a0B=1)
    torn, wild, short = bytearray(old), page(a04=6), page(a02=2)
    torn[3] ^= 1
    for number, (first, copy, expected) in enumerate(
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
        host = await booted(dut, content, expected[1])
        assert host.t < host.us(60_000) and await host.ask("k") == expected[0], number
        assert host.replied == expected[1] and await host.ask("V") == 0
        assert await host.ask("G") == (words(BLINK)[0] if good else 0)
        runs = good and copy == new and expected[1] == 9
        assert await host.out("gpo") == runs and not host.eeprom.writes


@directed("P006-BAD-15", "P006-PRG-11", "P006-PRG-01", "P006-EEP-11")
async def p006_which_programs_count(dut: Any) -> None:
    """A program is valid if its checksum and its end mark are correct.

    After an invalid program, all 200 words are 0, and no program is started.
    """
    good = image(page(a0B=1, a04=4), BLINK)
    host = await booted(dut, good)
    assert await host.ask("k") == 4 and await host.out("gpo") == 1 and await host.ask("W") == 0
    await host.ok(A=0)
    assert [await host.ask("G") for _ in range(4)] == words(BLINK)
    for place, change in ((0x342, 0xFF), (0x341, 0x80), (0x33F, 0x10)):
        content = bytearray(good)
        content[place] ^= change
        host = await booted(dut, bytes(content))
        assert await host.ask("k") == 4 and await host.out("gpo") == 0 and await host.ask("O") & OFFLINE
        assert await host.ask("z") == 1 and await host.ask("G") == 0
        await host.ok(A=199)
        assert await host.ask("G") == 0 and not host.eeprom.writes


@directed("P006-PRG-11", "P006-PRG-01")
async def p006_a_good_program_without_a_good_block(dut: Any) -> None:
    """If the program is valid and the block is not, the program is loaded, but the factory value of OFFLINE
    does not start it.
    """
    host = await booted(dut, image(b"\xff" * 32, BLINK))
    assert await unread(host) and await host.out("gpo") == 0 and await host.ask("G") == words(BLINK)[0]
    await host.ok(A=0)
    assert await host.ask("z") == 1 and await host.out("gpo") == 1


@directed("P006-PRG-11", "P006-EEP-01")
async def p006_last_instruction_and_high_bytes_are_loaded(dut: Any) -> None:
    program = [Op(0x12, 8, -2)] * 99 + [Op(0x08, 1, 0x12345678)]
    host = await booted(dut, image(page(), program))
    await host.ok(A=196)
    assert [await host.ask("G") for _ in range(4)] == words(program[-2:])


@cocotb.parametrize(fault=["missing", "other", "scl"])
@directed("P006-BAD-13", "P006-EEP-01", "P006-BAD-12")
async def p006_without_a_device(dut: Any, fault: str) -> None:
    """Without an EEPROM, the part is ready after 10 ms of transfers without a response, or after 1 ms if SCL
    is held low.

    Save instructions are accepted and have no effect.
    """
    faults: dict[str, Any] = {"stuck": "scl"} if fault == "scl" else {fault: True}
    chip = Chip(image(SAVED), **faults)
    host = await Host.start(dut, chip=chip)
    assert host.us(1_000 if fault == "scl" else 10_000) <= host.t <= host.us(15_000)
    assert await values(host) == FACTORY and await host.ask("W", 5) == 5
    assert await host.ask("V") == 0
    for job in "tBt":
        assert await host.ask(job) == 1
        assert await host.ask("W", 5) == 5 or job == "B"
        await host.ms(12)
        assert await host.ask("V") == 2
    assert not host.eeprom.writes and await host.status() == DECAY
    assert (await host.out("scl_oe"), await host.out("sda_oe")) == (0, 0)


@directed("P006-BAD-24", "P006-BAD-13", "P006-EEP-01")
async def p006_a_device_that_holds_sda(dut: Any) -> None:
    """If a device holds SDA low after a reset during a read, up to 9 pulses release it.

    If the device never releases SDA, the part immediately treats the device as absent.
    """
    host = await booted(dut, image(SAVED), 120)
    for clk in range(0, 80, 23):
        await host.pins(rst_n=0)
        await host.pins(rst_n=1)
        await host.pause(host.us(2_000) + clk)
        await host.pins(rst_n=0)
        await host.pause(3)
        await host.pins(rst_n=1)
        await host.ignore_replies()
        await host.boot()
        assert await host.ask("k") == 0 and host.replied == 120
    host = await Host.start(dut, chip=Chip(image(SAVED), stuck="sda"))
    assert host.t < host.us(500)
    assert [t for t, level in host.edges("scl_oe") if level][9:] == []
    assert await unread(host)


@directed("P006-EEP-01", "P006-BAD-13")
async def p006_a_device_that_stretches_and_one_that_is_busy(dut: Any) -> None:
    assert await (await booted(dut, image(SAVED), 120, stretch_us=3)).ask("n") == 4000
    chip = Chip(image(SAVED), write_us=6_000, busy_us=6_000)
    host = await Host.start(dut, address=120, chip=chip, boot=False)
    up = await host.boot()
    assert host.us(6_000 + 18_000) < up < host.us(60_000) and await host.ask("n") == 4000
