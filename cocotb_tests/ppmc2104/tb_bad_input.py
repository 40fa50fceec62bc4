"""Invalid input (P2104-BAD), and recovery from it."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import D16, F11, F16, IBF, OBF, directed
from cocotb_tests.harness.axis_driver import indices, rates

from .env import Env
from .expected_timing import CMND1, ERROR, INIT_A, kind_of

SWITCHES = ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n")


@directed("P2104-BAD-01", "P2104-BAD-02", "P2104-BAD-03", "P2104-BAD-05", "P2104-ERR-03")
async def p2104_bad_03_bytes_at_random(dut: Any) -> None:
    """After 600 random bytes without an operation, the registers have the calculated values, and no pin has
    changed (P2104-BAD-03).
    """
    env = await Env.start(dut)
    rng = env.bench.rng
    await env.both(INIT_A)
    errors, waiting, left = [0, 0], 0, 0
    since = env.bench.now
    for _ in range(600):
        if rng.random() < 0.4:
            byte = rng.randrange(0x40, 0x100)
            status = await env.host.data(byte)
            if left:
                left -= 1
                waiting = waiting if left else 0
            else:
                errors[0] = 2
        else:
            code = rng.choice((0x00, 0x24, 0x87, 0xA8, 0xBF, 0xF2, 0xCF, 0x40, 0x61, 0x84, 0xA4, 0x85, 0xA5))
            kind, axis = kind_of(code), code >> 5 & 1
            status = await env.host.command(code)
            if left:
                errors[axis], left, waiting = 3, 0, 0
            elif kind == "undefined":
                errors[axis] = 1
            elif kind == "stop":
                errors[axis] = 6
            else:
                left, waiting = (2, axis + 1) if kind == "switching" else (1, axis + 1)
        expected = (ERROR if any(errors) else 0) | (CMND1 << waiting - 1 if waiting else 0)
        env.check("P2104-BAD-02", "status", status & ~OBF, expected)
        if rng.random() < 0.1 and not left:
            env.check("P2104-BAD-01", "registers", list(await env.errors()), errors)
            errors = [0, 0]
    env.quiet("P2104-ERR-03", since, "auxo")


@directed("P2104-BAD-16", "P2104-BAD-20", "P2104-BAD-21", "P2104-BAD-22", "P2104-FDC-01")
async def p2104_bad_22_chattering_inputs(dut: Any) -> None:
    """Inputs that bounce do not affect a ramp if the operation ignores them; a limit that bounces takes
    effect once (P2104-BAD-22).
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        rng = env.bench.rng
        await axis.go(0x43, 40)
        await axis.pulse(1)
        for _ in range(60):
            axis.set(
                run=rng.randrange(2), csel=rng.randrange(2), bl_n=rng.randrange(2), bhl_n=rng.randrange(2)
            )
            axis.set(org_n=rng.randrange(2))
            env.bench.set(errint_n=rng.randrange(2))
            await env.bench.clocks(rng.randrange(1, 90))
        await axis.idle()
        axis.check_train("P2104-BAD-21", rates(INIT_A[1:], indices(40, 4)))
        axis.set(run=1, csel=1, bl_n=1, bhl_n=1, org_n=1)
        env.bench.set(errint_n=1)
        await axis.result("P2104-BAD-20", 40, 0x83, 0)
        # The slow-down limit bounces: its first low level sets the deceleration flag.
        await axis.go(0x43, 40)
        await axis.pulse(8, 20)
        for _ in range(30):
            await axis.blip("fhl_n", 2)
            await env.bench.clocks(rng.randrange(2, 30))
        await axis.result("P2104-BAD-22", 13, 0x8B, 26)
        await axis.go(0x45, rate=30)
        await axis.pulse(4, 20)
        for _ in range(10):
            await axis.blip("fl_n", 2)
            await env.bench.clocks(rng.randrange(2, 9))
        await axis.result("P2104-BAD-22", 4, 0x95)


@directed("P2104-BAD-23", "P2104-PORT-03", "P2104-END-06", builds=(F16, F11))
async def p2104_bad_23_reset_anywhere(dut: Any) -> None:
    """A reset between two edges during motions, chopping, a data wait and an answer restores the reset state
    (P2104-BAD-23).
    """
    env = await Env.start(dut)
    bench = env.bench
    for round_number in range(8):
        first, second = await env.both((0x16, *INIT_A[1:]))
        await env.run("c F1 c 87 c 83 c C2")
        await first.go(0x4B, 200)
        await second.go(0x45, rate=12)
        await first.pulse(2 + round_number, 7 * round_number)
        if round_number & 1:
            await env.host.command(0x44, poll=False)
        await bench.set_between(bench.rng.random(), rst_n=0)
        env.all_reset("P2104-BAD-23")
        await bench.clocks(3)
        bench.set(rst_n=1)
        since = bench.now
        await bench.clocks(8)
        env.check("P2104-BAD-23", "status", await env.host.status(), 0x00)
        env.check("P2104-BAD-23", "data", await env.host.read(0), 0x00)
        env.check("P2104-BAD-23", "e1, e2, 83", await env.run("e1 e2 c 83 rrr"), [0] * 5)
        await bench.clocks(500)
        env.quiet("P2104-BAD-23", since, "auxo")
        for axis in env.axes:
            await axis.refused("P2104-BAD-23", "42", 4, 0x42)


@directed(
    "P2104-BAD-26",
    "P2104-BAD-14",
    "P2104-BAD-25",
    builds=(F16, D16),
    uncompared="the bus style changes inside strobes, which no rule fixes",
)
async def p2104_bad_26_recovery(dut: Any) -> None:
    """After noise on all pins, both axes work again if they receive any code, then codes 40 and C0 and a
    setting (P2104-BAD-26).

    The test is not compared with the model, because the noise switches the bus style within strobes.
    """
    env = await Env.start(dut)
    bench, rng = env.bench, env.bench.rng
    widths = {pin: bench.part.width(pin) for pin in bench.part.inputs}
    for _ in range(2 if env.cfg.datasheet else 12):
        for _ in range(1_500):
            for pin in rng.sample(sorted(widths), 4):
                bench.set(**{pin: rng.getrandbits(widths[pin])})
            await bench.clocks(rng.randrange(1, 6))
        bench.set(**bench.part.inputs)
        await bench.clocks(8)
        await env.host.poll(IBF, 0, timeout=env.cfg.us(200_000))
        # The first code may only end a data wait; the second one is executed, and its answer replaces the
        # rest of the output queue.
        for _ in range(2):
            await env.host.command(0x86)
            await env.host.poll(CMND1, 0)
        await env.host.read_data()
        for axis in env.axes:
            await axis.command(0x40)
            await axis.idle()
            await axis.ready()
            await axis.command(0xC0)
            await axis.init(*INIT_A)
            await axis.finish()
            await axis.error()
        await bench.clocks(env.cfg.us(50))
        env.check("P2104-BAD-26", "status", await env.host.status(), 0x00)
        op = 0xD3 if env.cfg.datasheet else 0x43
        for axis in env.axes:
            axis.set(csel=0)
            await axis.move(op, 12)
            axis.check_train("P2104-BAD-26", rates(INIT_A[1:], indices(12, 4)), 0)
            env.check("P2104-BAD-26", "end status", await axis.finish(), 0x83)
            axis.set(csel=1)
