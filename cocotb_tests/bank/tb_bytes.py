"""Bytes: input buffer, output queue, codes, and the table builder that all axes share (BANK-HSK, BANK-INI,
BANK-GEN-03).

V is the edge of a visit of the axis, w the edge of the write event of a byte (BANK-WIN-06).
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, IBF, OBF, directed

from .bench import B4, B8, B32, B64, F100
from .env import DATA, INIT_A, STATUS, Env

UNDEFINED, WHILE_BUSY, NOT_READY, NOT_WANTED = 0, 1, 2, 3
LONG = (0x0A, 255, 1, 4)
"""Initialisation with the longest table build."""
ERROR = 0x80
PARAMETERS = {3: 3, 4: 4, 5: 1, 7: 1}


def idle_answer(code: int, initialised: bool) -> int:
    """Return the status after a command byte at standstill, derived from P104-CMD-01 and BANK-GEN-03 only."""
    if code < 0x40:
        return 0x40 if code & 3 and not code & 0x10 else 0x80
    if 0x80 <= code < 0xC0:
        if code == 0x84:
            return 0x20
        return OBF if code in (0x80, 0x81, 0x82, 0x83) else 0x80
    low = code & 7
    if code >= 0xC0 and low not in (3, 6):
        return 0x00 if low == 0 else 0x80
    if low < 2:
        return 0x80
    if not initialised:
        return 0x80 | NOT_READY << 4
    return PARAMETERS[low] << 4 if low in PARAMETERS else BUSY


@directed("BANK-HSK-01", "BANK-GEN-01", builds=(B4, B8, B32, B64, F100))
async def bank_hsk_01_seven_clk(dut):
    """A byte whose write event is on edge w is accepted by the first visit V at w + 7 or later (BANK-HSK-01).

    The test uses w = V - 8, V - 7, V - 6, V - 1 and V.
    """
    env = await Env.start(dut)
    for axis in (env.axes[0], env.axes[env.size // 2], env.axes[-1]):
        await axis.init(*INIT_A)
        for early in (8, 7, 6, 1, 0):
            ccw = 1 - axis.level("dir")
            visit = axis.visit(env.bench.now + 50)
            event = await env.write_at(visit - early, axis.n << 4 | STATUS, 0x42 | ccw << 3)
            await axis.host.poll(IBF | BUSY, 0)
            want = visit + (env.round if event > visit - 7 else 0)
            got = axis.edges("dir", visit - 9)
            env.check("BANK-HSK-01", f"start of {axis.n}, w = V - {early}", got, [(want, ccw)])
            env.check("BANK-MOT-01", "pulse 1", axis.edges("pout_n", visit)[0][0], want + env.cfg.w)


@directed("BANK-HSK-03", builds=(B8, B32), exact="a write must be accepted in a given cycle")
async def bank_hsk_03_replaced(dut):
    """Of two bytes written before a visit V, the visit accepts the newer one if it was written at V - 7 or
    earlier, else the older one (BANK-HSK-03).
    """
    env = await Env.start(dut)
    axis = await env.ready(3)
    address = axis.n << 4 | STATUS
    for early in (8, 7, 6, 5):
        visit = axis.visit(env.bench.now + 60)
        env.at_event(visit - 14, address, 0x81)
        env.at_event(visit - early, address, 0x87)
        # The earliest read that fits after the write returns the state after V + 4.
        got = await env.as_of(visit + 4, address) & ~(ERROR if early > 6 else 0)
        older = OBF | IBF if env.round > 8 else got
        env.check("BANK-HSK-03", f"status, w = V - {early}", got, 0 if early > 6 else older)
        await env.bench.clocks(2 * env.round)
        status = await axis.status()
        env.check("BANK-HSK-03", "status afterwards", status, ERROR if early > 6 else ERROR | OBF)
        await axis.host.read(DATA)


@directed("BANK-HSK-03", builds=(B8, B32, F100))
async def bank_hsk_03_last_one_counts(dut):
    """If all axes receive bytes faster than they accept them, only bytes that a newer byte replaces are
    missed (BANK-HSK-03).
    """
    env = await Env.start(dut)
    for axis in env.axes:
        for code in (0x83, 0x81, 0x80):
            await axis.host.write(STATUS, code)
    for axis in env.axes:
        await axis.host.poll(IBF, 0)
    for axis in env.axes:
        env.check("BANK-HSK-03", f"status of {axis.n}", await axis.status(), OBF)
        env.check("BANK-HSK-03", f"finish status of {axis.n}", await axis.host.read(DATA), 0)


@directed("BANK-HSK-05", "BANK-HSK-01", builds=(B8, B32, B64))
async def bank_hsk_05_axes_do_not_wait(dut):
    """If bytes are sent to all axes in turn, each axis initialises and moves regardless of the other axes
    (BANK-HSK-05).
    """
    env = await Env.start(dut)
    for register, byte in ((STATUS, 0x0A), (DATA, 9), (DATA, 4), (DATA, 4), (DATA, 0)):
        for axis in env.axes:
            await axis.host.poll(IBF, 0)
            await axis.host.write(register, byte)
    for axis in env.axes:
        await axis.host.poll(IBF, 0)
    for register, byte in ((STATUS, 0x43), (DATA, 13), (DATA, 0), (DATA, 0)):
        for axis in env.axes:
            await axis.host.poll(IBF, 0)
            axis.since = env.bench.now
            await axis.host.write(register, byte)
    for axis in env.axes:
        await axis.idle()
        env.check("BANK-HSK-05", f"pulses of {axis.n}", len(axis.pulses), 14)


@directed("BANK-HSK-04", builds=(B8, B32))
async def bank_hsk_04_queue(dut):
    """After the end of a data read, the next of three answer bytes is loaded on edge 2 after the strobe
    (BANK-HSK-04).
    """
    env = await Env.start(dut)
    axis = await env.ready(2)
    await axis.go(0x44, 0x123456, 255)
    await axis.command(0x40)
    await axis.idle()
    for _ in range(2):
        await axis.command(0x83)
        for byte in (0x55, 0x34, 0x12):
            env.check("BANK-HSK-04", "OBF", await axis.status() & OBF, OBF)
            env.check("BANK-HSK-04", "byte", await axis.host.read(DATA), byte)
        env.check("BANK-HSK-04", "OBF", await axis.status() & OBF, 0)
        env.check("BANK-HSK-04", "byte stays", await axis.host.read(DATA), 0x12)
    await axis.command(0x83)
    await axis.host.read(DATA)
    await axis.command(0x80)  # the new command discards the previous answer
    env.check("BANK-HSK-04", "new answer", await axis.host.read(DATA), 0xC4)
    env.check("BANK-HSK-04", "OBF", await axis.status() & OBF, 0)


@directed("BANK-HSK-04", builds=(B8, B32))
async def bank_hsk_04_answer_coincides_with_a_read(dut):
    """If a read strobe ends near the visit that outputs a new answer, the new answer stays available
    (BANK-HSK-04).
    """
    env = await Env.start(dut)
    axis = await env.ready(5)
    for late in range(-4, 5):
        await axis.command(0x82)
        visit = axis.visit(env.bench.now + 60)
        await env.write_at(visit - 7, axis.n << 4 | STATUS, 0x83)
        # The write ends at V - 6; the read ends `late` cycles after V.
        start = env.bench.now
        length = visit + late - start - 1
        if length < 6:
            length, _ = 6, await env.bench.until(visit + late - 7) if visit + late - 7 > start else start
        await axis.host.read(DATA, strobe=length)
        await env.bench.clocks(2 * env.round)
        left = await axis.status() & OBF
        got = []
        while left and len(got) < 5:
            got.append(await axis.host.read(DATA))
            left = await axis.status() & OBF
        env.check("BANK-HSK-04", f"bytes of the new answer, {late:+}", len(got) in (2, 3), True)


@directed("BANK-HSK-02", builds=(B8, B32))
async def bank_hsk_02_end_takes_the_visit(dut):
    """A visit that ends a motion or completes an initialisation does not accept a waiting byte; the next
    visit accepts it (BANK-HSK-02).
    """
    env = await Env.start(dut)
    axis = await env.ready(4)
    address = axis.n << 4 | STATUS
    edge0 = await axis.go(0x42, poll=False)
    start = axis.accepting_visit(edge0)
    end = axis.visit(start + 2 * env.cfg.w + 1)
    await env.write_at(end - 7, address, 0x80)
    env.check("BANK-HSK-02", "status after the end", await env.as_of(end + 1, address), IBF)
    await env.bench.clocks(env.round)
    env.check("BANK-HSK-02", "status later", await axis.status(), OBF)
    env.check("BANK-HSK-02", "finish status", await axis.host.read(DATA), 0x82)


@directed("BANK-GEN-03", "BANK-HSK-04", builds=(B8, B32))
async def bank_gen_03_all_codes_at_rest(dut):
    """Each of the 256 codes, sent before and after an initialisation, sets the status that the code map of
    BANK-GEN-03 states.
    """
    env = await Env.start(dut)
    for initialised, axis in ((False, env.axes[1]), (True, env.axes[6])):
        if initialised:
            await axis.init(*INIT_A)
        for code in range(256):
            status = await axis.command(code)
            env.check("BANK-GEN-03", f"status after {code:02X}", status, idle_answer(code, initialised))
            if status & BUSY:
                await axis.halt()
                status = 0
            while status & OBF:
                await axis.host.read(DATA)
                status = await axis.status()
            if initialised and code & 0xC7 == 0xC0:
                await axis.init(*INIT_A)
        await axis.command(0x87)


@directed("BANK-GEN-03", builds=(B8, B32))
async def bank_gen_03_all_codes_while_busy(dut):
    """During a motion, stops take effect, command 0xC0 sets error 1, and each unsupported code sets error 0
    (BANK-GEN-03).
    """
    env = await Env.start(dut)
    axis = await env.ready(7)
    await axis.go(0x45, rate=9)
    for code in range(256):
        if code & 0xC6 == 0x40:
            continue  # a stop command
        status = await axis.command(code)
        undefined = idle_answer(code, True) == 0x80
        want = BUSY | 0x80 | (UNDEFINED if undefined else WHILE_BUSY << 4)
        env.check("BANK-GEN-03", f"status after {code:02X}", status, want)
    for code in (0x40, 0x41, 0x58, 0x61, 0x79):
        if not await axis.status() & BUSY:
            await axis.go(0x45, rate=9)
        await axis.command(code)
        await axis.idle()
        env.check("BANK-GEN-03", f"finish status of {code:02X}", await axis.finish(), 0xC5)


@directed("BANK-GEN-03", builds=(B8,))
async def bank_gen_03_data_bytes(dut):
    """Unexpected data and invalid settings set the same errors as in a PPMC-104 (BANK-GEN-03)."""
    env = await Env.start(dut)
    axis = env.axes[2]
    env.check("BANK-GEN-03", "data", await axis.host.data(0x55), 0x80 | NOT_WANTED << 4)
    for rl, rh, pa, error in (
        (9, 10, 4, 5),
        (9, 4, 3, 5),
        (9, 9, 4, -1),
        (9, 4, 11_221, 4),
        (9, 4, 11_220, -1),
    ):
        await axis.refused("BANK-GEN-03", f"{rl} {rh} {pa}", error, 0x0A, rl, rh, pa & 255, pa >> 8)
    await axis.opened()
    await axis.go(0x46)
    await axis.command(0x41)
    await axis.refused("BANK-GEN-03", "a second 0x41", 7, 0x41)


@directed("BANK-INI-01", "BANK-INI-02", "BANK-HSK-05", "BANK-HSK-02", builds=(B8, B32, F100))
async def bank_ini_02_shared_builder(dut):
    """During a long table build, the last initialisation bytes of other axes wait, and all other bytes are
    accepted. After this build, the tables of the waiting axes are built (BANK-INI-02, BANK-HSK-05).
    """
    env = await Env.start(dut)
    one, two, three = (env.axes[n] for n in (1, 2, 5))
    await one.init(*LONG, opened=False)
    begun = env.bench.now
    await two.host.send(0x09, (9, 4, 4))
    await two.host.write(DATA, 0)
    await three.host.send(0x0B, (9, 4, 4))
    await three.host.write(DATA, 0)
    for _ in range(5):
        env.check("BANK-HSK-05", "status", [await x.status() for x in (two, three)], [0x12, 0x12])
    await three.host.write(STATUS, 0x87)  # a command replaces the last byte
    await env.bench.clocks(2 * env.round)
    env.check("BANK-HSK-05", "status of a command", await three.status(), 0x80)
    env.check("BANK-HSK-05", "status of the last byte", await two.status(), 0x12)
    env.check("BANK-HSK-05", "a read elsewhere", await env.axes[0].host.fetch(0x80), [0])
    env.check("BANK-INI-01", "pattern of the one that waits", two.phases_now, 0b11111)
    await two.host.poll(IBF, 0)
    env.check("BANK-INI-01", "pattern of the next one", two.phases_now, 0b00011)
    env.check("BANK-INI-01", "time of a build", env.bench.now - begun < 40_000 + 300, True)
    for axis in (one, two):
        await axis.opened()
        env.check("BANK-INI-02", f"pulses of {axis.n}", len(await axis.move(0x43, 9)), 9)


@directed("BANK-HSK-05", "BANK-HSK-03", builds=(B8, B32))
async def bank_hsk_05_command_at_the_end_of_a_build(dut):
    """If a command replaces a waiting last byte near the end of a build, exactly one of these two bytes is
    accepted (BANK-HSK-05).
    """
    env = await Env.start(dut)
    two, three = env.axes[6], env.axes[3]
    await env.ready(1)
    start = env.bench.now
    await env.axes[1].init(0x0A, 20, 1, 4, opened=False)
    await two.host.send(0x09, (9, 4, 4))
    await two.host.write(DATA, 0)
    await two.host.poll(IBF, 0)
    length = env.bench.now - start
    for early in range(60, -12, -3):
        await two.opened()
        start = env.bench.now
        await env.axes[1].init(0x0A, 20, 1, 4, opened=False)
        await two.host.send(0x09, (9, 4, 4))
        await two.host.write(DATA, 0)
        await env.bench.until(max(env.bench.now, start + length - early - 20))
        await two.host.write(STATUS, 0x80)
        # A third axis occupies the builder again.
        await three.init(0x0A, 20, 1, 4, opened=False)
        await two.host.poll(IBF, 0)
        await three.opened()
        await env.axes[1].opened()
        await two.host.read(DATA)


@directed("BANK-GEN-05", "BANK-INI-01", builds=(B8, B32))
async def bank_gen_05_reset_in_a_build(dut):
    """A reset frees the builder during a build and while a last byte waits for the builder (BANK-GEN-05)."""
    env = await Env.start(dut)
    for n in range(env.size):
        waiting = env.axes[n]
        await env.axes[(n + 1) % env.size].init(*LONG, opened=False)
        await waiting.host.send(0x0A, (255, 1, 4))
        await waiting.host.write(DATA, 0)
        await env.bench.clocks(30)
        await env.reset()
        axis = env.axes[(n + 2) % env.size]
        await axis.host.send(0x09, (9, 4, 4))
        edge0 = await axis.host.write(DATA, 0)
        await env.bench.clocks(2 * env.round + 8)
        changes = axis.patterns(edge0)
        env.check(
            "BANK-GEN-05", f"pattern of {axis.n}", changes[:1], [(axis.accepting_visit(edge0), 0b00011)]
        )
        await axis.opened()
        await env.reset()


@directed("BANK-HSK-03", builds=(B8, B32))
async def bank_hsk_03_replaced_many_times(dut):
    """If one to nine bytes are written while no byte is accepted, IBF stays 1, and then the last byte is
    accepted (BANK-HSK-03).
    """
    env = await Env.start(dut)
    axis = env.axes[4]
    for count in range(1, 10):
        await axis.init(0x0A, 60, 1, 4, opened=False)
        for k in range(count):
            await axis.host.write(STATUS, 0x87 if k < count - 1 else 0x81)
            env.check("BANK-HSK-03", f"IBF behind {k + 1} of {count}", await axis.status() & IBF, IBF)
        await axis.host.poll(IBF, 0)
        env.check("BANK-HSK-03", f"status behind {count}", await axis.status(), OBF)
        await axis.host.read(DATA)


@directed("BANK-HSK-04", builds=(B8, B32))
async def bank_hsk_04_answers_that_are_not_read(dut):
    """If the host reads none of one to nine answers, the last answer is available (BANK-HSK-04)."""
    env = await Env.start(dut)
    axis = env.axes[1]
    for count in range(1, 10):
        for k in range(count):
            status = await axis.command(0x81 if k < count - 1 else 0x83)
            env.check("BANK-HSK-04", f"OBF behind {k + 1} of {count}", status, OBF)
        for _ in range(3):
            env.check("BANK-HSK-04", "OBF", await axis.status(), OBF)
            env.check("BANK-HSK-04", "remaining pulses", await axis.host.read(DATA), 0)
        env.check("BANK-HSK-04", "OBF", await axis.status(), 0)
