"""Initialisation and excitation: STMC-INI, STMC-EXC, visible effects of STMC-RMP, PHASE_IDLE."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, D16, DATA, F16, IBF, OBF, directed

from .env import BUILD_LATEST, C_EVENT_LATEST, Env
from .expected_timing import SHEET, STANDARD, STEPS, gaps, steps

WRONG = ((0, 0, 8), (0, 5, 8), (20, 0, 8), (5, 20, 8), (19, 20, 0), (254, 255, 65535))


@directed("STMC-INI-02", "STMC-BAD-05", "STMC-ST-03")
async def stmc_ini_02_illegal_divisors(dut: Any) -> None:
    """Illegal divisors return error 5 with the 4th byte and have no effect (STMC-INI-02)."""
    env = await Env.start(dut, None)
    for good in (False, True):
        if good:
            await env.init(*STANDARD)
        for d1, d2, pa in WRONG:
            got = [await env.status_after(0x0F)]
            got += [await env.status_after(byte, DATA) for byte in (d1, d2, pa & 255, pa >> 8)]
            env.check("STMC-INI-02", f"statuses of {(d1, d2, pa)}", got, [0x40, 0x30, 0x20, 0x10, 0xD0])
        if not good:
            env.check("STMC-INI-02", "42", await env.statuses("c 42"), [0xA0])
            env.check("STMC-INI-02", "s", env.bench.edges("s"), [])
    await env.go(0x43, 4)
    await env.outcome("STMC-INI-02", 4, 0x83, 0, [20, 12, 20])
    env.check("STMC-INI-02", "type is not that of a refused one", env.patterns[0], 0b00110)


@directed("STMC-INI-02", "STMC-MOV-04", "STMC-INI-01")
async def stmc_ini_02_small_and_flat(dut: Any) -> None:
    """Divisors 1 to 4, PA 0 and 65535, and D1 = D2 are accepted, and moves with them are correct
    (STMC-INI-02).
    """
    env = await Env.start(dut)
    for d1, d2, pa, n in (
        (4, 3, 2, 8),
        (255, 254, 65535, 3),
        (12, 6, 0, 6),
        (10, 10, 50, 6),
        (255, 4, 1, 5),
        (5, 4, 1, 4),
    ):
        await env.init(0x1A, d1, d2, pa)
        await env.go(0x43, n)
        await env.outcome("STMC-INI-02", n, 0x83, 0, gaps(n, (d1, d2, pa)))
    await env.init(0x0A, 1, 1, 0)
    await env.move(0x43, 3)
    env.check("STMC-INI-01", "gaps of divisor 1 in cycles", env.intervals, [1280, 1280])
    await env.move(0x44, 3, 2)
    env.check("STMC-INI-01", "gaps of divisor 2 in cycles", env.intervals, [2560, 2560])


@directed("STMC-INI-04", "STMC-INI-05", "STMC-INI-06", "STMC-EXC-03")
async def stmc_ini_04_frozen_bits(dut: Any) -> None:
    """Bits 3..0 of the first initialisation stay active until a reset; later initialisations do not change
    them (STMC-INI-04).
    """
    env = await Env.start(dut)
    await env.move(0x42)
    fin = await env.finish()
    since = env.bench.now
    for code in (0x01, 0x07, 0x1F, 0x0D):
        await env.host.init(code | 0x10, 30, 10, 4)
        await env.ready()
    env.check("STMC-INI-06", "s", env.bench.edges("s", since), [])
    env.check(
        "STMC-INI-06", "hold, int_n", env.bench.edges("hold", since) + env.bench.edges("int_n", since), []
    )
    env.check("STMC-INI-06", "FIN", await env.finish(), fin)
    await env.move(0x44, 4, 1)
    env.check("STMC-EXC-03", "patterns", env.patterns, [0b01100, 0b01001, 0b00011, 0b00110])
    await env.reset()
    await env.init(0x15, 30, 10, 4)
    env.check("STMC-INI-04", "s after a reset", env.bench.level("s"), 0b11100)


@directed("STMC-INI-04", "STMC-INI-07")
async def stmc_ini_04_data_loaded_again(dut: Any) -> None:
    """After a second initialisation, the next move uses the new divisors and clock (STMC-INI-04)."""
    env = await Env.start(dut)
    await env.init(0x1A, 30, 10, 4)
    await env.move(0x43, 10)
    env.train("STMC-INI-04", gaps(10, (30, 10, 4)))
    await env.init(0x0A, 3, 2, 1)
    await env.move(0x43, 4)
    env.check("STMC-INI-04", "gaps on the internal clock", env.intervals, [3840, 2560, 3840])


@directed("STMC-INI-07", "STMC-FSM-03", "STMC-BUS-14")
async def stmc_ini_07_build(dut: Any) -> None:
    """A motion that is sent during a table build of any length waits, is checked after the build, and makes
    the correct steps (STMC-INI-07).
    """
    env = await Env.start(dut)
    for d1, d2, pa in ((255, 1, 65535), (255, 254, 65535), (2, 1, 1), (200, 3, 255), (20, 20, 9), (9, 3, 0)):
        edge0 = (await env.host.init(0x1A, d1, d2, pa), env.bench.now)[1]
        env.since = env.bench.now
        await env.host.write(1, 0x4B)
        await env.host.poll(IBF, 0, BUILD_LATEST + 500)
        env.window("STMC-INI-07", "build", env.bench.now - edge0, 0, BUILD_LATEST + 400)
        for byte in (2, 0, 0):
            await env.host.data(byte)
        await env.outcome("STMC-INI-07", 3, 0x83, 0, gaps(3, (d1, d2, pa)))


@directed("STMC-INI-07", "STMC-FSM-03", "STMC-BAD-16")
async def stmc_ini_07_reset_in_the_build(dut: Any) -> None:
    """After a reset at any time during a build, the next initialisation works (STMC-INI-07, STMC-BAD-16)."""
    env = await Env.start(dut)
    for wait in (2, 40, 500, 3_000):
        await env.host.init(0x1A, 255, 5, 400)
        await env.bench.clocks(wait)
        await env.reset()
        env.check("STMC-BAD-16", "42", await env.statuses("c 42"), [0xA0])
        await env.init(*STANDARD)
        await env.go(0x43, 12)
        await env.outcome("STMC-INI-07", 12, 0x83, 0, gaps(12))


@directed("STMC-INI-06", "STMC-INI-08", builds=(F16, SHEET, D16))
async def stmc_ini_06_first_pattern(dut: Any) -> None:
    """The first initialisation replaces the idle level with position 0; BUSY stays 0 (STMC-INI-06)."""
    env = await Env.start(dut, None, clock=0)
    idle = 0x1F if env.sheet else 0
    env.check("STMC-INI-06", "s before", env.bench.level("s"), idle)
    env.check("STMC-OUT-02", "outputs before", await env.out(), 0xFC if idle else 0x04)
    for code in range(0x01, 0x10):
        if not code & 3:
            continue
        if code > 1 and env.cfg.datasheet:
            break
        await env.reset()
        for byte in (20, 5, 0):
            await (env.host.command(code) if byte == 20 else env.host.status())
            await env.host.data(byte)
        edge0 = await env.host.data(0, poll=False)
        await env.bench.until(edge0 + C_EVENT_LATEST + 2)
        if not env.cfg.datasheet:
            env.check("STMC-INI-06", f"s of code {code:#x}", env.bench.level("s"), steps(code)[0])
        else:
            t = await env.bench.edge("s")
            env.window("STMC-DS-02", "s", t - edge0, 704, 704 + 24)
        env.check("STMC-INI-08", "BUSY", await env.host.status() & BUSY, 0)
        env.check("STMC-INI-08", "int_n and hold", env.bench.level("int_n") & env.bench.level("hold"), 1)


@directed("STMC-EXC-01", "STMC-EXC-02", "STMC-EXC-04", "STMC-EXC-05", "STMC-OUT-01", "STMC-OUT-02")
async def stmc_exc_01_all_tables(dut: Any) -> None:
    """For each motor type, mode and logic, two turns and back output every pattern of the table
    (STMC-EXC-01).
    """
    env = await Env.start(dut, None)
    for low in STEPS:
        for logic in (8, 0):
            code = 0x10 | low | logic
            table = steps(code)
            size = len(table)
            await env.reset()
            await env.init(code, 20, 5, 8)
            env.check("STMC-EXC-01", f"s of {code:#x}", env.bench.level("s"), table[0])
            await env.move(0x44, 2 * size, 1)
            expected = [table[i % size] for i in range(1, 2 * size + 1)]
            env.check("STMC-EXC-02", f"cw patterns of {code:#x}", env.patterns, expected)
            await env.move(0x4C, size + 1, 1)
            expected = [table[-i % size] for i in range(1, size + 2)]
            env.check("STMC-EXC-02", f"ccw patterns of {code:#x}", env.patterns, expected)
            level = table[-1]
            register = sum((level >> i & 1) << (7 - i) for i in range(5)) | 2
            env.check("STMC-OUT-01", f"outputs of {code:#x}", await env.out() & ~4, register)


@directed("STMC-MOT-04", "STMC-OUT-01", "STMC-INI-06")
async def stmc_out_01_direction_bit(dut: Any) -> None:
    """The direction bit of the outputs register is that of the last executed motion."""
    env = await Env.start(dut)
    for script, bit in (
        ("c 4A", 1),
        ("c 42", 0),
        ("c 4C d 00 d 01 d 00 d 00", 0),
        ("c 4B d 00 d 00 d 00", 1),
        ("c 43 d 01 d 00", 1),
        ("c 41", 1),
        ("c 1A d 14 d 05 d 08 d 00", 1),
        ("c 42", 0),
    ):
        await env.host.run(script)
        await env.idle()
        status = await env.host.command(env.outputs_code)
        env.check("STMC-RD-01", "status", status, OBF)
        env.check("STMC-OUT-01", f"direction after {script}", await env.host.read_data() & 2, bit << 1)
