"""Acceptance checks of a part with an EEPROM: save, restore, and storage of a program.

Instructions are named by their letters; a number after the letter is the data.
"""

from __future__ import annotations

from typing import Any

from .builds import directed
from .chip import Chip
from .host import Host
from .moves import (
    DECAY,
    OFFLINE,
    download,
    is_stopped,
    setup,
    start,
    wait_stopped,
)
from .programs import FACTORY_PAGE, P1, Op, image, page

KEY_MS = 2
SAVED = page(a03=1, a04=4)


@directed("P006-AC-35", "P006-EEP-10", "P006-CMD-41", "P006-EEP-01")
async def p006_ac_35(dut: Any) -> None:
    host = await Host.start(dut, chip=Chip())
    assert await host.ask("k") == 16 and await host.ask("q") == 1000 and await host.ask("n") == 800
    assert await host.ask("w", 1) == 1 and await host.ask("m", 4) == 4 and await host.ask("t") == 1
    await host.ms(20)
    assert (
        host.eeprom.memory[:32]
        == host.eeprom.memory[0x360:0x380]
        == bytes.fromhex(
            "50 36 01 01 04 00 00 00 01 01 00 00 58 02 58 02 2C 01 E2 04 20 03" + " 00" * 9 + " 78"
        )
    )
    assert [write.address for write in host.eeprom.writes] == [0x360, 0]
    await host.reset()
    await host.boot()
    assert await host.ask("k") == 4 and await host.ask("n") == 800 and host.replied == 1


@directed("P006-AC-36", "P006-BAD-14")
async def p006_ac_36(dut: Any) -> None:
    bad = bytearray(SAVED)
    bad[0x0D] ^= 0x04
    for copy, address, microsteps in ((SAVED, 1, 4), (bytes(bad), 0xFF, 16)):
        content = bytes(bad).ljust(0x360, b"\xff") + copy
        host = await Host.start(dut, address=address, chip=Chip(content))
        assert await host.ask("k") == microsteps and host.replied == address
        await host.ms(10)
        assert not host.eeprom.writes
        assert host.eeprom.memory[: len(content)] == content


@directed("P006-AC-37", "P006-EEP-20", "P006-EEP-21", "P006-EEP-22")
async def p006_ac_37(dut: Any) -> None:
    content = image(SAVED, P1)
    host = await Host.start(dut, chip=Chip(content, write_us=1_000), levels={"fset_n": 0}, boot=False)
    await host.ms(30)
    await host.pins(fset_n=1)
    await host.boot()
    await host.ms(10)
    assert await host.ask("k") == 16 and host.replied == 0xFF
    assert host.eeprom.memory[:32] == host.eeprom.memory[0x360:0x380] == FACTORY_PAGE
    assert host.eeprom.memory[32:0x343] == content[32:]


@directed("P006-AC-38", "P006-EEP-20", "P006-EEP-21")
async def p006_ac_38(dut: Any) -> None:
    host = await Host.start(
        dut, address=1, chip=Chip(image(SAVED), write_us=1_000), levels={"fset_n": 0}, boot=False
    )
    await host.ms(19)
    await host.pins(fset_n=1)
    await host.boot()
    assert await host.ask("k") == 4
    await host.pins(fset_n=0)
    await host.ms(25)
    await host.pins(fset_n=1)
    assert await host.ask("k") == 4
    await host.ms(10)
    assert host.eeprom.memory[:32] == FACTORY_PAGE
    await host.reset()
    await host.boot()
    host.address = 0xFF
    assert await host.ask("k") == 16


@directed("P006-AC-41", "P006-EEP-11", "P006-PRG-11", "P006-CMD-02", "P006-CMD-04")
async def p006_ac_41(dut: Any) -> None:
    host = await Host.start(dut, chip=Chip(write_us=500))
    await download(host, P1)
    assert await host.ask("B") == 1
    await host.ms(host.pick(300, 45))
    await host.ok(F=1)
    assert await host.ask("t") == 1
    await host.ms(20)
    await host.reset()
    up = await host.boot()
    await host.until("mon_busy", 1, 1_000)
    assert host.t - up < host.us(1_000)
    assert await host.ask("q") == 3200 and await host.ask("O") & OFFLINE
    await host.ok(F=0)
    assert await host.ask("I") == 0 and await host.ask("t") == 1
    await host.ms(20)
    await host.reset()
    await host.boot()
    assert await is_stopped(host)
    assert not await host.busy()
    assert await host.ask("q") == 1000
    assert await host.ask("G") == P1[0].words[0]


@directed("P006-AC-66", "P006-EEP-11", "P006-BAD-15", "P006-BAD-24")
async def p006_ac_66(dut: Any) -> None:
    saved = page(a0B=1)
    host = await Host.start(dut, chip=Chip(image(saved, P1), write_us=1_000))
    await host.until("mon_busy", 1, 1_000)
    await host.ok(F=0)
    assert await host.ask("I") == 0
    assert await host.ask("A", 0) == 0 and await host.ask("W", 0) == 0 and await host.ask("B") == 1
    # The part writes 0 to the mark, then pages of the program (P006-EEP-11). The reset occurs during the
    # fourth write.
    while len(host.eeprom.writes) < 4:
        await host.wait_us(500)
    await host.pins(rst_n=0)
    await host.ms(8)
    await host.pins(rst_n=1)
    await host.ignore_replies()
    await host.boot()
    assert host.eeprom.memory[0x342] == 0 and host.eeprom.memory[:32] == saved
    assert await is_stopped(host) and not await host.busy() and await host.ask("O") & OFFLINE
    assert await host.ask("A", 0) == 0
    count = host.pick(200, 24)
    assert not any([await host.ask("G") for _ in range(count)])
    assert await host.status() == DECAY


@directed("P006-AC-41", "P006-EEP-23")
async def p006_a_program_that_never_rests_blocks_nothing(dut: Any) -> None:
    """If a program that jumps to itself has started automatically, the part still answers frames. F 0 and
    then t (save) end the program permanently.
    """
    host = await Host.start(dut, chip=Chip(image(page(a0B=1), [Op(0x0D, 0, 0)]), write_us=500))
    assert await host.ask("W", 5) == 0 and await host.ask("z") == 0
    await setup(host)
    await host.ok(F=0)
    assert await host.ask("t") == 1
    await host.ms(20)
    await host.reset()
    await host.boot()
    assert await host.ask("W", 5) == 5
    await start(host, 1)
    await wait_stopped(host)
