"""Acceptance checks of emergency stops, stalls, ports and bridges."""

from __future__ import annotations

from typing import Any

from .builds import directed
from .host import Host
from .moves import (
    DECAY,
    EXT1,
    EXT1_EN,
    EXT2,
    STALL,
    after_steps,
    cruise,
    is_stopped,
    move,
    ready,
    run,
    set_constant_speed,
    start,
    wait_stopped,
)

STOP = 5
"""Maximum number of cycles from an edge of EXT to the last step."""


async def stopped(host: Host, edge: int) -> bool:
    """Return whether the motor stops: no step is made more than STOP cycles after this edge."""
    return await is_stopped(host, host.us(5_000)) and not host.steps(edge + STOP + 1)


async def fall(host: Host, pin: str = "ext1") -> int:
    """Drive a pin low; return the edge."""
    await host.pins(**{pin: 0})
    return host.t - 1


@directed("P006-AC-22", "P006-EXT-02", "P006-EXT-03", "P006-CMD-23", "P006-CMD-27", "P006-EXT-08")
async def p006_ac_22(dut: Any) -> None:
    host = await ready(dut)
    assert await host.exchange("A5 FF 66 03 00 00 00 0D") == "A5 7A FF 03 00 00 00 21"
    await start(host, 10_000)
    await after_steps(host, 25)
    edge = await fall(host)
    assert await stopped(host, edge) and await host.status() == DECAY | EXT1
    assert await host.ask("s", 1) == 0
    assert await host.exchange("A5 FF 62 00 00 00 00 06") == "A5 7A FF 00 00 00 00 1E"
    assert await host.status() == DECAY
    await start(host, 1)
    await wait_stopped(host)
    assert len(host.steps()) == 1
    await host.pins(ext1=1)
    assert await is_stopped(host) and await host.status() == DECAY


@directed("P006-AC-23", "P006-EXT-04")
async def p006_ac_23(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(f=0)
    count = host.pick(300, 40)
    await start(host, count)
    await after_steps(host, 10)
    await host.pins(ext1=0, ext2=0)
    await wait_stopped(host)
    assert len(host.steps()) == count and await host.status() == DECAY
    await host.ok(f=3)
    assert await host.status() == DECAY


@directed("P006-AC-24", "P006-EXT-01", "P006-EXT-06", "P006-CMD-07", "P006-CMD-33")
async def p006_ac_24(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(J=3, f=2)
    assert not await host.out("ext1_pu") and not await host.out("ext2_pu")
    await host.pins(ext2=0)
    assert await host.status() == DECAY
    await host.pins(ext2=1)
    assert await host.status() == DECAY | EXT2
    assert await host.ask("l") == 0 and await host.status() == DECAY


@directed("P006-AC-30", "P006-CHP-02", "P006-CHP-03", "P006-CHP-05")
async def p006_ac_30(dut: Any) -> None:
    host = await ready(dut, levels={"sda_i": 0, "cmp_a": 1})
    clk = host.clk_hz // 1_000_000
    await host.pause(1_000 * clk)
    mark = host.t - 500 * clk
    rises = [t for t, level in host.edges("m11", mark) if level]
    falls = [t for t, level in host.edges("m11", rises[0]) if not level]
    gaps = {b - a for a, b in zip(rises, rises[1:], strict=False)}
    assert {b - a for a, b in zip(rises, falls, strict=False)} == {10 * clk} and gaps == {30 * clk}
    assert not host.edges("m10", mark)
    await host.pins(cmp_a=0)
    await host.pause(2_000)
    assert await host.out("m10") and not await host.out("m11")
    await host.pins(cmp_a=1)
    edge = host.t - 1
    await host.pause(99)
    await host.pins(cmp_a=0)
    await host.pause(30 * clk)
    (down, _), (up, _) = host.edges("m10", edge)
    assert down - edge <= 4 and up - down == 20 * clk and not host.edges("m11", edge)


async def to_cruise(host: Host, y: int) -> None:
    """Set the stall level (Z) to 256 and length (T) to 5, start the speed mode, and wait until the speed is
    constant.
    """
    await host.ok(Z=256, T=5, Y=y)
    if not host.literal:
        await set_constant_speed(host, 2900)
    await run(host)
    await cruise(host, 312.5 if host.literal else 345)
    # The S-curve is flat near its end, so the last intervals change only slowly.
    await host.ms(host.pick(20, 1))


async def samples(host: Host, *levels: int) -> None:
    """Apply samples of the back EMF, 20 us apart."""
    for level in levels:
        await host.strobe(bemf_level=level)
        await host.wait_us(20)


@directed(
    "P006-AC-31", "P006-STL-01", "P006-STL-02", "P006-STL-03", "P006-CMD-18", "P006-CMD-21", "P006-STA-03"
)
async def p006_ac_31(dut: Any) -> None:
    host = await ready(dut)
    await to_cruise(host, 3)
    await samples(host, *[100] * 4, 300, *[100] * 4)
    assert await host.busy()
    await host.strobe(bemf_level=100)
    edge = host.t
    assert await stopped(host, edge)
    assert await host.status() == DECAY | STALL
    assert await host.ask("X") == await host.position() == len(host.steps(0))
    assert not await host.out("gpo")
    await start(host, 1)
    assert not await host.status() & STALL
    await wait_stopped(host)


@directed("P006-AC-32", "P006-STL-03", "P006-STL-04", "P006-CMD-37", "P006-CMD-20")
async def p006_ac_32(dut: Any) -> None:
    host = await ready(dut)
    await to_cruise(host, 5)
    await samples(host, *[100] * 4, 300, *[100] * 5)
    assert await host.busy() and await host.out("gpo") == 0x10 and await host.ask("x") & 0x80
    assert await host.ask("p") == 0
    assert not await host.out("gpo") and await host.status() == DECAY | 1
    await host.ask("I")


@directed(
    "P006-AC-33", "P006-IO-01", "P006-IO-02", "P006-IO-04", "P006-CMD-45", "P006-CMD-46", "P006-PORT-03"
)
async def p006_ac_33(dut: Any) -> None:
    host = await ready(dut)
    await host.pins(gpi=0b10001)
    await host.ok(y=8)
    assert await host.ask("x") == 0xE09 and host.wire.hex(" ").upper() == "A5 7A FF 09 0E 00 00 35"
    assert await host.ask("y", 0xFF) == 0xF8 and host.wire.hex(" ").upper() == "A5 7A FF F8 00 00 00 16"
    assert await host.out("gpo") == 0b11111


@directed("P006-AC-34", "P006-CMD-24", "P006-CMD-30", "P006-MOT-05")
async def p006_ac_34(dut: Any) -> None:
    host = await ready(dut)
    assert await host.ask("i", 0x7FFFFFFF) == 0x7FFFFFFF
    await move(host, 1)
    assert await host.ask("c") == 0x80000000
    assert await host.ask("i", -5) == 0xFFFFFFFB and host.wire.hex(" ").upper() == "A5 7A FF FB FF FF FF 16"


@directed("P006-AC-55", "P006-EXT-07", "P006-BAD-26")
async def p006_ac_55(dut: Any) -> None:
    host = await ready(dut, levels={"sda_i": 0, "ext1": 0})
    assert await host.exchange("A5 FF 66 01 00 00 00 0B") == "A5 7A FF 01 00 00 00 1F"
    await host.ok(d=0)
    count = host.pick(300, 20)
    await move(host, count)
    assert await host.status() == DECAY and await host.position() == -count
    await host.pins(ext1=1)
    assert await is_stopped(host, host.us(1_000)) and await host.status() == DECAY
    await start(host, 10_000)
    await after_steps(host, 20)
    edge = await fall(host)
    assert await stopped(host, edge) and await host.status() == DECAY | EXT1


async def towards_the_switch(host: Host, count: int) -> int:
    """Run AC-56 up to its second instruction b, with the switch closed after `count` steps; return the number
    of steps made.
    """
    await set_constant_speed(host, 2500, f=1, d=0)
    assert (await host.exchange("A5 FF 73 FF FF FF 7F 93"))[
        9:20
    ] == f"{host.accepted(0x7FFFFFFF) & 255:02X}" + (" FF FF 7F" if host.echo else " 00 00 00")
    await after_steps(host, count)
    edge = await fall(host)
    assert await stopped(host, edge) and set(host.intervals()) == {400}
    steps = len(host.steps())
    assert await host.status() == DECAY | EXT1
    assert await host.ask("x") >> 10 == 0b10
    assert await host.ask("s", 10) == 0 and await host.ask("b") == 0 and await host.ask("b") == 0
    assert await host.status() == DECAY and await host.position() == -steps
    return steps


@directed("P006-AC-56", "P006-AC-57", "P006-STA-19", "P006-EXT-08", "P006-EXT-10", "P006-IO-04")
async def p006_ac_56_and_57(dut: Any) -> None:
    host = await ready(dut)
    await towards_the_switch(host, host.pick(1000, 30))
    await host.ok(d=1)
    count = host.pick(400, 40)
    await start(host, count)
    mark = host.mark
    await after_steps(host, count // 2)
    await host.pins(ext1=1)
    await wait_stopped(host)
    assert len(host.steps(mark)) == count and set(host.intervals(mark)) == {400}
    assert await host.status() == DECAY and await host.ask("x") >> 10 & 1
    await host.ok(i=0)
    assert await host.position() == 0


@directed("P006-AC-58", "P006-STA-17", "P006-EXT-08")
async def p006_ac_58(dut: Any) -> None:
    host = await ready(dut)
    await towards_the_switch(host, host.pick(1000, 20))
    count = host.pick(2000, 30)
    await start(host, count)
    mark = host.mark
    assert await host.ask("l") == 0 and await host.ask("b") == 0
    await wait_stopped(host)
    assert len(host.steps(mark)) == count and await host.status() == DECAY


@directed("P006-AC-64", "P006-EXT-04", "P006-STA-11")
async def p006_ac_64(dut: Any) -> None:
    host = await ready(dut)
    await host.ok(f=1)
    await start(host, 10_000)
    await after_steps(host, 10)
    edge = await fall(host)
    assert await stopped(host, edge)
    await host.ok(f=0)
    assert await host.ask("s", 1) == 0 and await host.ask("N", 1) == 0
    assert not await host.ask("O") & EXT1_EN and await host.status() & EXT1
    assert await host.ask("b") == 0 and await host.ask("s", 1) == host.accepted(1)
    await wait_stopped(host)
