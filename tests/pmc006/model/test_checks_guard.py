"""PMC006 acceptance checks of emergency stops, stalls, ports and bridges. Also played on the RTL."""

from __future__ import annotations

from cocotb_tests.harness.scripts import model_only
from cocotb_tests.harness.verifies import verifies
from cocotb_tests.pmc006.scenes import (
    DECAY,
    EXT1,
    EXT1_EN,
    EXT2,
    STALL,
    after_steps,
    brisk,
    cruise,
    move,
    ready,
    rest,
    run,
    start,
    still,
)
from cocotb_tests.pmc006.script_host import Host

STOP = 5
"""clk from an edge of EXT to no further step."""


def stopped(host: Host, edge: int) -> bool:
    """Whether no step came later than 5 clk after this edge, and none comes."""
    return still(host, host.us(5_000)) and not host.steps(edge + STOP + 1)


def fall(host: Host, pin: str = "ext1") -> int:
    """A pin goes low; returns the edge."""
    host.pins(**{pin: 0})
    return host.t - 1


@verifies("P006-AC-22", "P006-EXT-02", "P006-EXT-03", "P006-CMD-23", "P006-CMD-27", "P006-EXT-08")
def test_ac_22() -> None:
    host = ready()
    assert host.swap("A5 FF 66 03 00 00 00 0D") == "A5 7A FF 03 00 00 00 21"
    start(host, 10_000)
    after_steps(host, 25)
    edge = fall(host)
    assert stopped(host, edge) and host.status() == DECAY | EXT1
    assert host.ask("s", 1) == 0
    assert host.swap("A5 FF 62 00 00 00 00 06") == "A5 7A FF 00 00 00 00 1E"
    assert host.status() == DECAY
    start(host, 1)
    rest(host)
    assert len(host.steps()) == 1
    host.pins(ext1=1)
    assert still(host) and host.status() == DECAY


@verifies("P006-AC-23", "P006-EXT-04")
def test_ac_23() -> None:
    host = ready()
    host.ok(f=0)
    count = host.pick(300, 40)
    start(host, count)
    after_steps(host, 10)
    host.pins(ext1=0, ext2=0)
    rest(host)
    assert len(host.steps()) == count and host.status() == DECAY
    host.ok(f=3)
    assert host.status() == DECAY


@verifies("P006-AC-24", "P006-EXT-01", "P006-EXT-06", "P006-CMD-07", "P006-CMD-33")
def test_ac_24() -> None:
    host = ready()
    host.ok(J=3, f=2)
    assert not host.out("ext1_pu") and not host.out("ext2_pu")
    host.pins(ext2=0)
    assert host.status() == DECAY
    host.pins(ext2=1)
    assert host.status() == DECAY | EXT2
    assert host.ask("l") == 0 and host.status() == DECAY


@verifies("P006-AC-30", "P006-CHP-02", "P006-CHP-03", "P006-CHP-05")
def test_ac_30() -> None:
    host = ready(levels={"sda_i": 0, "cmp_a": 1})
    clk = host.clk_hz // 1_000_000
    host.pause(1_000 * clk)
    mark = host.t - 500 * clk
    rises = [t for t, level in host.edges("m11", mark) if level]
    falls = [t for t, level in host.edges("m11", rises[0]) if not level]
    gaps = {b - a for a, b in zip(rises, rises[1:], strict=False)}
    assert {b - a for a, b in zip(rises, falls, strict=False)} == {10 * clk} and gaps == {30 * clk}
    assert not host.edges("m10", mark)
    host.pins(cmp_a=0)
    host.pause(2_000)
    assert host.out("m10") and not host.out("m11")
    host.pins(cmp_a=1)
    edge = host.t - 1
    host.pause(99)
    host.pins(cmp_a=0)
    host.pause(30 * clk)
    (down, _), (up, _) = host.edges("m10", edge)
    assert down - edge <= 4 and up - down == 20 * clk and not host.edges("m11", edge)


def to_cruise(host: Host, y: int) -> None:
    """Z 256, T 5, N 1, until the speed is constant."""
    host.ok(Z=256, T=5, Y=y)
    if not host.literal:
        brisk(host, 2900)
    run(host)
    cruise(host, 312.5 if host.literal else 345)
    # The end of an S-curve is flat.
    host.ms(host.pick(20, 1))


def samples(host: Host, *levels: int) -> None:
    """Strobes of the BEMF, 20 us apart."""
    for level in levels:
        host.strobe(bemf_level=level)
        host.wait_us(20)


@verifies(
    "P006-AC-31", "P006-STL-01", "P006-STL-02", "P006-STL-03", "P006-CMD-18", "P006-CMD-21", "P006-STA-03"
)
def test_ac_31() -> None:
    host = ready()
    to_cruise(host, 3)
    samples(host, *[100] * 4, 300, *[100] * 4)
    assert host.busy
    host.strobe(bemf_level=100)
    edge = host.t
    assert stopped(host, edge)
    assert host.status() == DECAY | STALL and host.ask("X") == host.position() == len(host.steps(0))
    assert not host.out("gpo")
    start(host, 1)
    assert not host.status() & STALL
    rest(host)


@verifies("P006-AC-32", "P006-STL-03", "P006-STL-04", "P006-CMD-37", "P006-CMD-20")
def test_ac_32() -> None:
    host = ready()
    to_cruise(host, 5)
    samples(host, *[100] * 4, 300, *[100] * 5)
    assert host.busy and host.out("gpo") == 0x10 and host.ask("x") & 0x80
    assert host.ask("p") == 0
    assert not host.out("gpo") and host.status() == DECAY | 1
    host.ask("I")


@verifies(
    "P006-AC-33", "P006-IO-01", "P006-IO-02", "P006-IO-04", "P006-CMD-45", "P006-CMD-46", "P006-PORT-03"
)
def test_ac_33() -> None:
    host = ready()
    host.pins(gpi=0b10001)
    host.ok(y=8)
    assert host.ask("x") == 0xE09 and host.wire.hex(" ").upper() == "A5 7A FF 09 0E 00 00 35"
    assert host.ask("y", 0xFF) == 0xF8 and host.wire.hex(" ").upper() == "A5 7A FF F8 00 00 00 16"
    assert host.out("gpo") == 0b11111


@verifies("P006-AC-34", "P006-CMD-24", "P006-CMD-30", "P006-MOT-05")
def test_ac_34() -> None:
    host = ready()
    assert host.ask("i", 0x7FFFFFFF) == 0x7FFFFFFF
    move(host, 1)
    assert host.ask("c") == 0x80000000
    assert host.ask("i", -5) == 0xFFFFFFFB and host.wire.hex(" ").upper() == "A5 7A FF FB FF FF FF 16"


@verifies("P006-AC-55", "P006-EXT-07", "P006-BAD-26")
def test_ac_55() -> None:
    host = ready(levels={"sda_i": 0, "ext1": 0})
    assert host.swap("A5 FF 66 01 00 00 00 0B") == "A5 7A FF 01 00 00 00 1F"
    host.ok(d=0)
    count = host.pick(300, 20)
    move(host, count)
    assert host.status() == DECAY and host.position() == -count
    host.pins(ext1=1)
    assert still(host, host.us(1_000)) and host.status() == DECAY
    start(host, 10_000)
    after_steps(host, 20)
    edge = fall(host)
    assert stopped(host, edge) and host.status() == DECAY | EXT1


def towards_the_switch(host: Host, count: int) -> int:
    """AC-56 up to the second b; returns the steps made."""
    brisk(host, 2500, f=1, d=0)
    assert host.swap("A5 FF 73 FF FF FF 7F 93")[9:20] == f"{host.accepted(0x7FFFFFFF) & 255:02X}" + (
        " FF FF 7F" if host.echo else " 00 00 00"
    )
    after_steps(host, count)
    edge = fall(host)
    assert stopped(host, edge) and set(host.intervals()) == {400}
    steps = len(host.steps())
    assert host.status() == DECAY | EXT1
    assert host.ask("x") >> 10 == 0b10
    assert host.ask("s", 10) == 0 and host.ask("b") == 0 and host.ask("b") == 0
    assert host.status() == DECAY and host.position() == -steps
    return steps


@verifies("P006-AC-56", "P006-AC-57", "P006-STA-19", "P006-EXT-08", "P006-EXT-10", "P006-IO-04")
def test_ac_56_and_57() -> None:
    host = ready()
    towards_the_switch(host, host.pick(1000, 30))
    host.ok(d=1)
    count = host.pick(400, 40)
    start(host, count)
    mark = host.mark
    after_steps(host, count // 2)
    host.pins(ext1=1)
    rest(host)
    assert len(host.steps(mark)) == count and set(host.intervals(mark)) == {400}
    assert host.status() == DECAY and host.ask("x") >> 10 & 1
    host.ok(i=0)
    assert host.position() == 0


@verifies("P006-AC-58", "P006-STA-17", "P006-EXT-08")
def test_ac_58() -> None:
    host = ready()
    towards_the_switch(host, host.pick(1000, 20))
    count = host.pick(2000, 30)
    start(host, count)
    mark = host.mark
    assert host.ask("l") == 0 and host.ask("b") == 0
    rest(host)
    assert len(host.steps(mark)) == count and host.status() == DECAY


@verifies("P006-AC-64", "P006-EXT-04", "P006-STA-11")
def test_ac_64() -> None:
    host = ready()
    host.ok(f=1)
    start(host, 10_000)
    after_steps(host, 10)
    edge = fall(host)
    assert stopped(host, edge)
    host.ok(f=0)
    assert host.ask("s", 1) == 0 and host.ask("N", 1) == 0
    assert not host.ask("O") & EXT1_EN and host.status() & EXT1
    assert host.ask("b") == 0 and host.ask("s", 1) == host.accepted(1)
    rest(host)


@model_only("pwm_x_ref is not on the tapes; p006_streams has the same on the RTL")
@verifies("P006-AC-29", "P006-EXC-40")
def test_ac_29() -> None:
    host = ready()
    host.ok(a=0)
    for current in (400, 1000, 4000):
        host.ok(e=current)
        host.pause(300)
        for phase, ref in (("a", host.out("phase_a_ref")), ("b", host.out("phase_b_ref"))):
            start_at = host.t
            ones = 0
            for t in range(start_at, start_at + 256):
                host.model.run_until(t)
                ones += host.model.drive.level(t, phase)
            assert ones == ref
            host.t = start_at + 256
