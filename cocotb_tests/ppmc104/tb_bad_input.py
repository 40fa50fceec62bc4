"""Bad input (P104-BAD): illegal bytes, wrong order, misuse of every pin, and recovery from them."""

from __future__ import annotations

import random

from cocotb_tests.harness import BUSY, D16, DATA, F8, F16, F100, IBF, OBF, directed

from .env import Env
from .expected_timing import INIT_A
from .tb_acceptance_moves import kind_of


@directed("P104-BAD-01", "P104-CMD-03", "P104-HSK-07")
async def p104_bad_01_undefined_codes(dut):
    """Each undefined code returns error 0 and cancels an incomplete command, both at standstill and in motion
    (P104-BAD-01).
    """
    env = await Env.start(dut, INIT_A)
    undefined = [code for code in range(256) if kind_of(code) == "undefined"]
    for moving in (False, True):
        busy = BUSY if moving else 0
        if moving:
            await env.go(0x44, 8, 255)
        for code in undefined:
            await env.host.command(0x86)
            env.check("P104-BAD-01", f"status of {code:#04x}", await env.host.command(code), 0x80 | busy)
            stray = 0xE4 if moving else 0xB0
            env.check("P104-BAD-01", "the data of 0x86 is stray now", await env.host.data(0xFF), stray)
    await env.result("P104-BAD-01", 8, 0x84, 0)
    env.check_train("P104-BAD-01", [255] * 7)
    quiet = (env.bench.edges("auxo"), [v for _, v in env.bench.edges("dir")])
    env.check("P104-BAD-01", "auxo, dir", quiet, ([], []))


@directed("P104-BAD-03", "P104-BAD-04", "P104-BAD-11")
async def p104_bad_11_operation_before_init(dut):
    """Before initialisation, operations return error 2, each of their parameters returns error 3, and no
    output moves (P104-BAD-11).
    """
    env = await Env.start(dut, None)
    for code, count in (
        (0x42, 0),
        (0x43, 3),
        (0x44, 4),
        (0x45, 1),
        (0x46, 0),
        (0x47, 1),
        (0xC3, 3),
        (0xC6, 0),
    ):
        env.check("P104-BAD-11", f"status of {code:#x}", await env.host.command(code), 0xA0)
        for _ in range(count):
            env.check("P104-BAD-11", "status of its parameter", await env.host.data(1), 0xB0)
    await env.host.send(0x0A, [9, 4])
    await env.bench.clocks(3000)
    env.check("P104-BAD-03", "NUM stays", await env.host.status(), 0x20)
    env.check("P104-BAD-03", "core alive: 0x81", await env.host.run("c 81 r"), [0xCF])
    env.check("P104-BAD-04", "the init was dropped", await env.host.command(0x42), 0xA0)
    env.check("P104-BAD-11", "pulses", env.bench.pulses(), [])


@directed("P104-BAD-05", "P104-BAD-02", "P104-BAD-12")
async def p104_bad_05_too_many_parameters(dut):
    """Surplus bytes after a command return error 6 in motion and error 3 at standstill; they have no other
    effect (P104-BAD-05).
    """
    env = await Env.start(dut, INIT_A)
    env.since = env.bench.now
    got = await env.statuses("c 44 d 09 d 05 d 00 d 00 d 11 d 22")
    env.check("P104-BAD-05", "statuses", got, [0x40, 0x30, 0x20, 0x10, 0x04, 0xE4, 0xE4])
    await env.result("P104-BAD-05", 6, 0x84, 0)
    env.check_train("P104-BAD-05", [9] * 5)
    got = await env.statuses("c 84 d 10 d 20 d 30 c 86 d 05 d 0A")
    env.check("P104-BAD-05", "statuses at rest", got, [0x20, 0x10, 0x00, 0xB0, 0x10, 0x00, 0xB0])
    await env.bench.clocks(2)
    env.check("P104-BAD-05", "auxo is of the first byte", env.bench.level("auxo"), 0b1010)
    got = await env.statuses("c 0A d 13 d 09 d 0A d 00 d 55")
    env.check("P104-BAD-05", "statuses of init", got[-2:], [0x00, 0xB0])
    await env.move(0x43, 3)
    env.check_train("P104-BAD-05", [19, 19])


@directed("P104-BAD-07", "P104-BAD-22", "P104-HSK-06", "P104-HSK-08")
async def p104_bad_22_queue_never_read(dut):
    """If the host never reads a full output queue, all other functions still work, and the queue does not
    change (P104-BAD-22).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 9, 9)
    await env.pulse(2, 100)
    await env.host.command(0x40)
    await env.idle()
    await env.host.command(0x83)
    for _ in range(3):
        await env.move(0x43, 4)
        env.check("P104-BAD-22", "pulses", len(env.pulses), 4)
        env.check("P104-BAD-22", "status", await env.host.send(0x86, [0x0F]), OBF)
    await env.init(*INIT_A)
    env.check("P104-BAD-22", "the old bytes", [await env.host.read_data() for _ in range(3)], [6, 0, 0])
    env.check("P104-BAD-07", "stale reads", [await env.host.read(DATA) for _ in range(3)], [0, 0, 0])
    env.check("P104-BAD-07", "status", await env.host.status(), 0x00)
    await env.host.command(0x83)
    env.check("P104-BAD-22", "a new read command", await env.host.fetch(0x80), [0x83])


@directed("P104-BAD-13", "P104-TIM-03", "P104-OPR-06")
async def p104_bad_13_clock_stops_in_motion(dut):
    """If the external clock stops during a motion, stops and limits still take effect; decelerations wait for
    clock edges (P104-BAD-13).
    """
    env = await Env.start(dut, (0x1A, 9, 4, 4))
    for cause, bits in (("40", 0xC0), ("l1_n", 0x90), ("alm_n", 0xA0)):
        for code, rate in ((0x44, 2), (0x43, None)):
            await env.go(code, 20, rate)
            await env.bench.clocks(100)
            await env.tick_until(3)
            await env.bench.clocks(3000)
            env.check("P104-BAD-13", "waiting", (await env.host.status(), len(env.pulses)), (BUSY, 3))
            if cause == "40":
                await env.host.command(0x40)
            else:
                env.bench.set(**{cause: 0})
            await env.result("P104-BAD-13", 3, bits | code & 7, 16)
            env.bench.set(l1_n=1, alm_n=1)
    await env.go(0x43, 20)
    await env.bench.clocks(100)
    await env.tick_until(3)
    env.check("P104-BAD-13", "0x41 is taken", await env.host.command(0x41), BUSY)
    await env.bench.clocks(3000)
    env.check("P104-BAD-13", "and waits", (await env.host.status(), len(env.pulses)), (BUSY, 3))
    await env.tick_until(6)
    await env.result("P104-BAD-13", 6, 0xC3, 13)
    await env.go(0x43, 20)
    await env.bench.clocks(100)
    await env.tick_until(3)
    await env.host.command(0x41)
    await env.host.command(0x40)
    await env.result("P104-BAD-13", 3, 0xC3, 16)
    await env.go(0x44, 20, 2)
    await env.bench.clocks(100)
    await env.tick_until(3)
    await env.host.command(0x41)
    await env.result("P104-BAD-13", 3, 0xC4, 16)
    await env.move(0x42)
    await env.result("P104-BAD-13", 1, 0x82, 0)


@directed("P104-BAD-15", "P104-LIM-07", "P104-LIM-09", exact="the switches must be sampled at the same edge")
async def p104_bad_15_everything_active(dut):
    """If all inputs become active at the start of an operation or during it, no further pulse is output, and
    bits 5 and 4 of the finish status are set (P104-BAD-15).
    """
    env = await Env.start(dut, INIT_A)
    pins = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n")
    for code, n, rate in (
        (0x42, None, None),
        (0x4B, 9, None),
        (0x44, 9, 9),
        (0x4F, None, 9),
        (0xC6, None, None),
    ):
        total = {0x42: 1}.get(code, n or 1 << 24)
        for count in (0, 2):
            if count and code == 0x42:
                continue
            if not count:
                env.bench.set(**dict.fromkeys(pins, 0))
            await env.go(code, n, rate)
            if count:
                await env.pulse(count, 100)
                env.bench.set(**dict.fromkeys(pins, 0))
            await env.idle()
            await env.result("P104-BAD-15", count, 0xB0 | code & 7, total - count - 1)
            env.bench.set(**dict.fromkeys(pins, 1))
            await env.bench.clocks(4)


@directed("P104-BAD-19", "P104-PORT-03", builds=(F16, F100))
async def p104_bad_19_reset_in_every_state(dut):
    """After a reset in START, while pout_n is low, between pulses or during a table build, the core is in
    UNINIT with its reset levels (P104-BAD-19).
    """
    env = await Env.start(dut, None)
    expected = {"int_n": 1, "pout_n": 1, "hold": 1, "dir": 0, "aux_n": 1, "auxo": 0xF, "s": 0x1F}
    for point in ("START", "low", "high", "build", "half"):
        await env.init(0x2A, 9, 4, 4)
        await env.host.run("c C1 c 86 d 0F c 81")
        if point == "build":
            await env.host.init(0x0A, 255, 0, 11220)
        elif point == "half":
            await env.host.send(0x44, [1, 2])
        else:
            await env.go(0x4C, 50, 9)
            if point != "START":
                await env.pulse(4, 10 if point == "low" else env.cfg.w + 20)
        release = await env.bench.reset()
        env.check("P104-BAD-19", f"outputs after reset in {point}", env.outputs(), expected)
        await env.bench.clocks(6)
        env.check("P104-BAD-19", "status", await env.host.status(), 0x00)
        env.check("P104-BAD-19", "data register", await env.host.read(DATA), 0x00)
        env.check("P104-BAD-19", "0x42", await env.host.command(0x42), 0xA0)
        await env.bench.clocks(env.cfg.us(300))
        moved = {name: env.bench.edges(name, release) for name in env.outputs()}
        env.check("P104-BAD-19", "edges after the release", moved, {name: [] for name in moved})
        env.check("P104-BAD-19", "finish status", await env.finish(), 0x00)
        env.check("P104-BAD-19", "remaining", await env.remaining(), 0)


@directed("P104-BAD-18", "P104-BUS-06")
async def p104_bad_18_cs_ends_the_strobe(dut):
    """If cs_n rises before wr_n, the byte is stored; if it rises before rd_n, the read ends (P104-BAD-18)."""
    env = await Env.start(dut, None)
    bench = env.bench
    bench.set(a0=1, d_i=0xC1, cs_n=0, wr_n=0)
    await bench.clocks(3)
    bench.set(cs_n=1)
    await bench.clocks(14)
    env.check("P104-BAD-18", "aux_n with wr_n still low", bench.level("aux_n"), 0)
    bench.set(d_i=0xC2)
    await bench.clocks(4)
    bench.set(wr_n=1)
    await bench.clocks(14)
    env.check("P104-BAD-18", "aux_n: no second write", bench.level("aux_n"), 0)
    bench.set(cs_n=0, rd_n=0)
    await bench.clocks(5)
    after = bench.set(cs_n=1)
    await bench.clocks(5)
    bench.set(rd_n=1)
    env.window("P104-BAD-18", "d_oe fall after cs_n", bench.falls("d_oe")[-1] - after, 0, 2)


@directed("P104-BAD-20", "P104-LIM-03")
async def p104_bad_20_hard_limit_chatters(dut):
    """If the hard limit bounces during a deceleration, the first sampled low level ends the motion
    permanently (P104-BAD-20).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x43, 100)
    await env.pulse(7, 20)
    await env.host.command(0x41)
    await env.pulse(9, 100)
    for _ in range(10):
        env.bench.set(l1_n=0)
        await env.bench.clocks(2)
        env.bench.set(l1_n=1)
        await env.bench.clocks(5)
    await env.result("P104-BAD-20", 9, 0xD3, 90)


async def abuse(env: Env, rng: random.Random, rounds: int) -> None:
    """Apply random bytes, strobes of any length, and random pin levels."""
    pins = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n", "csel", "vsel")
    ops = [0x42, 0x43, 0x44, 0x45, 0x46, 0x47, 0xC3, 0xC6, 0x0A, 0x1A, 0x2D, 0x13, 0x84, 0x86, 0xC0]
    for _ in range(rounds):
        what = rng.randrange(6)
        if what < 3:
            byte = rng.choice(ops) if rng.random() < 0.5 else rng.randrange(256)
            await env.host.write(rng.randrange(2), byte, strobe=rng.randrange(1, 5), gap=rng.randrange(1, 60))
        elif what == 3:
            await env.host.read(rng.randrange(2), strobe=rng.randrange(1, 6))
        elif what == 4:
            env.bench.set(**{pin: int(rng.random() < 0.8) for pin in pins})
        else:
            levels = {"cs_n": 0, "rd_n": rng.randrange(2), "wr_n": rng.randrange(2)}
            await env.host.raw(rng.randrange(1, 5), a0=rng.randrange(2), d_i=rng.randrange(256), **levels)
            await env.host.idle()
            await env.bench.clocks(rng.randrange(1, 8))


@directed("P104-BAD-23", "P104-FSM-01", builds=(F8, F16, F100, D16))
async def p104_bad_23_always_a_way_back(dut):
    """After random input, with or without an external clock, commands 0x40 and 0xC0 and an initialisation
    make the core work again (P104-BAD-23).
    """
    env = await Env.start(dut, None)
    rng = env.bench.rng
    for turn in range(3 if env.cfg.datasheet else 12):
        clock = env.bench.external_clock(iter(lambda: rng.randrange(4, 90), 0), high=2) if turn % 2 else None
        await abuse(env, rng, 60)
        env.bench.set(l1_n=1, l2_n=1, l3_n=1, l4_n=1, cnp_n=1, alm_n=1, csel=1, vsel=1)
        # A random byte may still wait in the mailbox, so one operation may still start.
        for _ in range(3):
            await env.host.poll(IBF, 0, timeout=3_000_000)
            if env.cfg.datasheet:
                # In DATASHEET, BUSY may rise after the start of this operation (P104-DS-03).
                await env.bench.clocks(env.cfg.us(120))
            if await env.host.status() & BUSY:
                await env.host.command(0x40)
            await env.host.wait_idle()
        await env.host.command(0xC0)
        await env.init(*INIT_A)
        await env.bench.clocks(100)
        env.check("P104-BAD-23", f"s after recovery {turn}", env.bench.level("s"), 0b00011)
        await env.finish()
        await env.move(0x43, 14)
        env.check_train("P104-BAD-23", [9, 7, 5, 5, 4, 4, 4, 4, 4, 5, 5, 7, 9])
        await env.result("P104-BAD-23", 14, 0x83, 0)
        if clock:
            clock.cancel()
            await env.bench.align()
            env.bench.set(clock=0)
