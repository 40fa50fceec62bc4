"""Contracts of rtl/host: ppmc_strobe_bus, ppmc_mailbox, ppmc_host_port."""

from __future__ import annotations

import random
from collections import deque

import cocotb

from ..harness import Block, BlockDriver, rng, same
from ..harness.collect import exact

PINS = "cs_ni rd_ni wr_ni a0_i d_i:8"
READ_SIDE = "status_i:8 data_i:8 data_valid_i data_new_i"
MAIL = (
    "wr_i wr_a0_i wr_data_i:8 rd_done_i out_o:8 obf_o new_o ibf_o ready_o command_o byte_o:8 take_i load_i"
    " long_i"
)
BLOCKS = {
    "bus": Block(
        "ppmc_strobe_bus",
        f"style_i {PINS} d_o:8 d_oe_o wr_o wr_a0_o wr_data_o:8 wr_busy_o {READ_SIDE} rd_busy_o rd_done_o",
    ),
    "mail3": Block("ppmc_mailbox", f"{MAIL} answer_i:24", {"QueueBytes": 3}),
    "mail5": Block("ppmc_mailbox", f"{MAIL} answer_i:40", {"QueueBytes": 5}),
    "port": Block(
        "ppmc_host_port",
        f"style_i {PINS} d_o:8 d_oe_o state_i:6 ready_o command_o byte_o:8 take_i load_i long_i answer_i:24",
    ),
}
EVERY_CYCLE = "it checks the effect of the pins in every cycle, as tests of devices do"
IDLE = {"cs_ni": 1, "rd_ni": 1, "wr_ni": 1}


def strobes(cs_n: int, rd_n: int, wr_n: int, style: int) -> tuple[bool, bool]:
    """Return the (read, write) strobe for pin levels, as in the truth table of each bus style."""
    if cs_n:
        return False, False
    if style == 0:
        return (rd_n, wr_n) == (0, 1), (rd_n, wr_n) == (1, 0)
    return (rd_n, wr_n) == (1, 0), (rd_n, wr_n) == (0, 0)


def levels(kind: str, style: int) -> dict[str, int]:
    """Return the pin levels of a "read" or a "write" strobe."""
    if style == 0:
        return {"cs_ni": 0, "rd_ni": int(kind != "read"), "wr_ni": int(kind != "write")}
    return {"cs_ni": 0, "rd_ni": int(kind == "read"), "wr_ni": 0}


@exact(EVERY_CYCLE)
@cocotb.test()
async def bus_write_any_pins(dut):
    """For random pins, a write strobe whose end is sampled at edge 0 causes a write event at edge 2. Its byte
    is the one that was sampled at the edge before the end.
    """
    rand = rng()
    u = BlockDriver(dut, "bus", BLOCKS, "wr_o wr_busy_o d_oe_o")
    for style in (0, 1):
        await u.reset(style_i=style, **IDLE)
        past = [(False, False, 0, 0)] * 3
        pins, events = (1, 1, 1), 0
        for n in range(3000):
            if rand.random() < 0.6:
                pins = tuple(int(rand.random() < p) for p in (0.2, 0.5, 0.5))
            a0, data = rand.randrange(2), rand.getrandbits(8)
            got = await u.settle(cs_ni=pins[0], rd_ni=pins[1], wr_ni=pins[2], a0_i=a0, d_i=data)
            event = past[-3][1] and not past[-2][1]
            where = f"style {style}, cycle {n}"
            want = (event, past[-1][1] or past[-2][1] or past[-3][1], past[-1][0])
            same(f"{where}: wr_o, wr_busy_o, d_oe_o", got, want)
            if event:
                events += 1
                same(f"{where}: a0, data", (u.get("wr_a0_o"), u.get("wr_data_o")), past[-3][2:])
            await u.clk()
            past.append((*strobes(*pins, style), a0, data))
        assert events > 200, f"only {events} writes"


@cocotb.test()
async def bus_short_strobe(dut):
    """A strobe that no rising edge of `clk` samples causes no write and no read, and consumes no byte."""
    u = BlockDriver(dut, "bus", BLOCKS, "wr_o wr_busy_o d_oe_o rd_busy_o rd_done_o d_o")
    for style in (0, 1):
        await u.reset(style_i=style, data_valid_i=1, data_i=0x5A, **IDLE)
        for kind in ("write", "read") * 3:
            await u.settle(**levels(kind, style))
            u.put(**IDLE)
            for n in range(5):
                same(f"style {style}, {kind}, cycle {n}", await u.clk(), (0, 0, 0, 0, 0, 0))


async def _read(u: BlockDriver, rand: random.Random, style: int, length: int, gap: int, early: bool) -> None:
    """Check one read of `length` cycles and the gap after it.

    If `early` is set, also check that d_o loads on edge 0.
    """
    a0 = rand.randrange(2)
    sampled: list[tuple[int, int, int]] = []
    shown, taken, unseen = u.get("d_o"), False, False
    for n in range(length + gap):
        status, data, valid = rand.getrandbits(8), rand.getrandbits(8), rand.randrange(2)
        new = rand.random() < 0.12
        pins = levels("read", style) if n < length else IDLE
        u.put(status_i=status, data_i=data, data_valid_i=valid, data_new_i=new, **pins)
        u.put(a0_i=a0 if n < length else 1 - a0)
        oe, out, busy, done = await u.clk()
        sampled.append((status, data, valid))
        where = f"style {style}, {length} cycles, a0 {a0}, edge {n}"
        if n:
            same(f"{where}: d_oe", oe, n <= length)
        if n > 1 or early:
            same(f"{where}: d_o", out, shown)
        same(f"{where}: rd_busy", busy, taken and 2 <= n <= length + 2)
        same(f"{where}: rd_done", done, taken and n == length + 2)
        if n < 2 and n < length:
            shown = status if a0 else data
        # d_o loads again on edge 1, so it contains a byte that arrives on edge 0. A byte that arrives later
        # is not output, so it is not consumed.
        unseen = unseen or bool(new and (n or length == 1))
        if n == 1:
            taken = bool(valid and not a0)
        taken = taken and not unseen


@exact(EVERY_CYCLE)
@cocotb.test()
async def bus_read(dut):
    """In a read, d_o loads on edges 0 and 1 and is then stable. A byte is consumed only if it was valid and
    is the one that was output.
    """
    rand = rng()
    u = BlockDriver(dut, "bus", BLOCKS, "d_oe_o d_o rd_busy_o rd_done_o")
    for style in (0, 1):
        await u.reset(style_i=style, **IDLE)
        for _ in range(400):
            await _read(u, rand, style, rand.choice((1, 2, 3, 4, 9)), rand.randint(3, 6), early=True)


@exact(EVERY_CYCLE)
@cocotb.test()
async def bus_read_after_gap_of_one(dut):
    """If only one edge samples the gap between two reads, the second read outputs its register from edge 0
    on.
    """
    u = BlockDriver(dut, "bus", BLOCKS, "d_oe_o d_o rd_busy_o rd_done_o")
    for style in (0, 1):
        await u.reset(style_i=style, status_i=0x33, data_i=0xC5, data_valid_i=1, **IDLE)
        done = 0
        for a0, value in ((0, 0xC5), (1, 0x33), (1, 0x33), (0, 0xC5), (1, 0x33)):
            for n in range(4):
                _, out, _, ended = await u.clk(a0_i=a0, **levels("read", style))
                done += ended
                if n:
                    same(f"style {style}, edge {n}: d_o", out, value)
            done += (await u.clk(**IDLE))[3]
        for _ in range(4):
            done += (await u.clk(**IDLE))[3]
        same("data reads done", done, 2)


@cocotb.test()
async def mailbox_random(dut):
    """Under random traffic, the input buffer and the output queue behave as a simple model does, including
    overwritten bytes, accepted bytes and loaded answers.
    """
    rand = rng()
    for name, size in (("mail3", 3), ("mail5", 5)):
        u = BlockDriver(dut, name, BLOCKS, "ibf_o ready_o obf_o new_o")
        await u.reset()
        ibf = settled = obf = False
        box, out, queue = (0, 0), 0, deque()
        for n in range(5000):
            ready = ibf and settled
            where = f"{size} bytes, cycle {n}"
            wr, load = rand.random() < 0.2, rand.random() < 0.06
            take = ready and rand.random() < 0.4
            done = obf and rand.random() < 0.3
            long, a0, byte = rand.random() < 0.7, rand.randrange(2), rand.getrandbits(8)
            comes = load or (not obf and bool(queue))
            answer = rand.getrandbits(8 * size)
            got = await u.clk(
                wr_i=wr,
                wr_a0_i=a0,
                wr_data_i=byte,
                take_i=take,
                rd_done_i=done,
                load_i=load,
                long_i=long,
                answer_i=answer,
            )
            same(f"{where}: ibf, ready, obf, new", got, (ibf, ready, obf, comes))
            settled = ibf and not wr
            ibf = wr or (ibf and not take)
            box = (a0, byte) if wr else box
            if load:
                answers = list(answer.to_bytes(size, "little"))
                out, obf, queue = answers[0], True, deque(answers[1:] if long else [])
            elif not obf and queue:
                out, obf = queue.popleft(), True
            elif done:
                obf = False
            await u.settle(wr_i=0, take_i=0, rd_done_i=0, load_i=0)
            if ibf:
                same(f"{where}: command, byte", (u.get("command_o"), u.get("byte_o")), box)
            if obf:
                same(f"{where}: out", u.get("out_o"), out)


@cocotb.test()
async def mailbox_directed(dut):
    """In each case that the header of the module lists, the outputs change in the stated cycle."""
    u = BlockDriver(dut, "mail3", BLOCKS, "ibf_o ready_o byte_o")
    await u.reset()
    await u.clk(wr_i=1, wr_data_i=0x11)
    same("byte at once, ready not yet", await u.clk(wr_i=0), (1, 0, 0x11))
    same("ready one cycle later; taken while a new one is written", await u.settle(), (1, 1, 0x11))
    await u.clk(take_i=1, wr_i=1, wr_data_i=0x22)
    same("the new byte stays", await u.clk(take_i=0, wr_i=0), (1, 0, 0x22))
    await u.clk(wr_i=1, wr_data_i=0x33)
    same("overwritten", await u.clk(wr_i=0), (1, 0, 0x33))
    same("ready again", await u.clk(take_i=1), (1, 1, 0x33))
    same("taken", (await u.clk(take_i=0))[:2], (0, 0))
    u = BlockDriver(dut, "mail3", BLOCKS, "obf_o out_o")
    await u.reset()
    await u.clk(load_i=1, long_i=1, answer_i=0x030201)
    for byte in (1, 2, 3):
        same("valid", await u.clk(load_i=0, rd_done_i=1), (1, byte))
        same("gap of one cycle", (await u.clk(rd_done_i=0))[0], 0)
    same("empty", (await u.clk())[0], 0)
    await u.clk(load_i=1, long_i=1, answer_i=0x060504)
    await u.clk(load_i=0, rd_done_i=1)
    await u.clk(load_i=1, long_i=0, rd_done_i=0, answer_i=0x090807)
    same("load replaces the queue", await u.clk(load_i=0, rd_done_i=1), (1, 7))
    for _ in range(3):
        same("nothing behind it", (await u.clk(rd_done_i=0))[0], 0)


@cocotb.test()
async def host_port_status(dut):
    """After a write and an answer of three bytes, the status contains IBF and OBF, and reads return the
    bytes.
    """
    u = BlockDriver(dut, "port", BLOCKS, "ready_o command_o byte_o")

    async def read(a0: int, length: int = 4) -> int:
        for _ in range(length):
            await u.clk(a0_i=a0, **levels("read", style))
        value = u.get("d_o")
        for _ in range(2):
            await u.clk(**IDLE)
        return value

    for style in (0, 1):
        await u.reset(style_i=style, state_i=0b101101, **IDLE)
        same("idle", await read(1), 0b10110100)
        for _ in range(2):
            await u.clk(a0_i=1, d_i=0xA7, **levels("write", style))
        await u.clk(d_i=0, a0_i=0, **IDLE)
        same("IBF one cycle after the write's end", await read(1), 0b10110110)
        same("byte", await u.settle(), (1, 1, 0xA7))
        await u.clk(take_i=1)
        await u.clk(take_i=0, load_i=1, long_i=1, answer_i=0xCCBBAA)
        u.put(load_i=0)
        for byte in (0xAA, 0xBB, 0xCC):
            await u.clk()
            same("OBF", await read(1), 0b10110101)
            same("data", await read(0), byte)
        same("being taken: not shown again", await read(1, length=1), 0b10110100)
        same("empty", await read(1), 0b10110100)
