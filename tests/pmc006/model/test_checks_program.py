"""PMC006 acceptance checks of EEPROM, boot, factory restore and program. Mostly played on the RTL, too."""

from __future__ import annotations

from cocotb_tests.harness.scripts import model_only
from cocotb_tests.harness.verifies import verifies
from cocotb_tests.pmc006.scenes import (
    DECAY,
    END,
    FACTORY_PAGE,
    OFFLINE,
    P1,
    WAIT_REST,
    Op,
    after_steps,
    brisk,
    cruise,
    device,
    download,
    image,
    load,
    out,
    page,
    ready,
    rest,
    rot,
    setup,
    start,
    still,
    with_eeprom,
    words,
)
from cocotb_tests.pmc006.script_host import Host

KEY_MS = 2
SAVED = page(a03=1, a04=4)


@verifies("P006-AC-35", "P006-EEP-10", "P006-CMD-41", "P006-EEP-01")
def test_ac_35() -> None:
    host = with_eeprom()
    assert host.ask("k") == 16 and host.ask("q") == 1000 and host.ask("n") == 800
    assert host.ask("w", 1) == 1 and host.ask("m", 4) == 4 and host.ask("t") == 1
    host.ms(20)
    assert host.eeprom is not None
    assert (
        host.eeprom.memory[:32]
        == host.eeprom.memory[0x360:0x380]
        == bytes.fromhex(
            "50 36 01 01 04 00 00 00 01 01 00 00 58 02 58 02 2C 01 E2 04 20 03" + " 00" * 9 + " 78"
        )
    )
    assert [write.address for write in host.eeprom.writes] == [0x360, 0]
    host.reset()
    host.boot()
    assert host.ask("k") == 4 and host.ask("n") == 800 and host.replied == 1


@verifies("P006-AC-36", "P006-BAD-14")
def test_ac_36() -> None:
    bad = bytearray(SAVED)
    bad[0x0D] ^= 0x04
    for copy, address, microsteps in ((SAVED, 1, 4), (bytes(bad), 0xFF, 16)):
        content = bytes(bad).ljust(0x360, b"\xff") + copy
        host = with_eeprom(content, address)
        assert host.ask("k") == microsteps and host.replied == address
        host.ms(10)
        assert host.eeprom is not None and not host.eeprom.writes
        assert host.eeprom.memory[: len(content)] == content


@verifies("P006-AC-37", "P006-EEP-20", "P006-EEP-21", "P006-EEP-22")
def test_ac_37() -> None:
    content = image(SAVED, P1)
    host = Host(eeprom=device(content, write_us=1_000), levels={"fset_n": 0}, boot=False)
    host.ms(30)
    host.pins(fset_n=1)
    host.boot()
    host.ms(10)
    assert host.ask("k") == 16 and host.replied == 0xFF
    assert host.eeprom is not None
    assert host.eeprom.memory[:32] == host.eeprom.memory[0x360:0x380] == FACTORY_PAGE
    assert host.eeprom.memory[32:0x343] == content[32:]


@verifies("P006-AC-38", "P006-EEP-20", "P006-EEP-21")
def test_ac_38() -> None:
    host = Host(address=1, eeprom=device(image(SAVED), write_us=1_000), levels={"fset_n": 0}, boot=False)
    host.ms(19)
    host.pins(fset_n=1)
    host.boot()
    assert host.ask("k") == 4
    host.pins(fset_n=0)
    host.ms(25)
    host.pins(fset_n=1)
    assert host.ask("k") == 4
    host.ms(10)
    assert host.eeprom is not None and host.eeprom.memory[:32] == FACTORY_PAGE
    host.reset()
    host.boot()
    host.address = 0xFF
    assert host.ask("k") == 16


@model_only("a second of motion; script_program has the same in short")
@verifies("P006-AC-39", "P006-PRG-02", "P006-PRG-12", "P006-PRG-20", "P006-CMD-47")
def test_ac_39() -> None:
    host = ready()
    load(host, *P1)
    mark = host.mark
    host.ms(200)
    assert host.ask("E") == 0 and host.ask("z") == 0
    host.until("gpo", 1)
    assert not host.busy
    steps = host.steps(mark)
    assert len(steps) == 600
    for first in range(0, 600, 200):
        group = steps[first : first + 200]
        assert host.in_us(group[-1] - group[0]) == 333_334 - 1667
        gaps = {host.in_us(b - a) for a, b in zip(group, group[1:], strict=False)}
        assert gaps == {1666, 1667}
    assert host.position() == 600 and host.out("gpo") == 1


@verifies("P006-AC-40", "P006-PRG-02", "P006-CMD-01", "P006-CMD-05", "P006-CMD-18")
def test_ac_40() -> None:
    host = ready()
    download(host, P1)
    assert [host.ask("G") for _ in range(20)] == words(P1)
    assert host.ask("A", 200) == 20


@verifies("P006-AC-41", "P006-EEP-11", "P006-PRG-11", "P006-CMD-02", "P006-CMD-04")
def test_ac_41() -> None:
    host = with_eeprom(write_us=500)
    download(host, P1)
    assert host.ask("B") == 1
    host.ms(host.pick(300, 45))
    host.ok(F=1)
    assert host.ask("t") == 1
    host.ms(20)
    host.reset()
    up = host.boot()
    host.until("mon_busy", 1, 1_000)
    assert host.t - up < host.us(1_000)
    assert host.ask("q") == 3200 and host.ask("O") & OFFLINE
    host.ok(F=0)
    assert host.ask("I") == 0 and host.ask("t") == 1
    host.ms(20)
    host.reset()
    host.boot()
    assert still(host) and not host.busy and host.ask("q") == 1000 and host.ask("G") == P1[0].words[0]


@verifies("P006-AC-42", "P006-PRG-30", "P006-PRG-31", "P006-PRG-32")
def test_ac_42() -> None:
    host = ready()
    brisk(host, 2000)
    load(host, Op(0x13, 1, 5), Op(0x14, 1), rot(100_000), WAIT_REST, END, out(1, 1), END)
    mark = host.mark
    after_steps(host, 10)
    host.pins(gpi=0b11101)
    host.ms(KEY_MS)
    host.pins(gpi=0b11111)
    host.ms(KEY_MS)
    assert host.busy
    host.pins(gpi=0b11110)
    edge = host.t - 1
    host.ms(KEY_MS)
    halt = host.edges("mon_busy", edge)[0][0]
    assert host.us(1_000) <= halt - edge <= host.us(1_002) + 8
    assert not host.steps(halt + 1) and len(host.steps(mark)) > 10
    host.pins(gpi=0b11111)
    edge = host.t - 1
    host.ms(KEY_MS)
    assert host.us(999) <= host.edges("gpo", edge)[0][0] - edge <= host.us(1_002) + 200
    assert host.out("gpo") == 1


@model_only("twelve seconds of motion; script_analog has the same in short")
@verifies("P006-AC-43", "P006-MOT-31", "P006-MOT-51", "P006-MOT-52")
def test_ac_43() -> None:
    host = ready()
    host.strobe(adc_data=512)
    load(host, Op(0x08, 1, 8000), rot(100_000), END)
    mark = host.mark
    cruise(host, 1_000_000 / 4007, 3_000_000)
    first = len(host.steps(mark))
    after_steps(host, first + 4007)
    steps = host.steps(mark)
    assert abs(host.in_us(steps[-1] - steps[first - 1]) - 1_000_000) <= 250
    host.strobe(adc_data=0)
    host.ms(1_000)
    assert still(host, host.us(100_000)) and host.busy
    host.strobe(adc_data=1023)
    cruise(host, 125, 3_000_000)
    rest(host, 20_000_000)
    assert len(host.steps(mark)) == 100_000


@verifies("P006-AC-44", "P006-CMD-21", "P006-CMD-47", "P006-PRG-12")
def test_ac_44() -> None:
    host = ready()
    assert host.swap("A5 FF 5A 00 01 00 00 FF") == "A5 7A FF 00 01 00 00 1F"
    assert host.swap("A5 FF 7A 00 00 00 00 1E") == "A5 7A FF 01 00 00 00 1F"
    assert still(host) and not host.busy
    assert host.ask("z") == 1


@verifies("P006-AC-65", "P006-PRG-14", "P006-PRG-31")
def test_ac_65() -> None:
    program = (Op(0x13, 1, 0), rot(100_000), END)
    for disarmed in (False, True):
        host = ready()
        if not host.literal:
            brisk(host, 2500)
        load(host, *program)
        after_steps(host, 10)
        if disarmed:
            host.ok(F=0)
        host.pins(gpi=0b11110)
        edge = host.t - 1
        host.ms(KEY_MS)
        host.pins(gpi=0b11111)
        host.ms(KEY_MS)
        if disarmed:
            assert host.busy and host.ask("I") == 0
        else:
            (halt, level), *more = host.edges("mon_busy", edge)
            assert not level and not more and host.us(1_000) <= halt - edge <= host.us(1_002) + 8
        assert not host.busy and still(host)


@verifies("P006-AC-66", "P006-EEP-11", "P006-BAD-15", "P006-BAD-24")
def test_ac_66() -> None:
    saved = page(a0B=1)
    host = with_eeprom(image(saved, P1), write_us=1_000)
    host.until("mon_busy", 1, 1_000)
    host.ok(F=0)
    assert host.ask("I") == 0
    assert host.ask("A", 0) == 0 and host.ask("W", 0) == 0 and host.ask("B") == 1
    assert host.eeprom is not None
    # The mark, then pages of the program: in the middle of the fourth write.
    while len(host.eeprom.writes) < 4:
        host.wait_us(500)
    host.pins(rst_n=0)
    host.ms(8)
    host.pins(rst_n=1)
    host.forget()
    host.boot()
    assert host.eeprom.memory[0x342] == 0 and host.eeprom.memory[:32] == saved
    assert still(host) and not host.busy and host.ask("O") & OFFLINE
    assert host.ask("A", 0) == 0
    count = host.pick(200, 24)
    assert not any(host.ask("G") for _ in range(count))
    assert host.status() == DECAY


@verifies("P006-AC-41", "P006-EEP-23")
def test_a_program_that_never_rests_blocks_nothing() -> None:
    """Autostart of JMP to itself: frames are served, F 0 and t end it for good."""
    host = with_eeprom(image(page(a0B=1), [Op(0x0D, 0, 0)]), write_us=500)
    assert host.ask("W", 5) == 0 and host.ask("z") == 0
    setup(host)
    host.ok(F=0)
    assert host.ask("t") == 1
    host.ms(20)
    host.reset()
    host.boot()
    assert host.ask("W", 5) == 5
    start(host, 1)
    rest(host)
