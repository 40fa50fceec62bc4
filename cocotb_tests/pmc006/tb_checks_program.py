"""PMC006 acceptance checks of EEPROM, boot, factory restore and program. Mostly played on the RTL, too."""

from __future__ import annotations

from typing import Any
from cocotb_tests.harness.directed import directed
from cocotb_tests.harness.scripts import model_only
from cocotb_tests.harness.verifies import verifies
from cocotb_tests.pmc006.moves import DECAY, OFFLINE, after_steps, brisk, cruise, download, load, ready, rest, setup, start, still
from cocotb_tests.pmc006.programs import END, FACTORY_PAGE, P1, WAIT_REST, Op, image, out, page, rot, words
from cocotb_tests.pmc006.memory import device, with_eeprom
from cocotb_tests.pmc006.host import Host

KEY_MS = 2
SAVED = page(a03=1, a04=4)


@directed("P006-AC-35", "P006-EEP-10", "P006-CMD-41", "P006-EEP-01")
async def p006_ac_35(dut: Any) -> None:
    host = await with_eeprom(dut)
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
        host = await with_eeprom(dut, content, address)
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
    host = await Host.start(dut, address=1, chip=Chip(image(SAVED), write_us=1_000), levels={"fset_n": 0}, boot=False)
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


@model_only("a second of motion; script_program has the same in short")
@directed("P006-AC-39", "P006-PRG-02", "P006-PRG-12", "P006-PRG-20", "P006-CMD-47")
async def p006_ac_39(dut: Any) -> None:
    host = await ready(dut)
    await load(host, *P1)
    mark = host.mark
    await host.ms(200)
    assert await host.ask("E") == 0 and await host.ask("z") == 0
    await host.until("gpo", 1)
    assert not await host.busy()
    steps = host.steps(mark)
    assert len(steps) == 600
    for first in range(0, 600, 200):
        group = steps[first : first + 200]
        assert host.in_us(group[-1] - group[0]) == 333_334 - 1667
        gaps = {host.in_us(b - a) for a, b in zip(group, group[1:], strict=False)}
        assert gaps == {1666, 1667}
    assert await host.position() == 600 and await host.out("gpo") == 1


@directed("P006-AC-40", "P006-PRG-02", "P006-CMD-01", "P006-CMD-05", "P006-CMD-18")
async def p006_ac_40(dut: Any) -> None:
    host = await ready(dut)
    await download(host, P1)
    assert [await host.ask("G") for _ in range(20)] == words(P1)
    assert await host.ask("A", 200) == 20


@directed("P006-AC-41", "P006-EEP-11", "P006-PRG-11", "P006-CMD-02", "P006-CMD-04")
async def p006_ac_41(dut: Any) -> None:
    host = await Host.start(dut, chip=Chip(write_us=500)
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
    assert await still(host) and not await host.busy() and await host.ask("q") == 1000 and await host.ask("G") == P1[0].words[0]


@directed("P006-AC-42", "P006-PRG-30", "P006-PRG-31", "P006-PRG-32")
async def p006_ac_42(dut: Any) -> None:
    host = await ready(dut)
    await brisk(host, 2000)
    await load(host, Op(0x13, 1, 5), Op(0x14, 1), rot(100_000), WAIT_REST, END, out(1, 1), END)
    mark = host.mark
    await after_steps(host, 10)
    await host.pins(gpi=0b11101)
    await host.ms(KEY_MS)
    await host.pins(gpi=0b11111)
    await host.ms(KEY_MS)
    assert await host.busy()
    await host.pins(gpi=0b11110)
    edge = host.t - 1
    await host.ms(KEY_MS)
    halt = host.edges("mon_busy", edge)[0][0]
    assert host.us(1_000) <= halt - edge <= host.us(1_002) + 8
    assert not host.steps(halt + 1) and len(host.steps(mark)) > 10
    await host.pins(gpi=0b11111)
    edge = host.t - 1
    await host.ms(KEY_MS)
    assert host.us(999) <= host.edges("gpo", edge)[0][0] - edge <= host.us(1_002) + 200
    assert await host.out("gpo") == 1


@model_only("twelve seconds of motion; script_analog has the same in short")
@directed("P006-AC-43", "P006-MOT-31", "P006-MOT-51", "P006-MOT-52")
async def p006_ac_43(dut: Any) -> None:
    host = await ready(dut)
    await host.strobe(adc_data=512)
    await load(host, Op(0x08, 1, 8000), rot(100_000), END)
    mark = host.mark
    await cruise(host, 1_000_000 / 4007, 3_000_000)
    first = len(host.steps(mark))
    await after_steps(host, first + 4007)
    steps = host.steps(mark)
    assert abs(host.in_us(steps[-1] - steps[first - 1]) - 1_000_000) <= 250
    await host.strobe(adc_data=0)
    await host.ms(1_000)
    assert await still(host, host.us(100_000)) and await host.busy()
    await host.strobe(adc_data=1023)
    await cruise(host, 125, 3_000_000)
    await rest(host, 20_000_000)
    assert len(host.steps(mark)) == 100_000


@directed("P006-AC-44", "P006-CMD-21", "P006-CMD-47", "P006-PRG-12")
async def p006_ac_44(dut: Any) -> None:
    host = await ready(dut)
    assert await host.swap("A5 FF 5A 00 01 00 00 FF") == "A5 7A FF 00 01 00 00 1F"
    assert await host.swap("A5 FF 7A 00 00 00 00 1E") == "A5 7A FF 01 00 00 00 1F"
    assert await still(host) and not await host.busy()
    assert await host.ask("z") == 1


@directed("P006-AC-65", "P006-PRG-14", "P006-PRG-31")
async def p006_ac_65(dut: Any) -> None:
    program = (Op(0x13, 1, 0), rot(100_000), END)
    for disarmed in (False, True):
        host = await ready(dut)
        if not host.literal:
            await brisk(host, 2500)
        await load(host, *program)
        await after_steps(host, 10)
        if disarmed:
            await host.ok(F=0)
        await host.pins(gpi=0b11110)
        edge = host.t - 1
        await host.ms(KEY_MS)
        await host.pins(gpi=0b11111)
        await host.ms(KEY_MS)
        if disarmed:
            assert await host.busy() and await host.ask("I") == 0
        else:
            (halt, level), *more = host.edges("mon_busy", edge)
            assert not level and not more and host.us(1_000) <= halt - edge <= host.us(1_002) + 8
        assert not await host.busy() and await still(host)


@directed("P006-AC-66", "P006-EEP-11", "P006-BAD-15", "P006-BAD-24")
async def p006_ac_66(dut: Any) -> None:
    saved = page(a0B=1)
    host = await with_eeprom(dut, image(saved, P1), write_us=1_000)
    await host.until("mon_busy", 1, 1_000)
    await host.ok(F=0)
    assert await host.ask("I") == 0
    assert await host.ask("A", 0) == 0 and await host.ask("W", 0) == 0 and await host.ask("B") == 1
    # The mark, then pages of the program: in the middle of the fourth write.
    while len(host.eeprom.writes) < 4:
        await host.wait_us(500)
    await host.pins(rst_n=0)
    await host.ms(8)
    await host.pins(rst_n=1)
    await host.forget()
    await host.boot()
    assert host.eeprom.memory[0x342] == 0 and host.eeprom.memory[:32] == saved
    assert await still(host) and not await host.busy() and await host.ask("O") & OFFLINE
    assert await host.ask("A", 0) == 0
    count = host.pick(200, 24)
    assert not any([await host.ask("G") for _ in range(count)])
    assert await host.status() == DECAY


@directed("P006-AC-41", "P006-EEP-23")
async def p006_a_program_that_never_rests_blocks_nothing(dut: Any) -> None:
    """Autostart of JMP to itself: frames are served, F 0 and t end it for good."""
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
    await rest(host)
