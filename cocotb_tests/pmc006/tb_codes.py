"""Every instruction code with data inside and outside its range, and the replies."""

from __future__ import annotations

from typing import Any, NamedTuple

import cocotb

from .builds import directed
from .frames import signed
from .host import EXECUTE, Host
from .moves import (
    DECAY,
    EXT1,
    FORWARD,
    OFFLINE,
    SPEED_MODE,
    after_steps,
    constant_speed_host,
    download,
    is_stopped,
    load,
    run,
    start,
    wait_stopped,
)
from .programs import END, Op, out, rot

BEYOND = (0x7FFFFFFF, -0x80000000, -1, 0x10000, 0x100)
"""Data that few registers accept, although the low bytes alone would be legal for many."""


class Row(NamedTuple):
    """One register: code, factory value, accepted data, rejected data, code that reads the register."""

    code: str
    factory: int
    good: tuple[int, ...]
    bad: tuple[int, ...]
    read: str | int = ""
    mask: int = 0
    shift: int = 0


REGISTERS = (
    Row("A", 0, (0, 1, 199), (200, *BEYOND)),
    Row("F", 0, (1, 0), (2, *BEYOND), "O", 0x20, 5),
    Row("J", 0, (3, 2, 1, 0), (4, *BEYOND), "K"),
    Row("L", 600, (65, 3000, 66), (0, 64, 3001, *BEYOND[:-1])),
    Row("M", 300, (100, 1200), (0, 99, 1201, *BEYOND[:-1])),
    Row("P", 1250, (300, 2000), (0, 299, 2001, *BEYOND)),
    Row("Q", 1, (4, 1, 3), (0, 5, *BEYOND), 0x55),
    Row("S", 600, (65, 3000, 2999), (0, 64, 3001, *BEYOND[:-1])),
    Row("T", 64, (0, 63, 5), (64, *BEYOND)),
    Row("Y", 0, (7, 0, 2), (8, *BEYOND)),
    Row("Z", 0, (511, 1, 256), (512, *BEYOND[:-1])),
    Row("a", 1, (0, 1), (2, *BEYOND), "j", 8, 3),
    Row("d", 1, (0, 1), (2, *BEYOND), "O", 16, 4),
    Row("e", 800, (400, 4000, 475), (399, 4001, 0, *BEYOND), "n"),
    Row("f", 0, (3, 1, 2), (4, *BEYOND), "O", 6, 1),
    Row("g", 0, (1, 0), (2, *BEYOND), "O", 1, 0),
    Row("i", 0, (0x7FFFFFFF, -0x80000000, -1, 0), (), "c"),
    Row("m", 16, (0, 2, 4, 8, 32, 64, 128, 16), (1, 3, 5, 127, 129, 256, *BEYOND), "k"),
    Row("o", 0, (5, 0, 3), (6, *BEYOND), "h"),
    Row("u", 0, (5, 0, 4), (6, *BEYOND), "r"),
    Row("v", 1000, (1, 16000, 256), (0, 16001, *BEYOND[:-1]), "q"),
)
IDS = tuple(f"P006-CMD-{n:02}" for n in (1, 4, 7, 8, 9, 10, 13, 14, 16, 17, 20, 21, 22, 25, 26, 27, 28, 29))
IDS += tuple(f"P006-CMD-{n:02}" for n in (30, 32, 34, 35, 36, 38, 39, 42, 43, 49, 50, 51, 56, 57))


@cocotb.parametrize(row=REGISTERS)
@directed(*IDS, "P006-BAD-08", "P006-BAD-09")
async def p006_register(dut: Any, row: Row) -> None:
    """Accepted data is returned in the reply. Rejected data does not change the register; the reply contains
    the value of the register.
    """
    host = await Host.start(dut)

    async def check_value(value: int) -> None:
        if row.read:
            got = await host.ask(row.read, -1)
            assert (got & row.mask) >> row.shift == value if row.mask else got == value

    await check_value(row.factory)
    value = row.factory
    for data in row.bad:
        assert await host.ask(row.code, data) == value, f"{row.code} {data}"
    for data in row.good:
        value = data & 0xFFFFFFFF
        assert await host.ask(row.code, data) == value, f"{row.code} {data}"
        await check_value(value)
    for data in row.bad[:3]:
        assert await host.ask(row.code, data) == value, f"{row.code} {data}"
    await check_value(value)


@directed("P006-CMD-48", "P006-BAD-07", "P006-FRM-03")
async def p006_unknown_codes(dut: Any) -> None:
    """Each undefined code has the same reply and no effect, also with data that would be legal for many
    codes.
    """
    known = {ord(letter) for letter in "ABEFGIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"}
    host = await Host.start(dut)
    unknown = [code for code in range(256) if code not in known]
    assert len(unknown) == 256 - 49
    for code in unknown[::7]:
        assert await host.ask(code, 1) == 0
    assert [await host.ask(code) for code in "jOxqkncK"] == [8, 16, 0xF07, 1000, 16, 800, 0, 0]
    assert not host.steps(0)


@directed("P006-CMD-15", "P006-CMD-12", "P006-CMD-31", "P006-CMD-45", "P006-CMD-19", "P006-CMD-57")
async def p006_reads_ignore_their_data(dut: Any) -> None:
    host = await Host.start(dut)
    for data in (0, -1):
        assert [await host.ask(code, data) for code in "ROjxXKcknqrh"] == [
            *(0x123, 0x10, 8, 0xF07, 0, 0, 0, 16, 800, 1000, 0, 0)
        ]
        assert await host.ask(0x55, data) == 1


@directed("P006-CMD-44", "P006-FRM-05", "P006-BAD-08")
async def p006_addresses(dut: Any) -> None:
    host = await Host.start(dut)
    for data in (0, 121, 122, 255, 256, 257, -1, 0x101):
        assert await host.ask("w", data) == 255
    for data in (1, 120, 64):
        assert await host.ask("w", data) == data and host.replied == data
        assert await host.status() == DECAY
    for data in (0x140, 0xFF, 0xFFFF, 0xFF00):
        assert await host.ask("w", data) == 64 and host.replied == 64


@directed("P006-CMD-46", "P006-IO-02", "P006-IO-03")
async def p006_outputs(dut: Any) -> None:
    host = await Host.start(dut)
    for data in (0x08, 0xF8, 0x07, -1, 0x150, 0xFFFFFF07, 0, 0xA8):
        assert await host.ask("y", data) == data & 0xF8
        assert await host.out("gpo") == (data & 0xF8) >> 3
    change = host.edges("gpo", host.frame_start)[0][0]
    assert host.e <= change <= host.e + EXECUTE


@directed("P006-CMD-23", "P006-CMD-33", "P006-CMD-37", "P006-CMD-06", "P006-STA-17", "P006-BAD-25")
async def p006_clearing_what_is_not_set(dut: Any) -> None:
    host = await Host.start(dut)
    for data in (0, 1, -1):
        assert [await host.ask(code, data) for code in "blpI"] == [0, 0, 0, data & 0xFFFFFFFF]
        assert await host.ask("N", 0) == 0
    assert await host.status() == DECAY and await host.ask("O") == FORWARD


@directed("P006-CMD-40", "P006-CMD-55", "P006-CMD-51", "P006-STA-01", "P006-BAD-10")
async def p006_step_command(dut: Any) -> None:
    host = await constant_speed_host(dut)
    for data in (0, -1, -0x80000000):
        assert await host.ask("s", data) == 0
    await start(host, 1)
    await wait_stopped(host)
    await start(host, 3)
    await wait_stopped(host)
    assert len(host.steps(0)) == 4
    await host.ok(v=2999)
    assert await host.ask("s", 5) == 0
    await host.ok(L=2999)
    assert await host.ask("s", 5) == 0
    await host.ok(S=2999)
    await start(host, 0x7FFFFFFF)
    assert await host.ask("s", 5) == 0 and await host.ask("I", 9) == 9
    await host.ok(f=1)
    await host.pins(ext1=0)
    assert await host.ask("s", 1) == 0 and await host.status() == DECAY | EXT1
    await host.ask("b")
    await host.ok(g=1)
    assert await host.ask("s", 1) == 0
    await host.ok(g=0)
    await start(host, 1)
    await wait_stopped(host)


@directed("P006-CMD-11", "P006-CMD-12", "P006-STA-02", "P006-STA-16", "P006-BAD-25")
async def p006_speed_mode(dut: Any) -> None:
    host = await constant_speed_host(dut)
    for data in (2, -1, 0x101, 0x7FFFFFFF):
        assert await host.ask("N", data) == 0 and not await host.busy()
    assert await host.ask("N", 0) == 0 and not await host.busy()
    await run(host)
    mark = host.mark
    assert await host.ask("O") & SPEED_MODE and await host.ask("N", 1) == 1 and await host.ask("N", 2) == 1
    assert await host.ask("s", 10) == 0 and await host.busy()
    assert await host.ask("N", 0) == 0 and not await host.ask("O") & SPEED_MODE
    await wait_stopped(host)
    assert set(host.intervals(mark)) <= {333, 334}
    # A move is not the speed mode: N 1 is rejected, and N 0 has no effect.
    await start(host, 40)
    mark = host.mark
    assert await host.ask("N", 1) == 0 and await host.ask("N", 0) == 0
    await wait_stopped(host)
    assert len(host.steps(mark)) == 40


@directed("P006-CMD-06", "P006-STA-10", "P006-STA-11")
async def p006_abort(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await start(host, 1000)
    await after_steps(host, 5)
    assert await host.ask("I", 0xBEEF) == 0xBEEF
    count = len(host.steps(0))
    assert not host.steps(host.e + EXECUTE + 6) and not await host.busy()
    assert await host.position() == count and await host.status() == DECAY
    await start(host, 2)
    await wait_stopped(host)
    assert await host.position() == count + 2


@directed("P006-CMD-01", "P006-CMD-05", "P006-CMD-18", "P006-PRG-02", "P006-BAD-11")
async def p006_program_words(dut: Any) -> None:
    host = await Host.start(dut)
    values = (0x12345678, 0xFFFFFFFF, 0, 0x80000001)
    assert await host.ask("A", 196) == 196
    for value in values:
        assert await host.ask("W", value) == value
    assert await host.ask("W", 7) == 0 and await host.ask("G") == 0
    assert await host.ask("A", 200) == 200 and await host.ask("A", -1) == 200
    assert await host.ask("A", 196) == 196
    assert [await host.ask("G") for _ in range(5)] == [*values, 0]
    assert await host.ask("A", 0) == 0 and await host.ask("G") == 0


@directed("P006-CMD-03", "P006-CMD-47", "P006-CMD-04", "P006-PRG-12", "P006-PRG-20", "P006-BAD-11")
async def p006_program_codes(dut: Any) -> None:
    host = await constant_speed_host(dut)
    await download(host, (out(1, 1), Op(0x0D, 0, 1)))
    assert await host.ask("E") == 1 and await host.out("gpo") == 1
    assert await host.ask("z", 99) == 1
    assert await host.ask("z") == 0
    assert await host.ask("E") == 0
    assert await host.ask("W", 5) == 0
    assert await host.ask("G") == 0x111
    assert await host.ask("A", 4) == 4 and await host.ask("F", 0) == 0
    assert await host.ask("W", 5) == 5 and await host.ask("A", 200) == 5
    assert await host.ask("z") == 1
    for _ in range(195):
        if await host.ask("A", 199) == 199:
            break
    assert await host.ask("G") == 0 and await host.ask("z") == 0 and await host.ask("E") == 0


@directed("P006-CMD-52", "P006-CMD-24", "P006-CMD-30", "P006-STA-15")
async def p006_position(dut: Any) -> None:
    host = await constant_speed_host(dut)
    for value in (5, -1, 0x7FFFFFFF, -0x80000000):
        await host.ok(i=value)
    await start(host, 60)
    await after_steps(host, 10)
    assert await host.ask("i", 1000) == 1000
    loaded = host.e
    await wait_stopped(host)
    left = 60 - sum(t <= loaded for t in host.steps(0))
    assert abs(await host.position() - 1000 - left) <= 1 and len(host.steps(0)) == 60
    await host.ok(g=1, i=-7)
    assert await host.position() == -7
    await host.ok(g=0, f=2)
    await host.pins(ext2=0)
    await host.ok(i=123)
    assert signed(await host.ask("c")) == 123


@directed("P006-CMD-54", "P006-CMD-34", "P006-CMD-25", "P006-STA-04")
async def p006_values_of_the_next_motion(dut: Any) -> None:
    """MSTEP, DIR, VSTART and VSTOP do not change during a motion; a short motion does not use VMAX."""
    host = await constant_speed_host(dut)
    await start(host, 60)
    mark = host.mark
    await host.ok(m=4, d=0, L=100, S=100, u=5, o=5, v=200)
    await wait_stopped(host)
    assert len(host.steps(mark)) == 60 and set(host.intervals(mark)) <= {333, 334}
    assert await host.out("mon_dir") == 1 and await host.position() == 60
    await start(host, 2)
    await wait_stopped(host)
    assert await host.out("mon_dir") == 0 and host.intervals() == [10_000] and await host.position() == 58


@directed("P006-CMD-04", "P006-CMD-12")
async def p006_offline_flag(dut: Any) -> None:
    host = await Host.start(dut)
    await host.ok(F=1)
    assert await host.ask("O") == FORWARD | OFFLINE and await is_stopped(host, 1_000)
    await load(host, rot(1), END)
    assert await host.ask("F", 0) == 0 and await host.ask("O") == FORWARD
