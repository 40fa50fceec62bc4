"""Contract of ppmc_spi (docs/bank/spi.md)."""

from __future__ import annotations

import random
from typing import Any

import cocotb

from ..harness import Block, BlockDriver, rng, same
from ..harness.collect import exact
from ..harness.jitter import jitters
from .spi_host import (
    COUNT,
    CUT,
    FAST,
    INT,
    NEXT,
    NEXT_AXIS,
    REFUSED,
    SIGN,
    WRITE,
    Pace,
    PageReference,
    SpiHost,
    bits_of,
    header,
)

BLOCKS = {
    "spi": Block(
        "ppmc_spi",
        "sck_i mosi_i cs_ni miso_o miso_oe_o active_o cs_no rd_no wr_no a_o:10 d_o:8 d_i:8 int_ni",
        {"AddrBits": 10},
    ),
}
LEGAL = Pace()
"""The default times: a period of sck is 8 cycles."""


async def start(dut: Any) -> tuple[SpiHost, PageReference]:
    """Return the host and the reference model of a block that was reset."""
    host = SpiHost(BlockDriver(dut, "spi", BLOCKS), dut, "spi")
    await host.reset()
    return host, PageReference()


async def check(
    host: SpiHost, book: PageReference, bits: list[int], pace: Pace = LEGAL, what: str = ""
) -> None:
    """Send one frame and compare it with the reference model."""
    want = book.frame(bits)
    same(f"{what} {bits} at {pace}: miso", await host.frame(bits, pace), want)
    await host.wait(16)
    same(f"{what} {bits} at {pace}: accesses", host.slave.accesses()[-40:], book.accesses[-40:])


def any_pace(rand: random.Random) -> Pace:
    """Return random legal times, which include the shortest ones.

    A time that is not a multiple of a cycle has one sample more or less, depending on its phase. With
    JITTER=1, a sample may be late at any phase, so each time is one cycle longer.
    """
    more = int(jitters())
    low = rand.choice((3.01, 4.0, rand.uniform(3.01, 9)))
    high = rand.choice((1.01, 4.0, rand.uniform(1.01, 9)))
    lead, gap = max(low, 3.01) + rand.uniform(0, 5), rand.uniform(2.01, 9)
    return Pace(low + more, high + more, lead + 2 * more, gap + more, rand.randrange(2))


def any_word(rand: random.Random) -> int:
    """Return a random header; one in eight is invalid."""
    step = rand.choice((0, NEXT, NEXT_AXIS, NEXT | NEXT_AXIS))
    word = rand.choice((0, WRITE)) | step | rand.randrange(COUNT)
    return word | (rand.randrange(1, 8) << 10 if rand.random() < 0.12 else 0)


@cocotb.test()
async def spi_random_frames(dut):
    """For random frames, including truncated ones, with legal times, the accesses, miso and the flags are as
    in docs/bank/spi.md.
    """
    rand = rng()
    host, book = await start(dut)
    for _ in range(150):
        book.level = rand.randrange(2)
        host.unit.put(int_ni=1 - book.level)
        await host.wait(rand.uniform(4, 12))
        data = [rand.choice((0xFF, 0xFF, 0x00, rand.getrandbits(8))) for _ in range(rand.randrange(6))]
        bits = bits_of(*header(any_word(rand)), *data)
        if rand.random() < 0.25:
            bits = bits[: rand.randrange(len(bits))]
        await check(host, book, bits, any_pace(rand))
    kinds = [kind for kind, _, _ in book.accesses]
    assert min(kinds.count("r"), kinds.count("w")) > 50, f"only {len(kinds)} accesses"


@cocotb.test()
async def spi_frames_close_together(dut):
    """If cs_n is high for only 2 cycles between frames (3 with JITTER=1), each flag is still reported, also
    after truncated and rejected frames.
    """
    rand = rng()
    host, book = await start(dut)
    for _ in range(120):
        bits = bits_of(*header(any_word(rand)), 0xFF, 0x00)
        bits = bits[: rand.choice((0, 3, 7, 8, 9, 16, 17, 24, 32))]
        want = book.frame(bits)
        same(f"{bits}", await host.frame(bits, Pace(gap=2.01 + jitters())), want)
    await host.wait(16)
    same("accesses", host.slave.accesses(), book.accesses)


@cocotb.test()
async def spi_cut_everywhere(dut):
    """If a frame is truncated after any bit, no incomplete byte is written, and the next frame works."""
    host, book = await start(dut)
    for word, data in ((WRITE | NEXT | 0x2A4, (0x5A, 0xC3, 0x81)), (NEXT | 0x2A4, (0x80, 0x80, 0x00))):
        bits = bits_of(*header(word), *data)
        for length in range(len(bits) + 1):
            before = len(book.accesses)
            await check(host, book, bits[:length], what=f"cut behind {length}")
            whole = max(0, length - 16) // 8 if word & WRITE else (length > 16) + (length > 24)
            same(f"accesses of {length} bits", len(book.accesses) - before, whole)
            want = SIGN | CUT * bool(length % 8 or length == 8)
            same(f"status behind {length} bits", (await host.talk(*header(0)))[0], want)
            book.frame(bits_of(*header(0)))
            await check(host, book, bits_of(*header(0x2A4), 0xFF, 0x00), what="next")


@cocotb.test()
async def spi_bursts(dut):
    """In bursts at one address, by register, by axis and beyond the end, each access has the correct
    address.
    """
    host, book = await start(dut)
    for step in (0, NEXT, NEXT_AXIS, NEXT | NEXT_AXIS):
        for address in (0x3FE, 0x3F8, 0x014, 0x000):
            await check(host, book, bits_of(*header(WRITE | step | address), 1, 2, 3, 4))
            await check(host, book, bits_of(*header(step | address), *[0xFF] * 4, 0x00))
            await check(host, book, bits_of(*header(step | address), 0x80, 0x7F, 0x80, 0x00))
    same("first of a burst by axis at 3F8", [a for _, a, _ in book.accesses if a in (0x3F8, 0x008)][0], 0x3F8)


@exact("a low time of 2 cycles must be sampled as 2 cycles")
@cocotb.test()
async def spi_fastest(dut):
    """The fastest legal sck works at all phases to clk; a slightly faster sck sets a flag in the next
    status.
    """
    for step in range(0, 16):
        host, book = await start(dut)
        await host.wait(step / 16)
        for pace in (LEGAL, Pace(3.5, 3.5), Pace(3.0625, 3.0), Pace(3.0625, 1.0625, lead=4)):
            for word, data in ((WRITE | NEXT | 7, (0xA5, 0x3C)), (NEXT | 7, (0xFF, 0xFF, 0x00))):
                await check(host, book, bits_of(*header(word), *data), pace)
        # With low times of 2 cycles, mosi is sampled correctly, but miso is late, as the first bits prove.
        bits = bits_of(*header(WRITE | 0x155), 0x77)
        book.frame(bits)
        seen = await host.frame(bits, Pace(2, 2, lead=6))
        if step:  # not at phase 0, where miso changes just before the host samples it
            same(f"phase {step}/16: first bits", seen[:4], [1, 1, 0, 0])
        await host.wait(16)
        same("accesses", host.slave.accesses(), book.accesses)
        same("flag", (await host.talk(*header(0)))[0], SIGN | FAST)
        same("gone", (await host.talk(*header(0)))[0], SIGN)


@exact("a low time of 2 cycles must be sampled as 2 cycles")
@cocotb.test()
async def spi_one_short_low_time(dut):
    """If one low time of sck is too short, at any bit, the next frame reports it, and later frames do not."""
    host, book = await start(dut)
    for short in range(1, 32):
        await host.frame(bits_of(*header(0), 0, 0), short=short)
        for flags in (FAST, 0):
            same(f"status behind bit {short}", (await host.talk(*header(0)))[0], SIGN | flags)
    same("accesses", host.slave.accesses(), book.accesses)


@cocotb.test()
async def spi_lines_that_stand_still(dut):
    """If mosi is constantly 0 or 1, or sck has edges while cs_n is high, no access occurs."""
    host, _ = await start(dut)
    same("all 0", await host.talk(0, 0, 0, 0), [SIGN, 0, 0, 0])
    same("all 1", await host.talk(0xFF, 0xFF, 0xFF, 0xFF), [SIGN, 0, 0, 0])
    same("refused", await host.talk(0, 0), [SIGN | REFUSED, 0])
    host.unit.put(int_ni=0)
    same("interrupt", await host.talk(0, 0), [SIGN | INT, 0])
    host.unit.put(cs_ni=1, mosi_i=1)
    await host.wait(4)
    for _ in range(40):
        for level in (1, 0):
            host.unit.put(sck_i=level)
            await host.wait(4)
            same("not addressed: miso driven", host.unit.get("miso_oe_o"), 0)
    same("another one was addressed", await host.talk(0, 0), [SIGN | INT, 0])
    same("accesses", host.slave.accesses(), [])


@cocotb.test()
async def spi_driver(dut):
    """The block drives miso from 3 cycles after the edge that samples the fall of cs_n to 3 cycles after the
    edge that samples its rise; with JITTER=1, also one cycle later.
    """
    host, _ = await start(dut)
    delays: dict[int, set[int]] = {0: set(), 1: set()}
    for _ in range(24):
        for level in delays:
            host.unit.put(cs_ni=level)
            delay = 0
            while host.unit.get("miso_oe_o") == level:
                await host.wait(1)
                delay += 1
                assert delay < 9, f"miso_oe does not follow cs_n = {level}"
            same("active_o", host.unit.get("active_o"), 1 - level)
            delays[level].add(delay)
            await host.wait(9)
    for level, found in delays.items():
        same(f"delays after cs_n = {level}", found, {3, 4} if jitters() else {3})
